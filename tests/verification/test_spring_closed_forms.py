"""Closed forms of the spring model: elastic limits, the shear of rolling on to the flat, relaxation, free rolling."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import brentq

from tread_validate.spring import element_history, free_rolling_creep, run
from tread_validate.spring.block_pass import prepare
from tread_validate.spring.element_record import SLIPPING, TOUCHING
from tread_validate.study import Case, PronyTerm

Array = NDArray[np.float64]
Build = Callable[..., Case]
RIG = "rig-rectangle-22c-0p2mm-300rpm"
RADIUS, HALF_PATCH, HEIGHT = 0.5, 0.085, 0.008


def approach_angle(interference: float) -> float:
    """Angle on the arc from first contact to the flat patch: arccos(1 - D/(R + h))."""
    return math.acos(1.0 - interference / (RADIUS + HEIGHT))


def test_block_wholly_in_flat_patch_carries_modulus_times_strain(spring_case: Build) -> None:
    """N = E A D/h: 16 MPa on 25 x 20 x 8 mm at 0.2 mm is 200 N. Only round-off separates a constant from its sum."""
    history = run(spring_case(modulus=16e6))
    middle = np.abs(history.time - 0.5 * history.time[-1]) < 2e-3
    assert history.normal_force[middle] == pytest.approx(200.0, rel=1e-9)
    assert history.normal_force.max() == pytest.approx(200.0, rel=1e-9)


@pytest.mark.parametrize("creep_ratio", [-0.002, 0.0, 0.003])
def test_element_enters_the_patch_sheared_by_the_arc_and_shears_on_with_the_creep(
    spring_case: Build, creep_ratio: float
) -> None:
    """lambda = R alpha (1 + eps) - (R + h) sin alpha at the patch's leading edge, and grows by eps x after it.

    Exact for an element that sticks, whatever the material: 1e-9 of the arc's length is round-off.
    """
    case = spring_case(creep_ratio=creep_ratio, friction=(5.0, 5.0))
    alpha = approach_angle(case.interference)
    at_edge = RADIUS * alpha * (1.0 + creep_ratio) - (RADIUS + HEIGHT) * math.sin(alpha)
    element = element_history(case)
    travelled = case.speed * element.time - RADIUS * alpha
    flat = (travelled > 0.0) & (travelled < 2.0 * HALF_PATCH)
    assert flat.sum() > 100
    expected = at_edge + creep_ratio * travelled[flat]
    assert element.longitudinal_length[flat] == pytest.approx(expected, abs=1e-12)
    assert element.radial_length[flat] == pytest.approx(HEIGHT - case.interference, abs=1e-12)


def test_elastic_block_in_the_patch_is_sheared_by_the_mean_of_its_elements(spring_case: Build) -> None:
    """T = -G A lambda_mean/h, lambda_mean at the block's middle since lambda is linear: exact, 1e-7 of the peak."""
    case = spring_case(modulus=16e6, friction=(5.0, 5.0), creep_ratio=0.003)
    history = run(case)
    alpha = approach_angle(case.interference)
    at_edge = RADIUS * alpha * 1.003 - (RADIUS + HEIGHT) * math.sin(alpha)
    middle = case.speed * history.time - RADIUS * alpha - 0.5 * case.length
    inside = (middle > 0.5 * case.length + 1e-3) & (middle < 2.0 * HALF_PATCH - 0.5 * case.length - 1e-3)
    shear_modulus = 16e6 / (2.0 * 1.47)
    expected = -shear_modulus * 5e-4 / HEIGHT * (at_edge + 0.003 * middle[inside])
    assert inside.sum() > 100
    assert history.tangential_force[inside] == pytest.approx(expected, abs=1e-7 * np.abs(expected).max())


def stuck_element(case: Case) -> tuple[Callable[[float], complex], Callable[[float], complex]]:
    """Return radial compression and lambda of a sticking element as analytic functions of (complex) time.

    Written out from the geometry of section 4.2 of the paper, on its own: belt with two arcs, or two wheels.
    """
    speed, road_speed = case.speed, case.speed * (1.0 + (case.creep_ratio or 0.0))

    def belt(t: complex) -> tuple[complex, complex]:
        alpha = approach_angle(case.interference)
        arc = speed * t - RADIUS * alpha - HALF_PATCH
        edge = -HALF_PATCH if arc.real < -HALF_PATCH else HALF_PATCH
        theta = (arc - edge) / RADIUS if abs(arc.real) > HALF_PATCH else 0.0
        mount_x = edge + RADIUS * np.sin(theta) if abs(arc.real) > HALF_PATCH else arc
        mount_y = HEIGHT - case.interference + RADIUS * (1.0 - np.cos(theta))
        contact_x = -HALF_PATCH - (RADIUS + HEIGHT) * math.sin(alpha) + road_speed * t
        return lengths(contact_x - mount_x, -mount_y, theta)

    def rig(t: complex) -> tuple[complex, complex]:
        small, big = 0.1, 0.3
        axles = small + big - case.interference
        start = -math.acos((small**2 + axles**2 - big**2) / (2.0 * small * axles))
        theta = start + speed * t / small
        mount_x, mount_y = (small - HEIGHT) * np.sin(theta), axles - big - (small - HEIGHT) * np.cos(theta)
        place = math.asin(small * math.sin(start) / big) + road_speed * t / big
        return lengths(big * np.sin(place) - mount_x, big * (np.cos(place) - 1.0) - mount_y, theta)

    def lengths(bx: complex, by: complex, theta: complex) -> tuple[complex, complex]:
        return HEIGHT - (bx * np.sin(theta) - by * np.cos(theta)), bx * np.cos(theta) + by * np.sin(theta)

    both = rig if case.path.family == "rig" else belt
    return (lambda t: both(t)[0]), (lambda t: both(t)[1])


def hereditary(stretch: Callable[[float], complex], moduli: Array, times: Array, constant: float, ends: Array) -> Array:
    """Integrate E(t - s) du/ds from 0 to each of `ends` by Gauss-Legendre rules on panels refined towards the end.

    du/ds by complex-step differentiation: no subtraction, so round-off only.
    """
    nodes, weights = np.polynomial.legendre.leggauss(12)
    values = np.empty(ends.size)
    for index, end in enumerate(ends):
        ago = np.concatenate([[0.0], np.geomspace(1e-8, 1.0, 60) * end])
        panels = np.unique(np.concatenate([end - ago, CORNERS[end > CORNERS]]))
        total = 0.0
        for left, right in itertools.pairwise(panels):
            s = 0.5 * (left + right) + 0.5 * (right - left) * nodes
            rate = np.array([stretch(x + 1e-30j).imag / 1e-30 for x in s])
            modulus = constant + np.exp(-(end - s)[:, None] / times) @ moduli
            total += 0.5 * (right - left) * float(np.sum(weights * modulus * rate))
        values[index] = total
    return values


CORNERS = np.array([RADIUS * math.acos(1.0 - 2e-4 / (RADIUS + HEIGHT)) / 16.7 + k * 0.17 / 16.7 for k in (0, 1)])


@pytest.mark.parametrize("case_id", ["belt-simplified-60c-0p2mm-16p7mps-creep0p3", RIG])
def test_element_forces_are_the_hereditary_integral(spring_case: Build, case_id: str) -> None:
    """F_r and F_l of one element against direct quadrature of int E(t - s) du/ds ds, 24 terms.

    1e-6 of the peak is asked for; cubic steps and events off the smooth stretches leave less than 1e-10.
    """
    case = spring_case(case_id, friction=(5.0, 5.0))
    block_pass = prepare(case)
    record, _ = block_pass.element(case.creep_ratio or 0.0)
    sticking = np.flatnonzero((record[:, TOUCHING] > 0.0) & (record[:, SLIPPING] == 0.0))
    rows = sticking[np.unique(np.linspace(3, sticking.size - 1, 23).astype(int))]
    assert sticking.size > 0.97 * np.count_nonzero(record[:, TOUCHING])
    ends = rows * block_pass.step
    compression, deflection = stuck_element(case)
    rubber = block_pass.rubber
    for stretch, column, factor in ((compression, 0, 1.0), (deflection, 1, rubber.shear_ratio)):
        exact = hereditary(stretch, rubber.moduli, rubber.relaxation_times, rubber.long_term_modulus, ends)
        exact *= factor / HEIGHT
        peak = np.abs(record[:, column]).max()
        assert np.max(np.abs(record[rows, column] - exact)) < 1e-10 * peak


def test_compression_held_in_the_patch_relaxes_with_the_single_term(spring_case: Build) -> None:
    """With one term of tau, p - p_inf in the patch falls as exp(-t/tau): exact, since the strain is constant there."""
    case = spring_case(modulus=10e6, friction=(5.0, 5.0))
    compound = case.compound.model_copy(update={"terms": (PronyTerm(modulus_MPa=20.0, relaxation_time_s=0.3),)})
    case = spring_case(compound=compound, friction=(5.0, 5.0))
    block_pass = prepare(case)
    tau = float(block_pass.rubber.relaxation_times[0])
    record, _ = block_pass.element(0.003)
    time = block_pass.step * np.arange(record.shape[0])
    flat = (time > CORNERS[0]) & (time < CORNERS[1])
    rest = record[flat, 0] - 10e6 * case.interference / HEIGHT
    expected = rest[0] * np.exp(-(time[flat] - time[flat][0]) / tau)
    assert rest[0] > 1e5
    assert rest == pytest.approx(expected, rel=1e-9)


def test_free_rolling_creep_of_a_sticking_elastic_block_is_the_root_of_its_mean_shear(spring_case: Build) -> None:
    """Elastic and without slip, int T dt = 0 means int lambda dt = 0 over the contact, found here by quadrature.

    The contact ends where the compression returns to zero. 1e-5 relative: ten times better than the three digits of
    the paper, and the trapezoidal sum over 700 steps is that good.
    """
    case = spring_case(modulus=16e6, friction=(5.0, 5.0), creep_ratio=None, free_rolling=True)

    def mean_deflection(creep_ratio: float) -> float:
        compression, deflection = stuck_element(case.with_creep(creep_ratio))
        end = brentq(lambda t: float(compression(t).real), CORNERS[1] + 1e-5, CORNERS[1] + 2e-3, xtol=1e-14)
        parts = [0.0, *CORNERS, end]
        return sum(
            quad(lambda t: float(deflection(t).real), a, b, epsabs=1e-16)[0] for a, b in itertools.pairwise(parts)
        )

    expected = brentq(mean_deflection, -0.01, 0.01, xtol=1e-12)
    assert free_rolling_creep(case) == pytest.approx(expected, rel=1e-5)


def test_wheel_on_wheel_peak_force_of_an_elastic_block_wholly_in_contact(spring_case: Build) -> None:
    """A long elastic block on the rig carries N = E w/h int u ds over the contact of half-length R1 theta_0.

    u(s) = h - delta from the geometry of two circles, integrated by quadrature. 1e-4: trapezoidal sums over time.
    """
    case = spring_case(RIG, modulus=16e6, friction=(5.0, 5.0))
    compression, _ = stuck_element(case)
    end = brentq(lambda t: float(compression(t).real), 2e-3, 5e-3, xtol=1e-14)
    mean = quad(lambda t: float(compression(t).real), 0.0, end)[0]
    expected = 16e6 * case.width / HEIGHT * mean * case.speed
    history = run(case)
    assert case.speed * end < case.length
    assert history.normal_force.max() == pytest.approx(expected, rel=1e-4)
