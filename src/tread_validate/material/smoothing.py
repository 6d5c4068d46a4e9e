"""Outlier-robust smoothing of one curve: local quadratics with bisquare weights.

W.S. Cleveland, J. Am. Stat. Assoc. 74 (1979) 829-836, doi:10.1080/01621459.1979.10481038.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SPAN = 0.75  # of the points
FEWEST_LOCAL = 7
ROUNDS = 5
LEAST_SCALE = 5e-4  # in ln y: what no instrument resolves is not an outlier


@dataclass(frozen=True)
class Smoothed:
    """A smoothed curve.

    Attributes
    ----------
    values : (n,) array
    operator : (n, n) array
        values = operator @ data: the robust weights are frozen in it.
    weights : (n,) array, 0..1
        Robust weight of each point; 0 marks an outlier.
    """

    values: Array
    operator: Array
    weights: Array

    @property
    def outliers(self) -> NDArray[np.bool_]:
        """Which points were set aside, (n,)."""
        return np.asarray(self.weights <= 0.0, dtype=np.bool_)

    @property
    def freedom(self) -> float:
        """Equivalent number of parameters (trace of the operator)."""
        return float(np.trace(self.operator))


def robust_smooth(x: Array, y: Array) -> Smoothed:
    """Smooth `y` over `x`, both (n,), x increasing; take logarithms of both for moduli.

    Local quadratics over 75 % of the points, at least 7 (straight lines for fewer), tricube in the distance, five
    rounds of bisquare weights at six median absolute residuals (corrected for the smoother's freedom).
    """
    n = x.size
    local = min(max(int(np.ceil(SPAN * n)), FEWEST_LOCAL), n)
    degree = 2 if n >= FEWEST_LOCAL else 1
    distance = np.abs(x[:, None] - x[None, :])
    reach = np.sort(distance, axis=1)[:, local - 1] * 1.0001
    tricube = np.clip(1.0 - (distance / reach[:, None]) ** 3, 0.0, None) ** 3
    weights = np.ones(n)
    operator = np.eye(n)
    for _ in range(ROUNDS):
        operator = _operator(x, tricube * weights[None, :], degree)
        residual = np.abs(y - operator @ y)
        freedom = max(1.0 - float(np.trace(operator)) / n, 0.2)
        scale = 6.0 * max(float(np.median(residual)) / np.sqrt(freedom), LEAST_SCALE)
        weights = np.clip(1.0 - (residual / scale) ** 2, 0.0, None) ** 2
    return Smoothed(operator @ y, operator, weights)


def _operator(x: Array, weights: Array, degree: int) -> Array:
    """Return the rows of the local fits' values: (n, n)."""
    offset = x[None, :] - x[:, None]
    span = float(x[-1] - x[0])
    powers = np.stack([(offset / span) ** k for k in range(degree + 1)], axis=-1)
    weighted = powers * weights[..., None]
    normal = np.einsum("ijk,ijl->ikl", weighted, powers)
    normal += 1e-12 * np.eye(degree + 1)
    first = np.zeros((x.size, degree + 1, 1))
    first[:, 0, 0] = 1.0
    solved = np.linalg.solve(normal, first)[..., 0]
    return np.asarray(np.einsum("ik,ijk->ij", solved, weighted), dtype=np.float64)
