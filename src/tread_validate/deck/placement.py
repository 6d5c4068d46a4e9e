"""Where the nodes of a block start, how fast, and how its mount moves: all in the axle frame, in mm and s.

Every pass is preceded by a lead-in. At its start the block is stress-free and moves as a rigid body; on the belt its
mount is then bent from the stress-free shape on to the belt by a ramp with continuous acceleration, complete at the
first touch (t = 0). On the rig the mount is rigid and there is nothing to bend.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry import Path
from ..units import DECK_LENGTH
from .mesh import BlockMesh

FloatArray = NDArray[np.float64]

LEAD_IN = 2.0e-3  # s, the same for every case
# Steps of the velocity tables: the trapezoidal rule then keeps the mount within 0.1 um of its path.
LEAD_IN_STEP = 25e-6  # s
ARC_STEP = 0.4e-3  # m
STRAIGHT = 1e-13  # relative bend of the velocity below which a table needs no point


@dataclass(frozen=True)
class Placement:
    """Start of a run.

    Attributes
    ----------
    points : (n, 3) array, mm
        Stress-free node positions at t = -LEAD_IN.
    velocities : (n, 2) array, mm/s
        x and y components of the rigid motion that the block starts with.
    """

    points: FloatArray
    velocities: FloatArray


@dataclass(frozen=True)
class MountTable:
    """Prescribed velocity of one row of mount nodes across the block.

    Attributes
    ----------
    s : float, mm
        The row's distance behind the leading corner.
    time_x, velocity_x, time_y, velocity_y : arrays, s and mm/s
        Velocity against total time (0 at the start of the lead-in), linear in between.
    """

    s: float
    time_x: FloatArray
    velocity_x: FloatArray
    time_y: FloatArray
    velocity_y: FloatArray


def place_on_wheel(mesh: BlockMesh, path: Path) -> Placement:
    """Place a block on the rig's ring: it already has its final shape, and turns about the axle."""
    s = mesh.s / DECK_LENGTH
    foot = path.at(s, -LEAD_IN)
    depth = (1.0 - mesh.u) * path.columns.column_height(s)
    x, y = foot.x + depth * np.sin(foot.theta), foot.y - depth * np.cos(foot.theta)
    # rigid: v = v_foot + omega x r, r from the foot to the node
    vx = foot.velocity_x - foot.angular_velocity * (y - foot.y)
    vy = foot.velocity_y + foot.angular_velocity * (x - foot.x)
    return _in_deck_units(mesh, x, y, vx, vy)


def place_on_belt(mesh: BlockMesh, path: Path, curvature: float) -> Placement:
    """Place a stress-free block of the given mount curvature (1/m; 0 flat) with its leading row on the belt."""
    s = mesh.s / DECK_LENGTH
    start = np.float64(-LEAD_IN)
    x, y, vx, vy = _rigid(path, s, (1.0 - mesh.u) * path.columns.height, start, curvature)
    return _in_deck_units(mesh, x, y, vx, vy)


def mount_motion(path: Path, s: float, t: FloatArray, curvature: float) -> tuple[FloatArray, ...]:
    """Return x, y (m) and their rates (m/s) of the mount row at `s` (m) at the times `t` (s, 0 at first touch).

    From the stress-free block's rigid motion at -LEAD_IN to the belt's path at 0 by the ramp
    ``10 q^3 - 15 q^4 + 6 q^5``, whose first two derivatives vanish at both ends; the path itself from then on.
    """
    belt = path.at(s, t)
    x, y, vx, vy = _rigid(path, np.full(t.shape, s), np.zeros(t.shape), t, curvature)
    q = np.clip(1.0 + t / LEAD_IN, 0.0, 1.0)
    ramp = q**3 * (10.0 - 15.0 * q + 6.0 * q * q)
    rate = 30.0 * q * q * (1.0 - q) ** 2 / LEAD_IN
    dx, dy = belt.x - x, belt.y - y
    return (
        x + ramp * dx,
        y + ramp * dy,
        vx + ramp * (belt.velocity_x - vx) + rate * dx,
        vy + ramp * (belt.velocity_y - vy) + rate * dy,
    )


def mount_tables(path: Path, rows: FloatArray, pass_time: float, curvature: float) -> list[MountTable]:
    """Return the velocity tables of the mount rows at `rows` (mm) for the lead-in and a pass of `pass_time` (s)."""
    end = LEAD_IN + pass_time
    lead_in = np.linspace(0.0, LEAD_IN, round(LEAD_IN / LEAD_IN_STEP) + 1)
    step = min(ARC_STEP / path.speed, path.finest_time)
    grid = np.concatenate([lead_in, np.arange(LEAD_IN + step, end, step), [end]])
    tables = []
    for row in rows:
        s = float(row) / DECK_LENGTH
        touch = path.first_touch_arc - float(path.columns.arc_offset(s))
        corners = LEAD_IN + (np.array(path.line.corners) - touch) / path.speed
        time = np.union1d(grid, corners[(corners > 0.0) & (corners < end)])
        time = np.unique(np.round(time, 9))
        _, _, vx, vy = mount_motion(path, s, time - LEAD_IN, curvature)
        limit = STRAIGHT * path.speed
        keep_x, keep_y = _bends(time, vx, limit), _bends(time, vy, limit)
        tables.append(
            MountTable(float(row), time[keep_x], vx[keep_x] * DECK_LENGTH, time[keep_y], vy[keep_y] * DECK_LENGTH)
        )
    return tables


def _rigid(
    path: Path, s: FloatArray, depth: FloatArray, t: FloatArray | np.float64, curvature: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return place and velocity of points of the stress-free block that rides with its leading row on the belt."""
    lead = path.at(0.0, t)
    angle = curvature * s
    # the mount behind the leading row: an arc of the block's own curvature, in the leading row's frame
    back = -s * np.sinc(angle / np.pi) - depth * np.sin(angle)
    up = s * np.sin(0.5 * angle) * np.sinc(0.5 * angle / np.pi) - depth * np.cos(angle)
    dx = back * np.cos(lead.theta) - up * np.sin(lead.theta)
    dy = back * np.sin(lead.theta) + up * np.cos(lead.theta)
    vx = lead.velocity_x - lead.angular_velocity * dy
    vy = lead.velocity_y + lead.angular_velocity * dx
    return lead.x + dx, lead.y + dy, vx, vy


def _bends(time: FloatArray, value: FloatArray, limit: float) -> NDArray[np.bool_]:
    """Return which points a piecewise-linear table cannot do without: the ends and where the slope changes."""
    kept = np.ones(time.size, dtype=np.bool_)
    weight = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    between = value[:-2] + weight * (value[2:] - value[:-2])
    kept[1:-1] = np.abs(value[1:-1] - between) > limit
    return kept


def _in_deck_units(mesh: BlockMesh, x: FloatArray, y: FloatArray, vx: FloatArray, vy: FloatArray) -> Placement:
    return Placement(
        np.column_stack([x * DECK_LENGTH, y * DECK_LENGTH, mesh.z]),
        np.column_stack([vx * DECK_LENGTH, vy * DECK_LENGTH]),
    )
