"""What the block's own frame does during a pass, and where its unloaded face would be in it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ...geometry import Path
from ...kernels import kernel
from ...study import Block
from ..inputs import Motion
from ..kinematics import mount_point
from .body import FreeShape
from .inputs import Singles
from .march import Course
from .store import ReadyFace

Array = NDArray[np.float64]


def free_shape(path: Path, block: Block) -> FreeShape:
    """Return the stress-free shape of a block on its path.

    On the rig the mount is the ring; a conforming block is a ring sector, a flat-faced one is not. On a belt a flat
    block is straight and a conforming one has the curvature of the belt where the block first touches.
    """
    flat = block.mounting == "flat"
    if path.line.ring_radius is not None:
        return FreeShape(1.0 / path.line.ring_radius, flat, path.line.speed_ratio)
    return FreeShape() if flat else FreeShape(path.block_curvature())


def motion(path: Path, ready: ReadyFace, bend: Singles, height: float, time: Array) -> Course:
    """Return frame and unloaded face at `time` (m,) in s.

    `bend` (9 e, 2 k) are the gradients in the elements of `SecondOrder` for unit displacement of each knot.

    The block bends as its mount does; a rigid mount leaves the unloaded face as it is.
    """
    body, middle = ready.body, 0.5 * path.columns.extent
    x, y, theta = _places(path, middle, time)
    origin = np.column_stack([x, y])
    if path.line.ring_radius is not None:
        raised = ready.polygon.rise(body.face[None], path.road.radius)
        return Course(time, theta, origin, body.face[None], np.zeros((1, 0), dtype=np.float32), raised)
    cosine, sine = np.cos(theta)[:, None], np.sin(theta)[:, None]
    columns = middle - body.knots
    line = Motion(path.line.code, path.line.parameters, path.line.table, path.speed, path.line.speed_ratio, 0.0, 0.0)
    knots = _mount_points(line, path.column_arc(columns, time[:, None]))
    dx, dy = knots[0] + path.columns.x_offset(columns) - x[:, None], knots[1] - y[:, None]
    free = ready.shape.mount(body.knots, height)
    moved = np.hstack([cosine * dx + sine * dy - free[:, 0], cosine * dy - sine * dx - free[:, 1]])
    unloaded = (moved @ ready.follow.T).reshape(time.size, -1, 3)
    unloaded += body.face
    gradients = moved.astype(np.float32) @ bend.T
    raised = ready.polygon.rise(unloaded, path.road.radius)
    return Course(time, theta, origin, unloaded, gradients, raised)


def _places(path: Path, s: Array | float, time: Array) -> tuple[Array, Array, Array]:
    """Return x, y (m) and theta (rad) of the mount points of the columns at `s` (m) at `time` (s), broadcast."""
    x, y, theta = path.mount(path.column_arc(s, time))
    return x + path.columns.x_offset(s), y, theta


@kernel()
def _mount_points(line: Motion, arcs: Array) -> Array:
    """Return x and y (m) of the mount line at arcs (m, k), (2, m, k): a fourth of the time of `Path.mount`."""
    found = np.empty((2, *arcs.shape))
    for i in range(arcs.shape[0]):
        for k in range(arcs.shape[1]):
            point = mount_point(line, arcs[i, k])
            found[0, i, k], found[1, i, k] = point[0], point[1]
    return found
