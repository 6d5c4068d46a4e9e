"""From a smoothed ridge trace to the line that the mount follows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .line import TabulatedLine

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]
ARC_STEP = 0.25e-3
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(5)
STEEPEST = 3.0


def line_from_trace(x: Array, height: Array, patch_height: float, where: str = "trace") -> TabulatedLine:
    """Return the mount line through a smoothed trace.

    A cubic spline through the points makes slope and curvature continuous, so that the mount has no jumps of
    velocity; its slope at a point agrees to second order in the pitch with the three-point slope
    ``atan((y[i-1] - y[i+1])/(x[i-1] - x[i+1]))`` of the paper's Eq. (13).

    Parameters
    ----------
    x : (n,) array, m
        Along the direction of travel, strictly increasing, n >= 5; the arc is counted from x = 0.
    height : (n,) array, m
        Height of the belt over its flat level, positive away from the road.
    patch_height : float, m
        Height of the mount over the road where `height` is 0.
    where : str
        What to name in an error.
    """
    if x.shape != height.shape or x.ndim != 1 or x.size < 5:
        raise InputError(where, f"{x.size} places and {height.size} heights", "as many heights as places, at least 5")
    if not (np.all(np.isfinite(x)) and np.all(np.isfinite(height))):
        raise InputError(where, "a value that is not finite", "finite numbers")
    if not np.all(np.diff(x) > 0.0):
        raise InputError(where, "places out of order or given twice", "places that increase")
    if not x[0] < 0.0 < x[-1]:
        raise InputError(where, f"places from {x[0]:g} to {x[-1]:g} m", "places on both sides of 0, the patch's middle")
    from scipy.interpolate import CubicSpline

    curve = CubicSpline(x, height)
    if np.max(np.abs(curve(x, 1))) > STEEPEST:
        raise InputError(where, "a slope of more than 70 deg", "a belt trace in metres over metres")
    return _tabulate(curve, x, patch_height)


def _tabulate(curve: CubicSpline, x: Array, patch_height: float) -> TabulatedLine:
    """Resample a curve y(x) at equal arcs, arc 0 at x = 0."""
    from scipy.interpolate import CubicSpline

    knots = np.linspace(x[0], x[-1], max(8 * x.size, 1000))
    half = 0.5 * np.diff(knots)
    nodes = 0.5 * (knots[1:] + knots[:-1])[:, None] + half[:, None] * GAUSS_X
    lengths = half * (np.hypot(1.0, curve(nodes, 1)) @ GAUSS_W)
    arc = np.concatenate([[0.0], np.cumsum(lengths)])
    x_of_arc = CubicSpline(arc, knots)
    middle = _arc_at(0.0, arc, knots, curve)
    first = np.ceil((arc[0] - middle) / ARC_STEP) * ARC_STEP
    count = int(np.floor((arc[-1] - middle - first) / ARC_STEP)) + 1
    places = x_of_arc(middle + first + ARC_STEP * np.arange(count))
    slope, bend = curve(places, 1), curve(places, 2)
    table = np.column_stack([places, patch_height + curve(places), np.arctan(slope), bend / np.hypot(1.0, slope) ** 3])
    return TabulatedLine(float(first), ARC_STEP, np.ascontiguousarray(table))


def _arc_at(x: float, arc: Array, knots: Array, curve: CubicSpline) -> float:
    """Return the arc at one place, by the same quadrature."""
    index = int(np.clip(np.searchsorted(knots, x) - 1, 0, knots.size - 2))
    half = 0.5 * (x - knots[index])
    nodes = knots[index] + half * (1.0 + GAUSS_X)
    return float(arc[index] + half * (np.hypot(1.0, curve(nodes, 1)) @ GAUSS_W))
