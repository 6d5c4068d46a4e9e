"""The compiled kernels one by one: moments of the recursion, kinematics against the geometry package."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from tread_validate.geometry import path_of
from tread_validate.spring.block_pass import prepare
from tread_validate.spring.kinematics import mount_point, sliding, sticking
from tread_validate.spring.memory import moments
from tread_validate.study import Case

CASES = [
    "belt-simplified-60c-0p2mm-16p7mps-creep0p3",
    "belt-midtop-60c-0p2mm-16p7mps-creep0p3",
    "rig-rectangle-22c-0p2mm-300rpm",
]


@settings(deadline=None)  # the first call compiles
@given(st.floats(0.0, 200.0))
def test_moments_of_the_fading_weight(x: float) -> None:
    """int_0^1 z^j exp(-x (1-z)) dz for j = 0, 1, 2 by adaptive quadrature; 1e-10, quadrature's own accuracy."""
    for order, value in enumerate(moments(x)):
        exact = quad(lambda z, j=order: z**j * math.exp(-x * (1.0 - z)), 0.0, 1.0, epsabs=1e-14, points=[0.9])[0]
        assert value == pytest.approx(exact, rel=1e-10)


@pytest.mark.parametrize("case_id", CASES)
def test_compiled_mount_point_is_the_mount_line_of_the_geometry(cases: dict[str, Case], case_id: str) -> None:
    """Two codes for one line, over and beyond its whole length: 1e-13 m, round-off."""
    path = path_of(cases[case_id])
    motion = prepare(cases[case_id]).motion(0.001)
    reach = 0.25 if not path.road.is_plane or path.line.code == 0 else 0.4
    for arc in np.linspace(-reach, reach, 401):
        x, y, theta = path.line.mount(arc)
        found = mount_point(motion, float(arc))
        assert found[:2] == pytest.approx((float(x), float(y)), abs=1e-13)
        assert found[2:4] == pytest.approx((math.sin(theta), math.cos(theta)), abs=1e-12)
        turn = cases[case_id].speed * float(path.line.curvature(arc))
        assert found[4] == pytest.approx(turn, abs=1e-9 * abs(turn) + 1e-12)


@pytest.mark.parametrize("case_id", CASES)
@pytest.mark.parametrize("place", [-0.003, 0.0, 0.002])
def test_sticking_and_sliding_agree_on_a_contact_point(cases: dict[str, Case], case_id: str, place: float) -> None:
    """A point that sticks at lambda is found again by sliding at that lambda, with the same rates: round-off.

    Sliding at lambda's sticking rate is sticking: d delta/dt = slope lambda' + drift must match.
    """
    motion = prepare(cases[case_id]).motion(0.004)
    at = mount_point(motion, place)
    c = place + 1e-4 if motion.road_curvature == 0.0 else (place + 1e-4) * motion.road_curvature
    delta, deflection, delta_rate, deflection_rate = sticking(motion, at, c)
    found_delta, found_c, stick_rate, slope, drift = sliding(motion, at, deflection)
    assert found_delta == pytest.approx(delta, abs=1e-15)
    assert found_c == pytest.approx(c, abs=1e-14)
    assert stick_rate == pytest.approx(deflection_rate, abs=1e-12)
    assert slope * deflection_rate + drift == pytest.approx(delta_rate, abs=1e-12)
    step = 1e-7
    shifted = sliding(motion, at, deflection + step)[0] - sliding(motion, at, deflection - step)[0]
    assert slope == pytest.approx(shifted / (2 * step), abs=1e-6)
