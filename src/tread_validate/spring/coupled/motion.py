"""What the block's own frame does during a pass, and where its unloaded face would be in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...geometry import Path
from ...study import Block
from .body import Body, FreeShape
from .condense import FaceStiffness

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """Frame and unloaded face at m times.

    Attributes
    ----------
    time : (m,) array, s
    origin : (m, 2) array, m
        Mount above the middle of the block, in the axle frame.
    angle : (m,) array, rad
        Slope of the mount there.
    unloaded : (m, n, 3) array, m
        Positions of the face's nodes in the block's frame if no force acted on the face: the block bends as its mount
        does. Constant for a rigid mount.
    """

    time: Array
    origin: Array
    angle: Array
    unloaded: Array


def free_shape(path: Path, block: Block) -> FreeShape:
    """Return the stress-free shape of a block on its path.

    On the rig the mount is the ring; a conforming block is a ring sector, a flat-faced one is not. On a belt a flat
    block is straight and a conforming one has the curvature of the belt where the block first touches.
    """
    flat = block.mounting == "flat"
    if path.line.code == 1:
        return FreeShape(1.0 / float(path.line.parameters[1]), flat, path.line.speed_ratio)
    return FreeShape() if flat else FreeShape(float(path.line.curvature(path.first_touch_arc)))


def motion(path: Path, shape: FreeShape, body: Body, face: FaceStiffness, height: float, time: Array) -> Motion:
    """Return frame and unloaded face of `body` at `time` (m,) in s."""
    middle = 0.5 * path.columns.extent
    at = path.at(middle, time)
    cosine, sine = np.cos(at.theta)[:, None], np.sin(at.theta)[:, None]
    knots = path.at(middle - body.knots, time[:, None])
    dx, dy = knots.x - at.x[:, None], knots.y - at.y[:, None]
    free = shape.mount(body.knots, height)
    moved = np.hstack([cosine * dx + sine * dy - free[:, 0], cosine * dy - sine * dx - free[:, 1]])
    follow = (moved @ face.follow.T).reshape(time.size, -1, 3)
    return Motion(time, np.column_stack([at.x, at.y]), np.asarray(at.theta), body.face + follow)
