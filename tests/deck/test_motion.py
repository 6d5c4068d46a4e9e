"""How a deck moves its block, read back from the deck's text."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate import deck
from tread_validate.geometry import path_of
from tread_validate.inp import Deck, read_deck
from tread_validate.study import Case

FloatArray = NDArray[np.float64]
LEAD_IN = 2e-3


@dataclass(frozen=True)
class Read:
    """Numbers of a deck, by node id."""

    deck: Deck
    points: dict[int, FloatArray]
    velocity: dict[int, FloatArray]
    sets: dict[str, list[int]]
    amplitudes: dict[str, tuple[FloatArray, FloatArray]]
    held: dict[str, list[tuple[int, float, str | None]]]


def _read(case: Case, folder: Path) -> Read:
    deck.write(case, folder)
    text = read_deck(folder / f"{case.case_id}.inp")
    points, sets, amplitudes = {}, {}, {}
    velocity: dict[int, FloatArray] = {}
    held: dict[str, list[tuple[int, float, str | None]]] = {}
    for block in text.blocks:
        rows = [line.fields for line in block.data]
        if block.keyword == "NODE":
            points.update({int(row[0]): np.array(row[1:4], dtype=float) for row in rows})
            sets[block.value("NSET")] = [int(row[0]) for row in rows]
        elif block.keyword == "NSET":
            sets[block.value("NSET")] = [int(field) for row in rows for field in row]
        elif block.keyword == "AMPLITUDE":
            numbers = np.array([field for row in rows for field in row], dtype=float)
            amplitudes[block.value("NAME")] = numbers[::2], numbers[1::2]
        elif block.keyword == "INITIAL CONDITIONS" and block.value("TYPE") == "VELOCITY":
            for target, dof, value in rows:
                for node in [int(target)] if target.isdigit() else sets[target]:
                    velocity.setdefault(node, np.zeros(6))[int(dof) - 1] = float(value)
        elif block.keyword == "INITIAL CONDITIONS" and block.value("TYPE") == "ROTATING VELOCITY":
            (target, rate, *shift), axis = rows[0], np.array(rows[1], dtype=float)
            for node in sets[target]:
                turn = np.cross(float(rate) * (axis[3:] - axis[:3]), points[node] - axis[:3])
                velocity[node] = np.concatenate([turn + np.array(shift, dtype=float), np.zeros(3)])
        elif block.keyword == "BOUNDARY" and block.parameters.get("TYPE") == "VELOCITY":
            for row in rows:
                held.setdefault(row[0], []).append((int(row[1]), float(row[3]), block.parameters.get("AMPLITUDE")))
    return Read(text, points, velocity, sets, amplitudes, held)


@pytest.fixture(scope="module", params=["belt_case", "trace_case"])
def belt(
    request: pytest.FixtureRequest, coarse: Callable[[Case], Case], tmp_path_factory: pytest.TempPathFactory
) -> tuple[Case, Read]:
    case = coarse(request.getfixturevalue(request.param))
    return case, _read(case, tmp_path_factory.mktemp(case.case_id))


def _rows(read: Read) -> list[tuple[str, FloatArray, tuple[FloatArray, FloatArray], tuple[FloatArray, FloatArray]]]:
    """Mount rows: name, start of their first node, x and y velocity tables."""
    found = []
    for name, conditions in read.held.items():
        if not name.startswith("MOUNT_"):
            continue
        tables = {
            dof: read.amplitudes[amplitude] for dof, factor, amplitude in conditions if factor == 1.0 and amplitude
        }
        found.append((name, read.points[read.sets[name][0]], tables[1], tables[2]))
    return found


def _travel(time: FloatArray, table: tuple[FloatArray, FloatArray]) -> FloatArray:
    """Integral of a piecewise-linear table from 0 to `time`: exact, by the trapezoidal rule on both sets of points."""
    points = np.union1d(time, table[0])
    velocity = np.interp(points, *table)
    total = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(points) * (velocity[1:] + velocity[:-1]))])
    return np.interp(time, points, total)


def test_prescribed_velocities_integrate_to_the_belt_path_within_a_tenth_of_a_micrometre(
    belt: tuple[Case, Read],
) -> None:
    """Position of every mount row from t = 0 to the end of the pass, against the path itself: 0.1 um = 1e-4 mm."""
    case, read = belt
    path = path_of(case)
    rows = _rows(read)
    assert len(rows) == 6
    lead = max(start[0] for _, start, _, _ in rows)
    worst = 0.0
    for _, start, table_x, table_y in rows:
        s = round(_arc_behind(lead, start, rows), 6) * 1e-3
        time = np.linspace(LEAD_IN, table_x[0][-1], 400)
        motion = path.at(s, time - LEAD_IN)
        worst = max(worst, np.abs(start[0] + _travel(time, table_x) - 1e3 * motion.x).max())
        worst = max(worst, np.abs(start[1] + _travel(time, table_y) - 1e3 * motion.y).max())
    assert worst < 1e-4


def _arc_behind(lead: float, start: FloatArray, rows: list) -> float:
    """Distance of a row behind the leading one on the straight, stress-free mount."""
    first = next(place for _, place, _, _ in rows if place[0] == lead)
    return float(np.hypot(*(start - first)[:2]))


def test_block_starts_straight_and_stress_free(belt: tuple[Case, Read]) -> None:
    """A flat block is a box of 25 x 8 mm before it is bent on to the belt: distances from its leading foot.

    Tolerance 2e-5 mm: coordinates are written to 1e-5 mm.
    """
    case, read = belt
    mount = np.array([read.points[node][:2] for node in read.sets["MOUNT"]])
    face = np.array([read.points[node][:2] for node in read.sets["FACE_NODES"]])
    lead = mount[np.argmax(mount[:, 0])]
    along = (lead - mount[np.argmin(mount[:, 0])]) / 25.0
    assert np.hypot(*along) == pytest.approx(1.0, abs=1e-6)
    normal = np.array([-along[1], along[0]])
    np.testing.assert_allclose((mount - lead) @ normal, 0.0, atol=2e-5)
    np.testing.assert_allclose((face - lead) @ normal, -case.block.height_mm, atol=2e-5)


def test_everything_starts_with_the_velocity_that_is_prescribed(belt: tuple[Case, Read]) -> None:
    """No jump at the start: initial velocity of the mount equals the tables at 0; written to 1e-3 mm/s of 16,700."""
    case, read = belt
    for name, _, table_x, table_y in _rows(read):
        for node in read.sets[name]:
            np.testing.assert_allclose(read.velocity[node][:2], [table_x[1][0], table_y[1][0]], atol=1e-3)
    road = read.sets["ROAD_REF"][0]
    assert read.velocity[road][0] == pytest.approx(1e3 * case.speed * (1.0 + (case.creep_ratio or 0.0)), rel=1e-8)
    assert read.held["ROAD_REF"] == [(1, read.velocity[road][0], None)]


def test_block_starts_as_a_rigid_body(belt: tuple[Case, Read]) -> None:
    """The velocity field is v + omega x r: no strain rate at the start.

    Residual under 2e-3 mm/s: velocities are written to 1e-3 mm/s and places to 1e-5 mm.
    """
    _, read = belt
    nodes = read.sets["BLOCK_NODES"]
    place = np.array([read.points[node][:2] for node in nodes])
    velocity = np.array([read.velocity[node][:2] for node in nodes])
    r = place - place.mean(axis=0)
    v = velocity - velocity.mean(axis=0)
    omega = np.sum(r[:, 0] * v[:, 1] - r[:, 1] * v[:, 0]) / np.sum(r**2)
    np.testing.assert_allclose(v, omega * np.column_stack([-r[:, 1], r[:, 0]]), atol=2e-3)


def test_prescribed_velocity_has_no_jumps(belt: tuple[Case, Read]) -> None:
    """Every change of velocity is paid for by an acceleration that belongs to the path.

    Belt of curvature 5 1/m: V^2 kappa = 1,400 m/s2. Ramp: 5.8 d / T^2 = 1,800 m/s2 for the d = 1.25 mm by which such
    a belt bends the trailing end in T = 2 ms. Together 3,200 m/s2; 4,000 m/s2 is 0.1 m/s (0.6 %) between two points.
    """
    _, read = belt
    for _, _, table_x, table_y in _rows(read):
        for time, velocity in (table_x, table_y):
            assert np.all(np.diff(time) > 0.0)
            assert np.abs(np.diff(velocity) / np.diff(time)).max() < 4e6  # mm/s2


def test_tables_last_as_long_as_the_run(belt: tuple[Case, Read]) -> None:
    """Lead-in plus pass; both written with 1e-9 s."""
    _, read = belt
    total = sum(float(block.data[0].fields[1]) for block in read.deck.named("DYNAMIC"))
    for time, _ in read.amplitudes.values():
        assert time[0] == 0.0
        assert time[-1] == pytest.approx(total, abs=2e-9)


def test_plane_lies_under_the_block_all_through_the_run(belt: tuple[Case, Read]) -> None:
    """Both ends of every mount row in the plane's own frame stay 40 mm inside its ends."""
    _, read = belt
    surface = next(block for block in read.deck.named("SURFACE") if block.value("NAME") == "ROAD")
    begin, end = (float(line.fields[1]) for line in surface.data[2:])
    speed = read.held["ROAD_REF"][0][1]
    for _, start, table_x, _ in _rows(read):
        time = np.linspace(0.0, table_x[0][-1], 200)
        x = start[0] + _travel(time, table_x) - speed * time
        assert begin + 40.0 < x.min()
        assert x.max() < end - 40.0


@pytest.mark.parametrize("mounting", ["conforming", "flat"])
def test_rig_block_turns_as_one_with_its_ring_and_touches_at_the_end_of_the_lead_in(
    mounting: str, rig_case: Case, coarse: Callable[[Case], Case], tmp_path: Path
) -> None:
    """Turned by omega T about the axle, the leading face row is on the wheel (2e-5 mm), all others are off it."""
    case = coarse(replace(rig_case, block=rig_case.block.model_copy(update={"mounting": mounting})))
    read = _read(case, tmp_path)
    axle = read.points[read.sets["RING_REF"][0]]
    omega = read.held["RING_REF"][0][1]
    assert omega == pytest.approx(case.speed / 0.1, rel=1e-8)
    for node in read.sets["BLOCK_NODES"]:
        r = read.points[node][:2] - axle[:2]
        np.testing.assert_allclose(read.velocity[node][:2], omega * np.array([-r[1], r[0]]), atol=2e-3)
    angle = omega * LEAD_IN
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    place = np.array([axle[:2] + turn @ (read.points[node][:2] - axle[:2]) for node in read.sets["FACE_NODES"]])
    gap = np.hypot(place[:, 0], place[:, 1] + 300.0) - 300.0
    leading = place[:, 0] > place[:, 0].max() - 1.0
    np.testing.assert_allclose(gap[leading], 0.0, atol=2e-5)
    assert gap[~leading].min() > 0.1
    assert read.held["ROAD_REF"][0][1] == pytest.approx(-case.speed / 0.3, rel=1e-8)


def test_leading_edge_of_the_belt_block_touches_at_the_end_of_the_lead_in(belt: tuple[Case, Read]) -> None:
    """On the belt the bent block's face points are h below the mount along its normal: y = 0 at t = 0 (1e-5 mm)."""
    case, _ = belt
    path = path_of(case)
    _, y = path.free_face(np.linspace(0.0, path.columns.extent, 26), 0.0)
    assert y[0] == pytest.approx(0.0, abs=1e-8)
    assert np.all(y[1:] > 0.0)


@pytest.mark.parametrize("speed", [0.5, 3.0, 16.7, 40.0])
def test_block_is_clear_of_the_road_all_through_the_lead_in(
    speed: float, belt_case: Case, coarse: Callable[[Case], Case]
) -> None:
    """However slowly it rolls, the block bent half way has no face point at or below the road before t = 0.

    Face points: mount row plus the height along the normal of the mount between neighbouring rows.
    """
    from tread_validate.deck.placement import mount_motion

    path = path_of(coarse(replace(belt_case, speed=speed)))
    t = np.linspace(-LEAD_IN, 0.0, 81)[:-1]
    rows = np.linspace(0.0, 0.025, 26)
    x, y = (np.array(v) for v in zip(*(mount_motion(path, s, t, 0.0)[:2] for s in rows), strict=True))
    slope = np.arctan2(-np.gradient(y, axis=0), -np.gradient(x, axis=0))
    face = y - 0.008 * np.cos(slope)
    assert face.min() > -1e-6


def test_conforming_belt_block_needs_no_bending_on_the_arc(belt_case: Case) -> None:
    """Its stress-free mount is the arc itself: the rows follow the belt exactly from the start (1e-12 m)."""
    from tread_validate.deck.placement import mount_motion

    path = path_of(belt_case)
    t = np.linspace(-LEAD_IN, 0.0, 41)
    for s in (0.0, 0.0125, 0.025):
        x, y, vx, vy = mount_motion(path, s, t, 2.0)
        belt = path.at(s, t)
        np.testing.assert_allclose(x, belt.x, atol=1e-12)
        np.testing.assert_allclose(y, belt.y, atol=1e-12)
        np.testing.assert_allclose(vx, belt.velocity_x, atol=1e-9)
        np.testing.assert_allclose(vy, belt.velocity_y, atol=1e-9)
