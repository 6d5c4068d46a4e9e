"""March of a condensed viscoelastic block through its pass, in compiled code."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...kernels import kernel
from .contact import Tempo
from .inputs import FREE, ROWS, SLIP, Array, FaceState, Integers, Pose, Scene, Scratch, Singles, Windows
from .products import operator_at
from .second_order import follow_up, rest, shifted
from .step import approach, hold, put, settle, widest


class Course(NamedTuple):
    """The motion of the mount over a pass.

    Attributes
    ----------
    time, angle : (m,) arrays, s and rad
    origin : (m, 2) array, m
    unloaded : (m, n, 3) or (1, n, 3) array, m
        One entry stands for a rigid mount.
    bend : (m, 9 e) or (1, 9 e) array
        As in `Pose`.
    rise : (m,) or (1,) array, m
        As in `Pose`.
    """

    time: Array
    angle: Array
    origin: Array
    unloaded: Array
    bend: Singles = np.zeros((1, 0), dtype=np.float32)
    rise: Array = np.zeros(1)


class Record(NamedTuple):
    """What a pass leaves: forces (m, n, 3) in N in the axle frame, displacements, states and sweeps; and sums.

    The first three have no rows where nodes are not asked for. `sums` (m, 4): force along x and y (N), touching and
    slipping area (m2), of the half block where that is modelled.
    """

    force: Array
    displacement: Array
    code: Integers
    sweeps: Integers
    sums: Array


def record_of(steps: int, nodes: int, nodal: bool = True) -> Record:
    """Return an empty record; `nodal`: with what each node does."""
    kept = steps if nodal else 0
    return Record(
        np.zeros((kept, nodes, 3)), np.zeros((kept, nodes, 3)), np.zeros((kept, nodes), dtype=np.int64),
        np.zeros(steps, dtype=np.int64), np.zeros((steps, 4)),
    )  # fmt: skip


@kernel()
def pose_at(course: Course, k: int) -> Pose:
    """Return the pose at the k-th time."""
    unloaded = course.unloaded[k if course.unloaded.shape[0] > 1 else 0]
    bend = course.bend[k if course.bend.shape[0] > 1 else 0]
    rise = course.rise[k if course.rise.size > 1 else 0]
    return Pose(course.origin[k, 0], course.origin[k, 1], course.angle[k], unloaded, bend, rise)


def clear_at_first(course: Course, road_radius: float) -> bool:
    """Tell whether no node of the unloaded face is in the road at the first time.

    `road_radius` (m) is inf for a plane.
    """
    x, y = course.unloaded[0, :, 0], course.unloaded[0, :, 1]
    cosine, sine = np.cos(course.angle[0]), np.sin(course.angle[0])
    along = course.origin[0, 0] + cosine * x - sine * y
    up = course.origin[0, 1] + sine * x + cosine * y - course.rise[0]
    if np.isinf(road_radius):
        return bool(np.all(up > 0.0))
    return bool(np.all(along**2 + (up + road_radius) ** 2 > road_radius**2))


@kernel()
def start(pose: Pose, scene: Scene, state: FaceState, work: Scratch) -> None:
    """Put the unloaded face where the mount holds it."""
    put(rest(pose, scene, state, work), state)


@kernel()
def march(
    begin: int, course: Course, scene: Scene, windows: Windows, state: FaceState, work: Scratch, record: Record
) -> tuple[int, int, int]:
    """Put the unloaded face in its place at the time 0, or run steps from the time `begin` on.

    Returns (number of times, 0, 0) at the end of the pass; else the time at which a window is needed that is not there
    yet, and its cells a, b: call again from that time.
    """
    if begin == 0:
        start(pose_at(course, 0), scene, state, work)
    for k in range(max(begin, 1), course.time.size):
        dt = course.time[k] - course.time[k - 1]
        a, b, sweeps = take_step(pose_at(course, k), dt, scene, windows, state, work)
        if sweeps < 0:
            return k, a, b
        record.sweeps[k] = sweeps
        _add_up(course.angle[k], scene.face.area, state, record.sums[k])
        if record.code.shape[0] > 0:
            _write(course.angle[k], state, record, k)
    return course.time.size, 0, 0


@kernel()
def take_step(
    pose: Pose, dt: float, scene: Scene, windows: Windows, state: FaceState, work: Scratch
) -> tuple[int, int, int]:
    """Advance the state by `dt` to a pose; return the window's cells and the sweeps.

    Sweeps of -1 say that the window's operator is not there yet; the state is then as it was.
    """
    unshifted, pose = pose, shifted(pose, scene, state, dt, work)
    stiffening, first, last, lands = approach(pose, scene, state, dt, work)
    tempo = Tempo(stiffening, dt)
    a, b, sweeps = 0, 0, 0
    while True:
        begin, end = 0, 0
        operator = operator_at(windows, 0, 0)
        if last > first:
            a, b = cells_of(scene.face.row, windows.first.size - 1, first, last)
            offset = windows.offset[a, b]
            if offset < 0:
                state.code[:] = work.before
                return a, b, -1
            begin, end = windows.first[a], windows.first[b]
            operator = operator_at(windows, offset, 3 * (end - begin))
        sweeps += hold(operator, windows, begin, end, lands, pose, scene, tempo, state, work)
        first, last = widest(pose, scene, state, tempo, begin, end, work)
        if first == begin and last == end:
            break
    settle(pose, scene.solid, state, tempo, work)
    follow_up(unshifted, scene.second, state, dt, work)
    return a, b, sweeps


@kernel()
def cells_of(row: Integers, cells: int, first: int, last: int) -> tuple[int, int]:
    """Return the cells a..b-1 that hold the nodes first..last-1; `widest` asks for more where that is not enough."""
    a = row[first] // ROWS
    b = min(row[last - 1] // ROWS + 1, cells)
    return a, b


@kernel()
def _add_up(angle: float, area: Array, state: FaceState, sums: Array) -> None:
    x, y, touching, slipping = 0.0, 0.0, 0.0, 0.0
    for i in range(area.size):
        if state.code[i] != FREE:
            x += state.force[i, 0]
            y += state.force[i, 1]
            touching += area[i]
            if state.code[i] == SLIP:
                slipping += area[i]
    cosine, sine = np.cos(angle), np.sin(angle)
    sums[0], sums[1], sums[2], sums[3] = cosine * x - sine * y, sine * x + cosine * y, touching, slipping


@kernel()
def _write(angle: float, state: FaceState, record: Record, k: int) -> None:
    cosine, sine = np.cos(angle), np.sin(angle)
    for i in range(state.w.shape[0]):
        x, y = state.force[i, 0], state.force[i, 1]
        record.force[k, i, 0] = cosine * x - sine * y
        record.force[k, i, 1] = sine * x + cosine * y
        record.force[k, i, 2] = state.force[i, 2]
        record.code[k, i] = state.code[i]
    record.displacement[k] = state.w
