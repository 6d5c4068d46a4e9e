"""Curvature of a sampled line by the circle through three points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def three_point_curvature(x: Array, y: Array, neighbour: int = 1) -> Array:
    """Return the signed curvature, 1/m, of the circle through each point and its two neighbours, (n,).

    `x`, `y` in m, (n,), x increasing. Positive where the line bends towards +y. The first and last `neighbour` points
    and points whose neighbours are missing (NaN) are NaN. kappa = 2 (u x v)/(|u| |v| |u + v|), with u and v the chords
    to the point and from it: exact for points on a circle at any spacing.
    """
    curvature = np.full(x.size, np.nan)
    k = neighbour
    if x.size <= 2 * k:
        return curvature
    ux, uy = x[k:-k] - x[: -2 * k], y[k:-k] - y[: -2 * k]
    vx, vy = x[2 * k :] - x[k:-k], y[2 * k :] - y[k:-k]
    curvature[k:-k] = 2.0 * (ux * vy - uy * vx) / (np.hypot(ux, uy) * np.hypot(vx, vy) * np.hypot(ux + vx, uy + vy))
    return curvature
