"""Plan shape of a tread block: how wide its contact face is at each distance from its leading end."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..units import DEG, MM
from .tread_block import Block


@dataclass(frozen=True)
class WidthProfile:
    """Width w(s) of the contact face as a piecewise-linear function with jumps.

    ``w(s) = sum_k jump_k H(s - s_k) + sum_k kink_k max(s - s_k, 0)``, H the unit step.

    Attributes
    ----------
    positions : (n,) array, m
        Places s_k where the width jumps or its slope changes, s = 0 at the end that touches first, in order.
    jumps : (n,) array, m
        Jump of the width at each place.
    kinks : (n,) array, dimensionless
        Change of the width's slope at each place.
    """

    positions: NDArray[np.float64]
    jumps: NDArray[np.float64]
    kinks: NDArray[np.float64]

    @property
    def extent(self) -> float:
        """Length from the first to the last point of the face in the rolling direction, m."""
        return float(self.positions[-1])

    @property
    def area(self) -> float:
        """Area of the contact face, m2."""
        rest = self.positions[-1] - self.positions
        return float(np.sum(self.jumps * rest + 0.5 * self.kinks * rest**2))

    def width(self, s: ArrayLike) -> NDArray[np.float64]:
        """Return the width at the places `s` (any shape, m), in m; 0 outside the block."""
        ahead = np.asarray(s, dtype=np.float64)[..., None] - self.positions
        inside = (ahead[..., 0] >= 0.0) & (ahead[..., -1] <= 0.0)
        value = np.sum(np.where(ahead >= 0.0, self.jumps + self.kinks * ahead, 0.0)[..., :-1], axis=-1)
        return np.where(inside, np.maximum(value, 0.0), 0.0)

    def cell_areas(self, edges: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the area of the face between neighbouring `edges` ((n+1,) array, m), (n,) array, m2."""
        ahead = np.maximum(edges[:, None] - self.positions, 0.0)
        return np.diff(np.sum(self.jumps * ahead + 0.5 * self.kinks * ahead**2, axis=1))


def block_profile(block: Block) -> WidthProfile:
    """Return the width profile of a block.

    A parallelogram's leading and trailing edges stand at ``skew_deg`` to the axle, so that each row of it is
    ``length_mm`` long and starts ``z tan(skew)`` behind the leading corner; its area is length times width. Sipes are
    gaps parallel to those edges, at ``position_mm`` from the leading end of every row.
    """
    length, width = block.length_mm * MM, block.width_mm * MM
    ramp = width * math.tan(abs(block.skew_deg) * DEG) if block.shape == "parallelogram" else 0.0
    jumps: dict[float, float] = {}
    kinks: dict[float, float] = {}
    for start, end in _solid_parts(block, length):
        for place, sign in ((start, 1.0), (end, -1.0)):
            if ramp == 0.0:
                jumps[place] = jumps.get(place, 0.0) + sign * width
            else:
                for corner, turn in ((place, sign), (place + ramp, -sign)):
                    kinks[corner] = kinks.get(corner, 0.0) + turn * width / ramp
    places = sorted(set(jumps) | set(kinks))
    return WidthProfile(
        positions=np.array(places),
        jumps=np.array([jumps.get(place, 0.0) for place in places]),
        kinks=np.array([kinks.get(place, 0.0) for place in places]),
    )


def _solid_parts(block: Block, length: float) -> list[tuple[float, float]]:
    """Return the stretches of one row that are rubber, m."""
    parts = []
    start = 0.0
    for sipe in block.sipes:
        if sipe.position_mm * MM > start:
            parts.append((start, sipe.position_mm * MM))
        start = (sipe.position_mm + sipe.width_mm) * MM
    if start < length:
        parts.append((start, length))
    return parts
