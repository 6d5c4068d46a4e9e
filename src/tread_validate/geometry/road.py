"""The rigid surface that the block meets: a plane or the big wheel's circle, touching y = 0 at x = 0."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Road:
    """A rigid road in the axle frame.

    Attributes
    ----------
    radius : float, m
        Radius of the big wheel, whose centre is at (0, -radius); ``inf`` for the plane y = 0. A point of the road
        moves along it at the surface speed times (1 + creep ratio), towards +x at the top.
    """

    radius: float = math.inf

    @property
    def is_plane(self) -> bool:
        """Whether the road is the plane y = 0."""
        return math.isinf(self.radius)

    def gap(self, x: ArrayLike, y: ArrayLike) -> NDArray[np.float64]:
        """Return the distance of points (m) from the road, negative inside it, m."""
        x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        if self.is_plane:
            return y.copy()
        return np.asarray(np.hypot(x, y + self.radius) - self.radius, dtype=np.float64)
