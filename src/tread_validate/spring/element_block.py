"""The paper's springs as a state that a host advances: every element follows its own point of the mount.

Between two poses an element's point of the mount moves with an even turn and even speeds along and across itself, which
is exact on a wheel, on an arc and on a straight. Elements are those of `BlockPass.elements`; each goes through the
kernel of the pass, whose nodes are the host's steps.
"""

from __future__ import annotations

import copy
import math

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..kernels import kernel
from ..study import Case
from .block_pass import SLIP_TOLERANCE, prepare
from .element import touch
from .element_record import COLUMNS, GONE, PRESSURE, SHEAR, ElementState
from .element_step import advance
from .inputs import KernelLaw, Memory, Motion, Rubber
from .kinematics import mount_point
from .memory import TICKS, memory_of

Array = NDArray[np.float64]

WAITING = 3
"""Mode of an element that has not touched yet."""
CLOSE = 1e-6
"""Part of a tick by which a touch may come late."""


class ElementBlock:
    """A row of springs in the hands of a host; see `tread_validate.TreadBlock`.

    An element touches once: one that has let go stays free until the next `start`.
    """

    def __init__(self, case: Case) -> None:
        ready = prepare(case)
        path = ready.path
        edges, middles = ready.elements()
        self._areas = np.asarray(path.profile.cell_areas(edges))
        self._heights = np.array([float(path.columns.column_height(s)) for s in middles])
        self._rubber, self._law = ready.rubber, ready.law
        self._tolerance = SLIP_TOLERANCE * path.interference
        self._curvature = 0.0 if path.road.is_plane else 1.0 / path.road.radius
        self.mount_points = 0.5 * path.columns.extent - middles
        if path.line.ring_radius is not None:  # the mount is rigid: its shape is that at any time
            at, own = path.at(0.5 * path.columns.extent, 0.0), path.at(middles, 0.0)
            cosine, sine = math.cos(float(at.theta)), math.sin(float(at.theta))
            dx, dy = own.x - at.x, own.y - at.y
            self._shape = np.column_stack([cosine * dx + sine * dy, cosine * dy - sine * dx, own.theta - at.theta])
        else:
            bend = 0.0 if case.block.mounting == "flat" else path.block_curvature()
            turn = bend * self.mount_points
            chord = self.mount_points * np.sinc(0.5 * turn / np.pi)
            self._shape = np.column_stack([chord * np.cos(0.5 * turn), chord * np.sin(0.5 * turn), turn])
        self._memory: Memory | None = None
        self._places: Array | None = None
        self._states = self._fresh()

    def start(self, position: Array, angle: float, mount: Array | None) -> None:
        """Forget the past; the block is stress-free at this pose."""
        self._places = self._poses(position, angle, mount)
        self._states = self._fresh()

    def step(
        self, dt: float, position: Array, angle: float, road_speed: float, mount: Array | None
    ) -> tuple[float, float]:
        """Advance by `dt` to a pose; return N and T."""
        if self._places is None:
            raise InputError("tread block", "a step before the start", "start(position, angle) first")
        if self._memory is None or self._memory.step != dt:
            self._memory = memory_of(self._rubber, dt)
        places = self._poses(position, angle, mount)
        road = (self._curvature, road_speed)
        block = (self._heights, self._areas, self._tolerance)
        forces = step_elements(self._places, places, road, self._rubber, self._law, self._memory, block, self._states)
        self._places = places
        return float(forces[0]), -float(forces[1])

    def copy(self) -> ElementBlock:
        """Return the block with a state of its own."""
        twin = copy.copy(self)
        twin._states = copy.deepcopy(self._states)
        return twin

    def _fresh(self) -> ElementState:
        count, terms = self._areas.size, self._rubber.moduli.size
        codes = np.zeros((count, 3), dtype=np.int64)
        codes[:, 0] = WAITING
        return ElementState(
            np.zeros((count, terms)), np.zeros((count, terms)), np.zeros((count, 10)), codes, np.zeros((count, 8))
        )

    def _poses(self, position: Array, angle: float, mount: Array | None) -> Array:
        """Return x, y (m) and slope of every element's point of the mount, (n, 3)."""
        if mount is None:
            cosine, sine = math.cos(angle), math.sin(angle)
            x, y, turn = self._shape.T
            return np.column_stack(
                [position[0] + cosine * x - sine * y, position[1] + sine * x + cosine * y, angle + turn]
            )
        if mount.shape[1] == 3:
            return np.ascontiguousarray(mount)
        slope = np.gradient(mount[:, 1], self.mount_points) / np.gradient(mount[:, 0], self.mount_points)
        return np.column_stack([mount, np.arctan(slope)])


@kernel()
def step_elements(
    before: Array,
    after: Array,
    road: tuple[float, float],
    rubber: Rubber,
    law: KernelLaw,
    memory: Memory,
    block: tuple[Array, Array, float],
    states: ElementState,
) -> tuple[float, float]:
    """Advance all elements by a step from the poses `before` to `after`, (n, 3); return sums of F_r and F_l, N.

    `road` is curvature (1/m) and speed (m/s); `block` is heights (n,), areas (n,) and tolerance of slip (m).
    """
    heights, areas, tolerance = block
    normal, shear = 0.0, 0.0
    record = np.zeros((2, COLUMNS))
    no_corners = np.zeros(0, dtype=np.int64)
    for k in range(areas.size):
        if states.codes[k, 0] == GONE:
            continue
        state = ElementState(
            states.radial[k], states.longitudinal[k], states.numbers[k], states.codes[k], states.integrals[k]
        )
        motion = _between(before[k], after[k], memory.step, road[0], road[1])
        record[:] = 0.0
        first = 0
        if state.codes[0] == WAITING:
            first = _touch_tick(motion, heights[k], memory.step)
            if first > TICKS:
                continue
            touch(motion, rubber, heights[k], first * (memory.step / TICKS), state)
        if first < TICKS:
            advance(motion, rubber, law, memory, heights[k], 0.0, first, no_corners, tolerance, state, record)
            normal += areas[k] * record[1, PRESSURE]
            shear += areas[k] * record[1, SHEAR]
        else:
            normal += areas[k] * state.numbers[6]
    return normal, shear


@kernel()
def _between(a: Array, b: Array, dt: float, road_curvature: float, road_speed: float) -> Motion:
    """Return the even motion from one pose to another; its arc is the time."""
    half = 0.5 * (b[2] - a[2])
    slant = a[2] + half
    rate = 1.0 / dt if abs(half) < 1e-9 else half / (math.sin(half) * dt)
    dx, dy = (b[0] - a[0]) * rate, (b[1] - a[1]) * rate
    sine, cosine = math.sin(slant), math.cos(slant)
    along, down = dx * cosine + dy * sine, dx * sine - dy * cosine
    parameters = np.array([a[0], a[1], a[2], 2.0 * half / dt, along, down])
    return Motion(4, parameters, np.zeros((1, 4)), 1.0, along, road_curvature, road_speed)


@kernel()
def _touch_tick(motion: Motion, height: float, dt: float) -> int:
    """Return the tick of the step at which a free element first meets the road; more than TICKS if it does not."""
    if _clearance(motion, height, dt) > 0.0:
        return TICKS + 1
    low, high = 0.0, 1.0
    if _clearance(motion, height, 0.0) <= 0.0:
        high = 0.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        if _clearance(motion, height, middle * dt) > 0.0:
            low = middle
        else:
            high = middle
    return math.ceil(high * TICKS - CLOSE)


@kernel()
def _clearance(motion: Motion, height: float, time: float) -> float:
    """Return how far the end of a free element is above the road, m."""
    x, y, sine, cosine, _turn, _down = mount_point(motion, time)
    ex, ey = x + height * sine, y - height * cosine
    if motion.road_curvature == 0.0:
        return ey
    radius = 1.0 / motion.road_curvature
    return math.hypot(ex, ey + radius) - radius


def block_of(case: Case) -> ElementBlock:
    """Return the case's block as a state that a host advances."""
    return ElementBlock(case)
