"""Which part of the mount carries which place of the contact face, and how tall the block is there."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Columns:
    """The columns of a block between its mount and its face.

    A conforming block's face is parallel to its mount: every column is ``height`` tall and s is the arc on which the
    path counts. A flat-faced block on a wheel (``wheel_radius`` finite) stands on the ring with its face in the plane
    that touches the tread surface at the block's middle; its columns are the ring's radii, s is measured in that plane.

    Attributes
    ----------
    height : float, m
        Nominal height of the block.
    extent : float, m
        Length of the face from s = 0 to its far end.
    wheel_radius : float, m
        Radius of the tread surface under a flat-faced block; ``inf`` for a conforming one.
    together : bool
        Whether all columns are at one place of the path at one time: the block does not roll, and its columns stand
        side by side, the leading end ahead.
    """

    height: float
    extent: float
    wheel_radius: float = math.inf
    together: bool = False

    @property
    def are_equal(self) -> bool:
        """Whether one column's history, shifted in time, serves them all."""
        return math.isinf(self.wheel_radius) and not self.together

    def column_height(self, s: ArrayLike) -> NDArray[np.float64]:
        """Return the stress-free height of the columns at `s` (m), m."""
        s = np.asarray(s, dtype=np.float64)
        if math.isinf(self.wheel_radius):
            return np.full(s.shape, self.height)
        return np.hypot(self.wheel_radius, s - 0.5 * self.extent) - self.wheel_radius + self.height

    def arc_offset(self, s: ArrayLike) -> NDArray[np.float64]:
        """Return how far the column at `s` (m) follows the leading end's column along the path, m."""
        s = np.asarray(s, dtype=np.float64)
        if self.together:
            return np.zeros(s.shape)
        if self.are_equal:
            return s.copy()
        half = 0.5 * self.extent
        return self.wheel_radius * (np.arctan((s - half) / self.wheel_radius) + math.atan(half / self.wheel_radius))

    def x_offset(self, s: ArrayLike) -> NDArray[np.float64]:
        """Return how far the column at `s` (m) stands ahead of its place on the path, m; 0 on a rolling block."""
        s = np.asarray(s, dtype=np.float64)
        return 0.5 * self.extent - s if self.together else np.zeros(s.shape)
