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
from .element_record import INTEGRALS, PRESSURE

Array = NDArray[np.float64]


@kernel()
def _part(w: float, j: int, mean: float, y0: float, y1: float) -> tuple[float, float]:
    """Return the integral of column j from a node to the fraction w of a step, and the integral of that, over dt, dt^2.

    `mean` is over the step, y0 and y1 are at its ends. Forces are the parabola with these; where that would pull
    (rubber that lets go or touches within the step), pressure falls from y0 and rises to y1 linearly, each over the
    same part of the step. So no pressure is negative, and both integrals belong to one function: nothing is left where
    they cancel. Areas are even over a step.
    """
    if j >= 2:
        return mean * w, 0.5 * mean * w * w
    if j == PRESSURE and 3.0 * mean < y0 + y1:
        r = 2.0 * mean / (y0 + y1)
        if r <= 0.0:
            return 0.0, 0.0
        u, v = min(w, r), max(w - (1.0 - r), 0.0)
        once = y0 * (u - 0.5 * u * u / r) + 0.5 * y1 * v * v / r
        twice = y0 * (0.5 * u * u - u * u * u / (6.0 * r) + 0.5 * r * (w - u)) + y1 * v * v * v / (6.0 * r)
        return once, twice
    c = 6.0 * mean - 3.0 * (y0 + y1)
    square = w * w
    once = y0 * (w - 0.5 * square) + 0.5 * y1 * square + c * square * (0.5 - w / 3.0)
    twice = square * (y0 * (0.5 - w / 6.0) + y1 * w / 6.0 + c * w * (1.0 / 6.0 - w / 12.0))
    return once, twice


@kernel()
def _within(record: Array, k: int, j: int, w: float, dt: float) -> tuple[float, float]:
    """Return both integrals of column j from node k to the fraction w of the step after it."""
    mean = (record[k + 1, INTEGRALS + j] - record[k, INTEGRALS + j]) / dt
    once, twice = _part(w, j, mean, record[k, j], record[k + 1, j])
    return dt * once, dt * dt * twice


@kernel()
def _second_integrals(record: Array, dt: float) -> Array:
    """Return the integrals of the integrals of the first four columns at the nodes, (nodes, 4)."""
    twice = np.zeros((record.shape[0], 4))
    for k in range(record.shape[0] - 1):
        for j in range(4):
            _, more = _within(record, k, j, 1.0, dt)
            twice[k + 1, j] = twice[k, j] + dt * record[k, INTEGRALS + j] + more
    return twice


@kernel()
def block_forces(
    record: Array, dt: float, speed: float, positions: Array, jumps: Array, kinks: Array, nodes: int
) -> Array:
    """Return normal force (N), shear force (N, positive like lambda), touching and slipping area (m2), (nodes, 4).

    Row k is for t = k dt. `record` is one element's; `positions`, `jumps` and `kinks` are the width profile's.
    """
    forces = np.zeros((nodes, 4))
    last = record.shape[0] - 1
    integrals = _second_integrals(record, dt)
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
                column = INTEGRALS + j
                if beyond > 0:
                    once = record[last, column]
                    twice = integrals[last, j] + (beyond - part) * dt * once
                elif part == 0.0:
                    once, twice = record[at, column], integrals[at, j]
                else:
                    w = 1.0 - part
                    before = record[at - 1, column]
                    once, twice = _within(record, at - 1, j, w, dt)
                    twice += integrals[at - 1, j] + w * dt * before
                    once += before
                forces[i, j] += first_order * once + second_order * twice
    return forces


@kernel()
def add_element(record: Array, area: float, forces: Array) -> None:
    """Add one element of a given face area (m2) to the block's forces, for blocks whose elements differ."""
    for i in range(min(record.shape[0], forces.shape[0])):
        for j in range(4):
            forces[i, j] += area * record[i, j]
