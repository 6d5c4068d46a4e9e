"""Mount lines and paths: rig, simplified belt, measured trace; and bad ones."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate.errors import InputError
from tread_validate.geometry import line_from_trace, path_of, read_belt_trace
from tread_validate.study import Case, MeasuredBelt, load_study

Array = NDArray[np.float64]
BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"
TRACE = "belt-midtop-60c-0p2mm-16p7mps-creep0p3"
RIG = "rig-rectangle-22c-0p2mm-300rpm"


@pytest.fixture(scope="module")
def cases(paper_study: Path) -> dict[str, Case]:
    return {case.case_id: case for case in load_study(paper_study).cases()}


@pytest.mark.parametrize("case_id", [BELT, TRACE, RIG])
def test_clock_starts_when_the_leading_end_touches(cases: dict[str, Case], case_id: str) -> None:
    """At t = 0 the free face of s = 0 is on the road, 1 ns before it is clear; every other s touches s/V later.

    The last one leaves at the contact's end. 1e-12 m is round-off on half a metre.
    """
    case = cases[case_id]
    path = path_of(case)
    places = np.array([0.0, 0.01, path.profile.extent])
    assert path.indentation(places, places / case.speed) == pytest.approx(np.zeros(3), abs=1e-12)
    assert np.all(path.indentation(places, places / case.speed - 1e-9) < 0.0)
    assert path.indentation(path.profile.extent, path.contact_duration) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("case_id", [BELT, TRACE, RIG])
def test_largest_indentation_is_the_interference(cases: dict[str, Case], case_id: str) -> None:
    """D = 0.2 mm in the middle of the pass: exact on rig and simplified belt; the trace's patch is flat to 5 um."""
    path = path_of(cases[case_id])
    times = np.linspace(0.0, path.contact_duration, 20001)
    deepest = path.indentation(0.0, times).max()
    assert deepest == pytest.approx(2e-4, abs=5e-6 if case_id == TRACE else 1e-10)


@pytest.mark.parametrize("case_id", [BELT, TRACE, RIG])
def test_velocities_are_the_derivatives_of_the_places(cases: dict[str, Case], case_id: str) -> None:
    """Central differences over 0.1 us against the stated velocities: 1e-6 of the speed; none jumps on the trace."""
    case = cases[case_id]
    path = path_of(case)
    times = np.linspace(-2e-3, path.contact_duration + 1e-3, 997)
    step = 1e-7
    before, now, after = (path.at(0.004, times + shift) for shift in (-step, 0.0, step))
    assert (after.x - before.x) / (2 * step) == pytest.approx(now.velocity_x, abs=1e-6 * case.speed)
    assert (after.y - before.y) / (2 * step) == pytest.approx(now.velocity_y, abs=1e-6 * case.speed)
    turning = (after.theta - before.theta) / (2 * step)
    smooth = np.abs(turning - now.angular_velocity) < 1e-3 * np.abs(now.angular_velocity).max()
    assert smooth.mean() > 0.99


def test_rig_block_is_mounted_below_the_tread_surface(cases: dict[str, Case]) -> None:
    """The mount runs at R1 - h = 92 mm about the axle, R1 - D = 99.8 mm over the road's top; face on R1. Exact."""
    path = path_of(cases[RIG])
    motion = path.at([0.0, 0.02], [[0.001], [0.004]])
    assert np.hypot(motion.x, motion.y - 0.0998) == pytest.approx(np.full((2, 2), 0.092), rel=1e-12)
    x, y = path.free_face([0.0, 0.02], [[0.001], [0.004]])
    assert np.hypot(x, y - 0.0998) == pytest.approx(np.full((2, 2), 0.1), rel=1e-12)
    assert path.road.gap(0.0, 0.0) == pytest.approx(0.0, abs=1e-15)


def test_belt_touches_at_the_angle_of_the_paper(cases: dict[str, Case]) -> None:
    """alpha = arccos(1 - D/(R + h)) before the patch, 170 mm of it: contact (170 + 2 R alpha + 25) mm / V. 1e-9."""
    case = cases[BELT]
    path = path_of(case)
    alpha = math.acos(1.0 - 2e-4 / 0.508)
    assert path.first_contact_arc == pytest.approx(-0.085 - 0.5 * alpha, rel=1e-9)
    assert path.contact_duration == pytest.approx((0.17 + 2 * 0.5 * alpha + 0.025) / 16.7, rel=1e-9)


def synthetic(pitch: float = 2e-3, reach: float = 0.2, radius: float = 0.5) -> tuple[Array, Array]:
    """Return a flat patch of 170 mm between two arcs, sampled."""
    x = np.arange(-round(reach / pitch), round(reach / pitch) + 1) * pitch
    beyond = np.maximum(np.abs(x) - 0.085, 0.0)
    return x, radius - np.sqrt(radius**2 - beyond**2)


def test_traced_line_moves_at_unit_speed_along_its_slope() -> None:
    """|dr/darc| = 1, the tangent is (cos theta, sin theta), d theta/darc the curvature: to 1e-8, also past its ends."""
    line = line_from_trace(*synthetic(), patch_height=7.8e-3)
    arcs = np.linspace(line.first_arc - 0.05, line.last_arc + 0.05, 4001)
    step = 1e-6
    (x0, y0, t0), (x1, y1, t1) = line.mount(arcs - step), line.mount(arcs + step)
    _, _, theta = line.mount(arcs)
    assert (x1 - x0) / (2 * step) == pytest.approx(np.cos(theta), abs=1e-7)
    assert (y1 - y0) / (2 * step) == pytest.approx(np.sin(theta), abs=1e-7)
    assert (t1 - t0) / (2 * step) == pytest.approx(line.curvature(arcs), abs=2e-2)


def test_traced_slope_is_the_papers_three_point_slope() -> None:
    """theta_i = atan((y[i-1] - y[i+1])/(x[i-1] - x[i+1])), Eq. (13): equal to second order in the 2 mm pitch.

    A curvature that changes by 2 1/m over one pitch leaves 2 x 2e-3 / 6 rad; elsewhere far less.
    """
    x, height = synthetic()
    line = line_from_trace(x, height, patch_height=7.8e-3)
    arcs = np.linspace(line.first_arc, line.last_arc, 200001)
    place, _, theta = line.mount(arcs)
    three_point = np.arctan((height[:-2] - height[2:]) / (x[:-2] - x[2:]))
    assert np.interp(x[1:-1], place, theta) == pytest.approx(three_point, abs=2.0 * 2e-3 / 6.0)


def test_traced_patch_and_arcs_give_the_simplified_belts_contact(cases: dict[str, Case], tmp_path: Path) -> None:
    """The simplified profile, sampled at 2 mm and read back as a trace, touches at the same arc to 0.05 mm."""
    x, height = synthetic()
    file = tmp_path / "belt.yaml"
    rows = {"x_mm": x * 1e3, "height_mm": height * 1e3}
    text = "\n".join(f"    {key}: [{', '.join(f'{v:.9f}' for v in values)}]" for key, values in rows.items())
    file.write_text(
        f"origin: synthetic\nsource: a test\npitch_mm: 2.0\ntraces:\n  mid_top:\n{text}\n", encoding="utf-8"
    )
    belt = MeasuredBelt(kind="measured_belt", origin="synthetic", source="a test", file="belt.yaml")
    case = replace(cases[BELT], path=belt, root=tmp_path)
    assert path_of(case).first_contact_arc == pytest.approx(path_of(cases[BELT]).first_contact_arc, abs=5e-5)


@pytest.mark.parametrize("interference", [0.0, -1e-4, 8e-3, 9e-3, float("nan")])
@pytest.mark.parametrize("case_id", [BELT, TRACE, RIG])
def test_interference_outside_the_block_is_refused(cases: dict[str, Case], case_id: str, interference: float) -> None:
    """0 < D < h, else one line with the value found."""
    with pytest.raises(InputError, match="interference"):
        path_of(replace(cases[case_id], interference=interference))


def raised(x: Array, height: Array) -> tuple[Array, Array]:
    return x, height + 1e-3


def cut(x: Array, height: Array) -> tuple[Array, Array]:
    return x[70:-70], height[70:-70]


def unordered(x: Array, height: Array) -> tuple[Array, Array]:
    return x[::-1], height


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [(raised, "never touches"), (cut, "ends inside the contact"), (unordered, "order|increas")],
)
def test_trace_that_cannot_be_a_path_is_refused(
    cases: dict[str, Case], tmp_path: Path, spoil: Callable[[Array, Array], tuple[Array, Array]], complaint: str
) -> None:
    """A belt that never comes down, a trace that stops within the contact, places out of order: one line each."""
    x, height = spoil(*synthetic())
    file = tmp_path / "belt.yaml"
    rows = {"x_mm": x * 1e3, "height_mm": height * 1e3}
    text = "\n".join(f"    {key}: [{', '.join(f'{v:.6f}' for v in values)}]" for key, values in rows.items())
    file.write_text(f"traces:\n  mid_top:\n{text}\n", encoding="utf-8")
    belt = MeasuredBelt(kind="measured_belt", origin="synthetic", source="a test", file="belt.yaml")
    with pytest.raises(InputError, match=complaint):
        path_of(replace(cases[BELT], path=belt, root=tmp_path))


@pytest.mark.parametrize(
    "text",
    [
        "traces: 3\n",
        "traces: {top: {x_mm: [1, 2], height_mm: [1, 2]}}\n",
        "traces: {mid_top: {x_mm: [1, a], height_mm: [1, 2]}}\n",
        "traces: {mid_top: {height_mm: [1, 2]}}\n",
        "traces: [\n",
        "",
        "\x00\x01",
        "traces: {mid_top: {x_mm: !!python/object/apply:os.system [ls], height_mm: [1, 2]}}\n",
    ],
)
def test_belt_file_that_cannot_be_read_is_refused(tmp_path: Path, text: str) -> None:
    """A missing trace or key, a word for a number, broken or unsafe YAML, an empty or binary file: one line each."""
    file = tmp_path / "belt.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r"belt\.yaml"):
        read_belt_trace(file, "mid_top")


def test_missing_belt_file_is_refused(tmp_path: Path) -> None:
    """One line that names the file."""
    with pytest.raises(InputError, match="no such file"):
        read_belt_trace(tmp_path / "belt.yaml", "mid_top")


def test_conforming_block_is_curved_as_its_path_where_it_first_contacts(cases: dict[str, Case]) -> None:
    """Simplified belt: 1/R of the leading arc, exactly. Trace: the mean over the block, between its extremes."""
    simplified = path_of(cases[BELT])
    assert simplified.block_curvature() == 1.0 / 0.5
    trace = path_of(cases[TRACE])
    arcs = trace.first_contact_arc - np.linspace(0.0, trace.columns.extent, 11)
    assert trace.line.curvature(arcs).min() < trace.block_curvature() < trace.line.curvature(arcs).max()
    assert path_of(cases[RIG]).line.ring_radius == pytest.approx(0.092, rel=1e-15)
    assert simplified.line.ring_radius is None
