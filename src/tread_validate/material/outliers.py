"""Single points that stand off from their neighbours, found by a test that smooth curves of any shape pass."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

NEIGHBOURS = 2  # on each side, in the same sweep
SURROUNDINGS = 6  # points on each side that say how far points stand off hereabouts
FALSE_ALARM = 0.01  # chance of one false outlier in a whole set of normal noise
LEAST = 5e-3  # relative: what no instrument resolves is not an outlier
MEDIAN_OVER_DEVIATION = 0.6745


def standing_off(residual: Array) -> Array:
    """Return each residual less the median of its four nearest neighbours in order, (n,)."""
    near = _neighbours(residual.size, NEIGHBOURS)
    return residual - np.median(residual[near], axis=1) if near.size else np.zeros_like(residual)


def _neighbours(n: int, reach: int) -> NDArray[np.intp]:
    """Return the indices of the 2 `reach` points next to each of n, itself left out; at the ends all on one side."""
    width = min(2 * reach + 1, n)
    first = np.clip(np.arange(n) - reach, 0, n - width)
    window = first[:, None] + np.arange(width)
    return np.asarray(window[window != np.arange(n)[:, None]].reshape(n, width - 1), dtype=np.intp)


def outliers(residuals: list[Array]) -> list[NDArray[np.bool_]]:
    """Mark outliers among the relative residuals of several sweeps, each in order of frequency.

    A point is an outlier where it stands off from the median of its neighbours by more than 0.5 %, by more than the
    normal deviate that one set in a hundred exceeds by chance, in units of what points commonly stand off, in
    the whole set and hereabouts. The last makes it blind to a curve's own bends: there the neighbours stand off too.
    """
    apart = [standing_off(residual) for residual in residuals]
    pooled = np.abs(np.concatenate(apart))
    from scipy.special import ndtri

    limit = float(ndtri(1.0 - 0.5 * FALSE_ALARM / pooled.size)) / MEDIAN_OVER_DEVIATION
    everywhere = float(np.median(pooled))
    marked = []
    for values in apart:
        size = np.abs(values)
        near = _neighbours(size.size, SURROUNDINGS)
        here = np.median(size[near], axis=1) if near.size else np.full(size.size, np.inf)
        marked.append((size > LEAST) & (size > limit * np.maximum(here, everywhere)))
    return marked
