"""From one element's history to the block, Eq. (9) of the paper backwards: the convolution with the width profile.

All elements of one row share one history, shifted in time by s/V, so that
``N(t) = int w(s) p(t - s/V) ds``. With w piecewise linear with jumps, two integrations by parts leave a sum over w's
few corners of the running integral I of p and the integral J of I:
``N(t) = V sum_k [jump_k I(t - s_k/V) + V kink_k J(t - s_k/V)]``. The sum over elements is thus taken to its limit.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..kernels import kernel
from .element import INTEGRALS

Array = NDArray[np.float64]


@kernel()
def _hermite(w: float, dt: float, y0: float, y1: float, s0: float, s1: float) -> float:
    """Cubic between y0 and y1 with slopes s0 and s1, at the fraction w of dt."""
    v = 1.0 - w
    return v * v * ((1.0 + 2.0 * w) * y0 + w * dt * s0) + w * w * ((1.0 + 2.0 * v) * y1 - v * dt * s1)


@kernel()
def block_forces(
    record: Array, dt: float, speed: float, positions: Array, jumps: Array, kinks: Array, nodes: int
) -> Array:
    """Return normal force (N), shear force (N, positive like lambda), touching and slipping area (m2), (nodes, 4).

    Row k is for t = k dt. `record` is one element's; `positions`, `jumps` and `kinks` are the width profile's.
    """
    forces = np.zeros((nodes, 4))
    last = record.shape[0] - 1
    for k in range(positions.size):
        shift = positions[k] / (speed * dt)
        if abs(shift - round(shift)) < 1e-9:
            shift = float(round(shift))
        whole = int(np.floor(shift))
        part = shift - whole  # t - s/V lies `part` of a step before node i
        first_order, second_order = speed * jumps[k], speed * speed * kinks[k]
        for i in range(whole if part == 0.0 else whole + 1, nodes):
            at = i - whole
            beyond = max(at - last, 0)
            for j in range(4):
                column, second = INTEGRALS + j, INTEGRALS + 4 + j
                if beyond > 0:
                    once = record[last, column]
                    twice = record[last, second] + (beyond - part) * dt * once
                elif part == 0.0:
                    once, twice = record[at, column], record[at, second]
                else:
                    w = 1.0 - part
                    once0, once1 = record[at - 1, column], record[at, column]
                    if j < 2:
                        once = _hermite(w, dt, once0, once1, record[at - 1, j], record[at, j])
                    else:
                        once = part * once0 + w * once1
                    twice = _hermite(w, dt, record[at - 1, second], record[at, second], once0, once1)
                forces[i, j] += first_order * once + second_order * twice
    return forces


@kernel()
def add_element(record: Array, area: float, forces: Array) -> None:
    """Add one element of a given face area (m2) to the block's forces, for blocks whose elements differ."""
    for i in range(min(record.shape[0], forces.shape[0])):
        for j in range(4):
            forces[i, j] += area * record[i, j]
