"""Monotone cubic interpolation of a few values over one clock, compiled: SciPy's takes 0.4 ms to begin with.

F.N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, doi:10.1137/0905021, with the three-point end
slopes of C. Moler, Numerical Computing with MATLAB, 2004, as `scipy.interpolate.PchipInterpolator` has them.
"""

from __future__ import annotations

import numpy as np

from ...kernels import kernel
from .inputs import Array


@kernel()
def monotone(time: Array, values: Array, at: Array) -> Array:
    """Return values (m, k), given at ascending `time` (m,), m at least 3, at ascending times `at` (n,): (n, k).

    Beyond the ends the first and the last cubic go on.
    """
    found = np.empty((at.size, values.shape[1]))
    slope = np.empty(time.size)
    for c in range(values.shape[1]):
        _slopes(time, values[:, c], slope)
        k = 0
        for i in range(at.size):
            while k < time.size - 2 and at[i] >= time[k + 1]:
                k += 1
            h = time[k + 1] - time[k]
            x = at[i] - time[k]
            secant = (values[k + 1, c] - values[k, c]) / h
            bend = (slope[k] + slope[k + 1] - 2.0 * secant) / h
            found[i, c] = values[k, c] + x * (slope[k] + x * ((secant - slope[k]) / h - bend + x * bend / h))
    return found


@kernel()
def _slopes(time: Array, value: Array, slope: Array) -> None:
    last = time.size - 1
    for k in range(1, last):
        before, after = time[k] - time[k - 1], time[k + 1] - time[k]
        one, other = (value[k] - value[k - 1]) / before, (value[k + 1] - value[k]) / after
        slope[k] = 0.0
        if one * other > 0.0:
            near, far = 2.0 * after + before, after + 2.0 * before
            slope[k] = (near + far) / (near / one + far / other)
    slope[0] = _end(time[1] - time[0], time[2] - time[1], value[0], value[1], value[2])
    slope[last] = -_end(
        time[last] - time[last - 1], time[last - 1] - time[last - 2], value[last], value[last - 1], value[last - 2]
    )


@kernel()
def _end(near: float, far: float, first: float, second: float, third: float) -> float:
    """Return the slope away from an end, for the widths and the values of its two intervals."""
    one, other = (second - first) / near, (third - second) / far
    slope = ((2.0 * near + far) * one - near * other) / (near + far)
    if slope * one <= 0.0:
        return 0.0
    if one * other <= 0.0 and abs(slope) > 3.0 * abs(one):
        return 3.0 * one
    return slope
