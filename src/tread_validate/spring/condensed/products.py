"""Products of matrices and vectors that stay in the processor's cache, without a linear-algebra library."""

from __future__ import annotations

import numpy as np

from ...kernels import kernel
from .inputs import Array, Fold, Operator, Shorts, Singles, Windows


@kernel(reorder=True)
def combine(rows: Singles | Shorts, weights: Singles, out: Singles) -> None:
    """Write the sum of the rows of a (k, n) matrix, each times its weight, to `out` (n,).

    The matrix has 32-bit or 16-bit numbers. Four rows at a time: a running sum along `out` needs no sum across a
    vector unit, whatever the sizes are.
    """
    out[:] = np.float32(0.0)
    fours = rows.shape[0] - rows.shape[0] % 4
    for k in range(0, fours, 4):
        a, b, c, d = rows[k], rows[k + 1], rows[k + 2], rows[k + 3]
        wa, wb, wc, wd = weights[k], weights[k + 1], weights[k + 2], weights[k + 3]
        for j in range(out.size):
            left = wa * np.float32(a[j]) + wb * np.float32(b[j])
            out[j] += left + (wc * np.float32(c[j]) + wd * np.float32(d[j]))
    for k in range(fours, rows.shape[0]):
        a, wa = rows[k], weights[k]
        for j in range(out.size):
            out[j] += wa * np.float32(a[j])


@kernel()
def operator_at(windows: Windows, offset: int, size: int) -> Operator:
    """Return the operator of `size` degrees of freedom that begins at `offset` in the pool."""
    pool, even, odd = windows.pool, windows.even.left.size, windows.odd.left.size
    if even + odd != size:
        even, odd = 0, 0
    a = offset + size * size
    b = a + even * even
    return Operator(
        pool[offset:a].reshape(size, size), pool[a:b].reshape(even, even), pool[b : b + odd * odd].reshape(odd, odd)
    )


@kernel()
def loads(operator: Operator, even: Fold, odd: Fold, q: Array, out: Array) -> None:
    """Write operator @ q to `out`; q and out are (3 n,)."""
    if operator.even.size == 0:
        flat = np.empty(q.size, dtype=np.float32)
        combine(operator.whole, q.astype(np.float32), flat)
        out[:] = flat
        return
    out[:] = 0.0
    _add_folded(operator.even, even, q, out)
    _add_folded(operator.odd, odd, q, out)


@kernel()
def _add_folded(part: Singles, fold: Fold, q: Array, out: Array) -> None:
    size = fold.left.size
    motion, force = np.empty(size, dtype=np.float32), np.empty(size, dtype=np.float32)
    for k in range(size):
        motion[k] = fold.own[k] * q[fold.left[k]] + fold.other[k] * q[fold.right[k]]
    combine(part, motion, force)
    for k in range(size):
        out[fold.left[k]] += fold.own[k] * force[k]
        out[fold.right[k]] += fold.other[k] * force[k]
