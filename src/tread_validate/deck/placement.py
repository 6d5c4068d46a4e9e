"""Where the nodes of a block start, how fast, and how its mount moves: all in the axle frame, in mm and s.

Every pass is preceded by a lead-in. At its start the block is stress-free and moves as a rigid body; on the belt its
mount is then bent from the stress-free shape on to the belt by a ramp with continuous acceleration, complete at the
first contact (t = 0). On the rig the mount is rigid and there is nothing to bend.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry import Path
from ..units import DECK_LENGTH
from .block_mesh import BlockMesh

FloatArray = NDArray[np.float64]

LEAD_IN = 2.0e-3  # s, the same for every case
# Steps of the velocity tables: the trapezoidal rule then keeps the mount within 0.1 um of its path.
LEAD_IN_STEP = 25e-6  # s
ARC_STEP = 0.4e-3  # m
STRAIGHT = 1e-13  # relative bend of the velocity below which a table needs no point


@dataclass(frozen=True)
class Placement:
    """Start of a run: a stress-free block in a frame of its own, and that frame's place and rigid motion.

    The frame's origin is the mount above the leading corner (s = 0); its x axis runs along the mount's tangent there,
    its y axis away from the road. The block in it is the same for all cases of one block on one kind of mount.

    Attributes
    ----------
    local : (n, 3) array, mm
        Node positions in that frame.
    origin : (2,) array, mm
        x and y of the frame's origin at t = -LEAD_IN.
    angle : float, rad
        Turn of the frame about z.
    velocity : (2,) array, mm/s
        Of the origin.
    spin : float, rad/s
        Rate of turn about z.
    """

    local: FloatArray
    origin: FloatArray
    angle: float
    velocity: FloatArray
    spin: float

    @property
    def points(self) -> FloatArray:
        """Stress-free node positions in space at t = -LEAD_IN, (n, 3), mm."""
        return self.placed(self.local)

    @property
    def written(self) -> FloatArray:
        """The local positions as a deck's text has them, to 1e-5 mm."""
        return np.asarray(np.round(self.local, 5) + 0.0, dtype=np.float64)  # -0 becomes 0

    def placed(self, local: FloatArray) -> FloatArray:
        """Return positions (n, 3) of the frame as they are in space."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        x, y = local[:, 0], local[:, 1]
        return np.column_stack([self.origin[0] + c * x - s * y, self.origin[1] + s * x + c * y, local[:, 2]])


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


def place(mesh: BlockMesh, path: Path, curvature: float) -> Placement:
    """Place a stress-free block with its leading row on the mount's path.

    `curvature` is that of the stress-free block's mount: the ring's on the rig, the belt's for a conforming block on
    the belt, 0 for a flat one (1/m).
    """
    s = mesh.s / DECK_LENGTH
    column = path.columns.column_height(s) if curvature > 0.0 else np.full(s.shape, path.columns.height)
    arc = s if path.columns.together else path.columns.arc_offset(s) * path.line.speed_ratio
    x, y = _in_leading_frame(arc, (1.0 - mesh.u) * column, curvature)
    lead = path.at(0.0, -LEAD_IN)
    return Placement(
        local=np.column_stack([x * DECK_LENGTH, y * DECK_LENGTH, mesh.z]),
        origin=np.array([float(lead.x), float(lead.y)]) * DECK_LENGTH,
        angle=float(lead.theta),
        velocity=np.array([float(lead.velocity_x), float(lead.velocity_y)]) * DECK_LENGTH,
        spin=float(lead.angular_velocity),
    )


def mount_motion(path: Path, s: float, t: FloatArray, curvature: float) -> tuple[FloatArray, ...]:
    """Return x, y (m) and their rates (m/s) of the mount row at `s` (m) at the times `t` (s, 0 at first contact).

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
        touch = path.first_contact_arc - float(path.columns.arc_offset(s))
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
    back, up = _in_leading_frame(s, depth, curvature)
    dx = back * np.cos(lead.theta) - up * np.sin(lead.theta)
    dy = back * np.sin(lead.theta) + up * np.cos(lead.theta)
    vx = lead.velocity_x - lead.angular_velocity * dy
    vy = lead.velocity_y + lead.angular_velocity * dx
    return lead.x + dx, lead.y + dy, vx, vy


def _in_leading_frame(s: FloatArray, depth: FloatArray, curvature: float) -> tuple[FloatArray, FloatArray]:
    """Return x and y, in the leading row's frame, of points `depth` below the mount at the arc `s` behind that row.

    The mount is an arc of the block's own curvature (SI throughout).
    """
    angle = curvature * s
    back = -s * np.sinc(angle / np.pi) - depth * np.sin(angle)
    up = s * np.sin(0.5 * angle) * np.sinc(0.5 * angle / np.pi) - depth * np.cos(angle)
    return back, up


def _bends(time: FloatArray, value: FloatArray, limit: float) -> NDArray[np.bool_]:
    """Return which points a piecewise-linear table cannot do without: the ends and where the slope changes."""
    kept = np.ones(time.size, dtype=np.bool_)
    weight = (time[1:-1] - time[:-2]) / (time[2:] - time[:-2])
    between = value[:-2] + weight * (value[2:] - value[:-2])
    kept[1:-1] = np.abs(value[1:-1] - between) > limit
    return kept
