"""Profiles, quadrature and amplitudes: properties that hold for all inputs."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.fe.amplitude import Amplitude, amplitude_at
from tread_validate.fe.contact_kernel import project
from tread_validate.fe.relaxation import gauss_rule
from tread_validate.fe.rigid_surface import read_rigid_surface
from tread_validate.inp import read_deck

WHEEL = """*SURFACE, TYPE=CYLINDER, NAME=ROAD
0., -5., 0., 1., -5., 0.
0., -5., -1.
START, 0., -5.
CIRCL, -4.330127018922194, 2.5, 0., 0.
CIRCL, 4.330127018922194, 2.5, 0., 0.
CIRCL, 0., -5., 0., 0.
"""
PLANE = """*SURFACE, TYPE=CYLINDER, NAME=ROAD
0., 0., 0., 1., 0., 0.
0., 0., -1.
START, -10., 0.
LINE, 10., 0.
"""


def surface(folder: Path, text: str):  # type: ignore[no-untyped-def]
    (folder / "s.inp").write_text(text)
    return read_rigid_surface(read_deck(folder / "s.inp").blocks[0])


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory):  # type: ignore[no-untyped-def]
    return surface(tmp_path_factory.mktemp("wheel"), WHEEL)


@pytest.fixture(scope="module")
def plane(tmp_path_factory: pytest.TempPathFactory):  # type: ignore[no-untyped-def]
    return surface(tmp_path_factory.mktemp("plane"), PLANE)


def test_local_y_is_x_cross_the_generator(plane) -> None:  # type: ignore[no-untyped-def]
    """Generator -z, local x = +x: local y = +y, and a profile towards +x faces +y."""
    assert plane.frame.tolist() == [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]
    assert project(plane.segments, 3.0, 0.5) == (0.5, -0.0, 1.0)


@given(angle=st.floats(-math.pi, math.pi), radius=st.floats(0.1, 20.0))
def test_gap_from_a_wheel_is_the_distance_less_its_radius(wheel, angle: float, radius: float) -> None:  # type: ignore[no-untyped-def]
    """Three clockwise arcs make a full circle whose normal points outward everywhere; 1e-9 for rounding."""
    gap, nx, ny = project(wheel.segments, radius * math.cos(angle), radius * math.sin(angle))
    assert gap == pytest.approx(radius - 5.0, abs=1e-9)
    assert (nx, ny) == pytest.approx((math.cos(angle), math.sin(angle)), abs=1e-9)


@pytest.mark.parametrize(
    ("profile", "expected"),
    [
        ("START, -1., 5.\nLINE, 9., 5.\n", "s.inp:1: got a profile down to r = -1"),
        ("START, 3., 4.\nCIRCL, 3., -4., 3., 0.\n", "180 degrees"),
        ("START, 3., 4.\nCIRCL, -1., 0., 3., 0.\nCIRCL, 3., -4., 3., 0.\n", "down to r = -1"),
        ("START, 1., 4.\nCIRCL, 1., -4., 4., 0.\n", "down to r = -1"),
    ],
    ids=["line", "half turn", "arcs", "arc between its ends"],
)
def test_a_profile_that_crosses_its_axis_of_revolution_is_refused(tmp_path: Path, profile: str, expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        surface(tmp_path, f"*SURFACE, TYPE=REVOLUTION, NAME=R\n0., 0., 0., 0., 0., 2.\n{profile}")


@given(x=st.floats(10.001, 1e3), y=st.floats(-5.0, 5.0))
def test_beside_the_end_of_a_line_there_is_no_contact(plane, x: float, y: float) -> None:  # type: ignore[no-untyped-def]
    """The profile ends; the gap beside it is infinite."""
    assert project(plane.segments, x, y)[0] == math.inf


@given(
    weights=st.lists(st.floats(0.01, 1.0), min_size=6, max_size=12),
    points=st.integers(1, 4),
    seed=st.integers(0, 10_000),
)
def test_gauss_rule_keeps_the_moments_of_a_discrete_measure(weights: list[float], points: int, seed: int) -> None:
    """n points keep moments 0..2n-1; weights positive; nodes within the range. 1e-8 for Lanczos in double precision."""
    nodes = np.sort(np.random.default_rng(seed).uniform(0.0, 3.0, len(weights)))
    measure = np.array(weights)
    found, own = gauss_rule(nodes, measure, points)
    assert (own > -1e-15).all()
    assert (found >= -1e-12).all()
    assert (found <= nodes.max() + 1e-9).all()
    for power in range(2 * points):
        assert own @ found**power == pytest.approx(measure @ nodes**power, rel=1e-8)


@given(
    rows=st.lists(st.tuples(st.floats(0.01, 1.0), st.floats(-5.0, 5.0)), min_size=2, max_size=6),
    smooth=st.booleans(),
    share=st.floats(-0.2, 1.2),
)
def test_amplitude_integral_is_the_area_under_its_value(
    rows: list[tuple[float, float]], smooth: bool, share: float
) -> None:
    """Against a fine trapezoidal sum from the first time; 1e-4 of the largest value times the length."""
    times = np.cumsum([step for step, _ in rows])
    values = np.array([value for _, value in rows])
    made = Amplitude("A", times, values, smooth, True)
    sums = made.integrals()

    def at(t: float) -> tuple[float, float, int]:
        found: tuple[float, float, int] = amplitude_at(times, values, sums, 0, times.size, smooth, 0, t)
        return found

    end = times[0] + share * (times[-1] - times[0])
    grid = np.linspace(times[0], end, 2001)
    area = np.trapezoid([at(float(t))[0] for t in grid], grid)
    assert at(float(end))[1] == pytest.approx(area, abs=1e-4 * (1.0 + np.abs(values).max() * (times[-1] - times[0])))
