"""Products of matrices and vectors that stay in the processor's cache; always summed in the same order."""

from __future__ import annotations

import numpy as np

from ...kernels import kernel
from .inputs import Singles


@kernel()
def combine(rows: Singles, weights: Singles, out: Singles) -> None:
    """Write the sum of the rows of a (k, n) matrix, each times its weight, to `out` (n,).

    Four rows at a time: a running sum along `out` needs no sum across a vector unit, whatever the sizes are.
    """
    out[:] = np.float32(0.0)
    fours = rows.shape[0] - rows.shape[0] % 4
    for k in range(0, fours, 4):
        a, b, c, d = rows[k], rows[k + 1], rows[k + 2], rows[k + 3]
        wa, wb, wc, wd = weights[k], weights[k + 1], weights[k + 2], weights[k + 3]
        for j in range(out.size):
            out[j] += (wa * a[j] + wb * b[j]) + (wc * c[j] + wd * d[j])
    for k in range(fours, rows.shape[0]):
        a, wa = rows[k], weights[k]
        for j in range(out.size):
            out[j] += wa * a[j]
