"""The hereditary integral F(t) = int E(t-s) du as a recursion over steps: Eq. (1) of the paper.

Within a step the rate of the input is the parabola that has the true rate at both ends and the true mean, so that
the input itself is a cubic. With x = dt/tau_i and the moments ``M_j = int_0^1 z^j exp(-x (1-z)) dz``,

    h_i <- exp(-x) h_i + E_i [dt (M_0 - 4 M_1 + 3 M_2) r_0 + dt (3 M_2 - 2 M_1) r_1 + 6 (M_1 - M_2) du].

For a constant rate this is the exact recursion for a piecewise-linear input,
``h_i <- exp(-x) h_i + E_i (1 - exp(-x))/x du``; for a smooth one the error falls with the fourth power of the step.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..kernels import kernel
from .inputs import Memory, Rubber

Array = NDArray[np.float64]

LEVELS = 13
"""Sub-steps go down to the node step over 2^(LEVELS-1)."""
TICKS = 1 << (LEVELS - 1)
"""Smallest sub-steps in a node step."""
STAGE = 1.0 - math.sqrt(0.5)
"""Place of the inner stage of the slip integrator (Alexander's two-stage SDIRK method)."""


def memory_of(rubber: Rubber, step: float) -> Memory:
    """Return the weights for a node step (s)."""
    weights, sums = _weights(rubber.moduli, rubber.relaxation_times, step, LEVELS, STAGE)
    return Memory(step, weights, sums)


@kernel()
def moments(x: float) -> tuple[float, float, float]:
    """Return ``int_0^1 z^j exp(-x (1-z)) dz`` for j = 0, 1, 2, to round-off for every x >= 0."""
    if x < 0.5:
        m0, m1, m2, term = 0.0, 0.0, 0.0, 1.0
        for k in range(16):  # term = (-x)^k / k!, and int z^j (1-z)^k dz = j! k!/(j+k+1)!
            m0 += term / (k + 1)
            m1 += term / ((k + 1) * (k + 2))
            m2 += term * 2.0 / ((k + 1) * (k + 2) * (k + 3))
            term *= -x / (k + 1)
        return m0, m1, m2
    m0 = -math.expm1(-x) / x
    m1 = (1.0 - m0) / x
    return m0, m1, (1.0 - 2.0 * m1) / x


@kernel()
def _weights(moduli: Array, times: Array, step: float, levels: int, stage: float) -> tuple[Array, Array]:
    weights = np.empty((levels, 2, 4, moduli.size))
    sums = np.zeros((levels, 2, 3))
    for level in range(levels):
        for part in range(2):
            dt = step / (1 << level) * (stage if part == 1 else 1.0)
            for i in range(moduli.size):
                x = dt / times[i]
                m0, m1, m2 = moments(x)
                weights[level, part, 0, i] = math.exp(-x)
                weights[level, part, 1, i] = moduli[i] * dt * (m0 - 4.0 * m1 + 3.0 * m2)
                weights[level, part, 2, i] = moduli[i] * dt * (3.0 * m2 - 2.0 * m1)
                weights[level, part, 3, i] = moduli[i] * 6.0 * (m1 - m2)
                for j in range(3):
                    sums[level, part, j] += weights[level, part, j + 1, i]
    return weights, sums
