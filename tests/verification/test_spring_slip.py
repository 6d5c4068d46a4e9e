"""Slip of the lumped mass against exact solutions of its equation of motion, and the massless limit."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from tread_validate.spring import element_history, run
from tread_validate.spring.block_pass import prepare
from tread_validate.study import Case

Build = Callable[..., Case]
MODULUS, HEIGHT, STRAIN = 16e6, 0.008, 0.2 / 8.0


def oscillator() -> tuple[float, float, float, float]:
    """Pressure, stiffness and mass per area and natural frequency of an elastic element in the flat patch."""
    stiffness = MODULUS / (2.0 * 1.47) / HEIGHT
    mass = 0.5 * 1000.0 * HEIGHT
    return MODULUS * STRAIN, stiffness, mass, math.sqrt(stiffness / mass)


@pytest.mark.parametrize(("static", "kinetic"), [(0.3, 0.3), (0.4, 0.25), (0.5, 0.1)])
def test_elastic_element_slips_and_sticks_as_the_exact_oscillator(
    spring_case: Build, static: float, kinetic: float
) -> None:
    """In the flat patch m lambda'' + k lambda = mu_k p with constant p has the exact solution

    lambda(t) = mu_k p/k + (mu_s - mu_k) p/k cos w(t - t0) + (V1/w) sin w(t - t0),
    from the instant t0 at which lambda = mu_s p/k and lambda' = V1, until lambda' = V1 again. The method is of
    second order with an error of 1e-4 of the interference a step: 3e-3 of the swing, over the whole slip.
    """
    case = spring_case(modulus=MODULUS, friction=(static, kinetic), creep_ratio=0.02)
    pressure, stiffness, _, frequency = oscillator()
    slip_rate = 0.02 * case.speed
    element = element_history(case)
    alpha = math.acos(1.0 - case.interference / 0.508)
    flat_time = (0.5 * alpha / case.speed, (0.5 * alpha + 0.17) / case.speed)
    started = element.slips & (element.longitudinal_length > 0.0)
    first = int(np.flatnonzero(started)[0])
    # lambda is linear while it sticks: the instant of slip from the last sticking sample
    held = element.longitudinal_length[first - 1]
    onset = element.time[first - 1] + (static * pressure / stiffness - held) / slip_rate
    swing = math.hypot((static - kinetic) * pressure / stiffness, slip_rate / frequency)
    end = onset + 2.0 / frequency * (
        math.pi - math.atan((static - kinetic) * pressure / stiffness * frequency / slip_rate)
    )
    assert flat_time[0] < onset < end < flat_time[1]
    during = (element.time > onset) & (element.time < end)
    phase = frequency * (element.time[during] - onset)
    exact = (kinetic + (static - kinetic) * np.cos(phase)) * pressure / stiffness
    exact += slip_rate / frequency * np.sin(phase)
    assert during.sum() > 10
    assert element.longitudinal_length[during] == pytest.approx(exact, abs=3e-3 * swing)
    if static > kinetic:
        after = (element.time > end + 1e-6) & (element.time < end + 0.2e-3)
        assert not element.slips[after].any()


def test_slip_does_not_ring_once_a_viscoelastic_element_slides_steadily(spring_case: Build) -> None:
    """With mu_s = mu_k, creep of 5 % and rubber that damps, the longitudinal force settles on mu_k F_r in the patch.

    The lumped mass overshoots once on the way in, as its equation says; in the second half of the patch force and
    friction agree to 1 % and neighbouring samples do not alternate.
    """
    case = spring_case(friction=(0.4, 0.4), creep_ratio=0.05)
    element = element_history(case)
    half = (element.time > 6e-3) & (element.time < 10.5e-3)
    assert element.slips[half].all()
    assert element.longitudinal_force[half] == pytest.approx(0.4 * element.radial_force[half], rel=1e-2)
    turns = np.diff(element.longitudinal_force[half], 2)
    assert np.max(np.abs(turns)) < 1e-3 * element.radial_force[half].max()


def test_lumped_mass_tends_to_the_massless_limit(spring_case: Build) -> None:
    """|F_l| - mu_k F_r is the inertia m lambda'': it vanishes with the mass, at least as its square root."""
    case = spring_case(friction=(0.4, 0.4), creep_ratio=0.03)
    gaps = []
    for mass_factor in (1.0, 1e-2, 1e-4):
        element = element_history(case, mass_factor=mass_factor)
        slides = element.slips & (element.time > 3e-3) & (element.time < 11e-3)
        gap = np.abs(np.abs(element.longitudinal_force) - np.abs(element.friction_force))[slides]
        gaps.append(float(np.sqrt(np.mean(gap**2))) / element.radial_force.max())
    assert gaps[1] < 0.2 * gaps[0]
    assert gaps[2] < 0.2 * gaps[1]
    assert gaps[2] < 1e-3


def test_no_slip_can_start_below_a_kinetic_coefficient_that_exceeds_the_static_one(spring_case: Build) -> None:
    """Friction that would be larger in slip than the force that starts it holds the element: the limit is the larger.

    The two laws then give the same history but for the mass's own inertia on the arcs, m V1' (60 Pa beside 0.4 MPa),
    which counts in the one and not in the other: 1e-3 of the peak.
    """
    low = run(spring_case(friction=(0.2, 0.6), creep_ratio=0.01))
    high = run(spring_case(friction=(0.6, 0.6), creep_ratio=0.01))
    assert high.slipping_fraction.max() > 0.5
    peak = high.normal_force.max()
    assert low.normal_force == pytest.approx(high.normal_force, abs=1e-3 * peak)
    assert low.tangential_force == pytest.approx(high.tangential_force, abs=1e-3 * peak)


def test_slip_turns_round_where_the_path_bends_and_does_not_depend_on_the_step(spring_case: Build) -> None:
    """An element that slips as it comes on to the flat finds the road going the other way at once.

    Its sticking rate jumps from below to above lambda' at the bend; the net impulse of a pass with many such elements
    changes by less than 1e-3 of itself with the step (a solver that stops the element there is off by 4e-3).
    """
    changes = {
        "friction": (0.3, 0.3),
        "interference": 7.5e-5,
        "temperature": 30.0,
        "creep_ratio": 0.0017,
        "speed": 18.0,
    }
    coarse, fine = (
        prepare(spring_case(step_fraction=part, **changes)).net_shear_impulse(0.0017) for part in (0.5, 0.125)
    )
    assert coarse == pytest.approx(fine, rel=1e-3)


@pytest.mark.parametrize("creep_ratio", [-0.08, 0.08])
def test_sliding_block_is_pulled_with_the_kinetic_coefficient(spring_case: Build, creep_ratio: float) -> None:
    """A faster road (creep > 0) pulls the sliding block with it, T = -mu N; a slower one holds it back, T = +mu N.

    In the middle of the patch, where inertia has died down; 1 %.
    """
    history = run(spring_case(friction=(0.3, 0.3), creep_ratio=creep_ratio))
    middle = (history.time > 6e-3) & (history.time < 9e-3)
    expected = -math.copysign(0.3, creep_ratio) * history.normal_force[middle]
    assert history.tangential_force[middle] == pytest.approx(expected, rel=1e-2)
    assert np.all(history.slipping_fraction[middle] > 0.99)


def test_friction_never_pulls_harder_than_the_law_allows(spring_case: Build) -> None:
    """|friction| <= max(mu_s, mu_k) F_r at every sample of an element that sticks and slips: 1e-3 for the onset.

    The onset of slip is narrowed down to the node step over 4096.
    """
    case = spring_case()
    element = element_history(case.with_creep(0.01))
    kernel_law = prepare(case).law
    from tread_validate.friction import law

    friction = law(case.friction)
    area = 5e-4 / 50.0
    kinetic = friction.kinetic(element.radial_force / area, element.slip_speed)
    limit = np.where(element.slips, kinetic, kernel_law.static_coefficient) * element.radial_force
    assert element.slips.any()
    assert np.all(np.abs(element.friction_force) <= limit * (1.0 + 1e-3) + 1e-9)
