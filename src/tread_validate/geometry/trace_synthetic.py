"""Synthetic ridge heights with the features that the paper states of its belt trace (section 3.1 and Fig. 8)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

PITCH = 2e-3
RESOLUTION = 10e-6
HALF_SPAN = 0.25
EDGE_CURVATURE = 2.0
LARGEST_CURVATURE = 5.0
UNLOADED_CURVATURE = 3.0
RIDGES = {"top": 0.160, "mid_top": 0.170, "mid_bottom": 0.170, "bottom": 0.158}  # patch length, m
SPIKE = ("mid_top", 31e-3, 25e-6)  # ridge, position and height of the one bad point, m


@dataclass(frozen=True)
class SyntheticRidges:
    """Raw heights as a coordinate measuring machine would give them, and the line behind them.

    Attributes
    ----------
    position : (n,) array, m
    heights, exact : mapping of ridge name to (n,) array, m
        Measured (NaN: gap) and exact; the exact line is level and starts from the patch.
    """

    position: Array
    heights: dict[str, Array]
    exact: dict[str, Array]


def curvature(distance: Array) -> Array:
    """Return the belt's curvature in 1/m at `distance` in m outside the patch edge (negative: inside).

    0 in the patch, 2 1/m at its edge (reached over 4 mm), 5 1/m at 70 mm, 3 1/m (unloaded) from 140 mm on.
    """

    def smooth(u: Array) -> Array:
        u = np.clip(u, 0.0, 1.0)
        return np.asarray(u * u * (3.0 - 2.0 * u), dtype=np.float64)

    step = np.clip(0.5 + distance / 4e-3, 0.0, 1.0)
    rise = (LARGEST_CURVATURE - EDGE_CURVATURE) * smooth((distance - 8e-3) / 62e-3)
    fall = (LARGEST_CURVATURE - UNLOADED_CURVATURE) * smooth((distance - 70e-3) / 70e-3)
    return np.asarray(step * EDGE_CURVATURE + rise - fall, dtype=np.float64)


def exact_height(x: Array, patch_length: float) -> Array:
    """Return the height in m above the patch at x in m from its middle: curvature integrated along the arc."""
    from scipy.integrate import cumulative_trapezoid

    arc = np.linspace(-5e-3, 2.0 * HALF_SPAN, 100_001)
    slope = cumulative_trapezoid(curvature(arc), arc, initial=0)
    outside = arc[0] + cumulative_trapezoid(np.cos(slope), arc, initial=0)
    height = cumulative_trapezoid(np.sin(slope), arc, initial=0)
    return np.asarray(np.interp(np.abs(x) - 0.5 * patch_length, outside, height), dtype=np.float64)


def synthetic_ridges(seed: int = 8) -> SyntheticRidges:
    """Return four ridges at 2 mm pitch and 10 um resolution with tilt, offset, noise, gaps and one spike."""
    random = np.random.default_rng(seed)
    centre = 0.2507  # the machine's origin is not the patch's middle
    position = np.arange(0.0, 2.0 * HALF_SPAN + 0.5 * PITCH, PITCH)
    x = position - centre
    heights: dict[str, Array] = {}
    exact: dict[str, Array] = {}
    for number, (name, length) in enumerate(RIDGES.items()):
        exact[name] = exact_height(x, length)
        tilt, offset = random.normal(0.0, 4e-3), 12e-3 + random.normal(0.0, 0.5e-3)
        raw = exact[name] + tilt * position + offset + random.normal(0.0, 3e-6, x.size)
        if name == SPIKE[0]:
            raw[np.argmin(np.abs(x - SPIKE[1]))] += SPIKE[2]
        raw = np.round(raw / RESOLUTION) * RESOLUTION
        gap = 40 + 45 * number
        if name != SPIKE[0]:
            raw[gap : gap + 3] = np.nan
        heights[name] = raw
    return SyntheticRidges(position, heights, exact)
