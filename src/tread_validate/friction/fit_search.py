"""The search for Huemer's constants: its variables, the law in them, the minimum and what it leaves undetermined.

The law keeps its value when alpha, beta, a, b and c are multiplied by one number, so the denominator is set to 1 at
1 m/s (a + b + c = 1): alpha + beta is then the coefficient at 1 MPa and 1 m/s. The denominator is written
d + c (u - u0)^2 with u = |v|^(-1/m) and c, d > 0, which keeps it positive; u0 is where friction peaks.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from ..errors import InputError
from ..units import MPA
from .huemer_form import FITTED as CONSTANTS
from .table_file import FrictionData

Array = NDArray[np.float64]

# search variables: ln alpha, beta, n, ln m, u0, ln(c/d)
SEARCH = ("alpha", "beta", "n", "m", "u0", "c/d")
POLISHES = 8


def constants(q: Array) -> dict[str, float]:
    """Return the constants of the search variables, a + b + c = 1."""
    return {name: float(value) for name, value in zip(CONSTANTS, _ratios(q), strict=True)}


def _ratios(q: NDArray[Any]) -> tuple[Any, ...]:
    u0, ratio = q[4], np.exp(q[5])
    at_one = 1.0 + ratio * (1.0 - u0) ** 2
    a, b, c = (1.0 + ratio * u0**2) / at_one, -2.0 * ratio * u0 / at_one, ratio / at_one
    return np.exp(q[0]), q[1], q[2], np.exp(q[3]), a, b, c


def model(q: Array, data: FrictionData) -> Array:
    """Return the law at each row of the table, (n,)."""
    return np.asarray(_at(_ratios(q), data), dtype=np.float64)


def _at(constants: tuple[Any, ...], data: FrictionData) -> NDArray[Any]:
    """Return the law at each row, (n,); constants may be complex, to be differentiated."""
    alpha, beta, n, m, a, b, c = constants
    u = data.slip_speed ** (-1.0 / m)
    above = alpha * (data.pressure / MPA) ** (n - 1.0) + beta
    return np.asarray(above / (a + b * u + c * u * u))


def solve(data: FrictionData, held: Mapping[str, float]) -> tuple[Array, Array]:
    """Return the search variables and the covariance of the free ones (0 for held ones)."""
    centre = np.array([0.0, 0.0, 0.9, np.log(10.0), 1.2, np.log(4.0)])
    for name, value in held.items():
        k = SEARCH.index(name)
        centre[k] = np.log(value) if name == "m" else value
    free = np.array([name not in held for name in SEARCH])
    low = np.array([-7.0, -2.0, -0.5, np.log(0.5), -5.0, -9.0])
    high = np.array([4.0, 3.0, 2.5, np.log(200.0), 8.0, 12.0])
    if np.any((centre < low) | (centre > high)):
        raise InputError("held constants", dict(held), "beta in -2..3, n in -0.5..2.5, m in 0.5..200")

    def full(q: Array) -> Array:
        whole = centre.copy()
        whole[free] = q
        return whole

    def misfit(q: Array) -> Array:
        return np.asarray(model(full(q), data) - data.coefficient, dtype=np.float64)

    scales = np.array([0.3, 0.2, 0.2, 0.5, 0.3, 1.0])[free]
    bounds = (low[free], high[free])
    best = None
    scale = float(np.log(np.mean(data.coefficient)))
    for u0 in (0.6, 1.0, 1.3, 2.0):
        for ratio in (0.0, 3.0):
            start = centre.copy()
            start[0], start[4], start[5] = scale, u0, ratio
            found = least_squares(misfit, start[free], bounds=bounds, x_scale=scales, max_nfev=300)
            if best is None or found.cost < best.cost:
                best = found
    assert best is not None
    q = _polished(full(best.x), free & (full(best.x) > low + 1e-6) & (full(best.x) < high - 1e-6), data)
    freedom = max(data.coefficient.size - int(free.sum()), 1)
    variance = float(np.sum((model(q, data) - data.coefficient) ** 2)) / freedom
    jacobian = _slopes(q, free, data)
    size = np.maximum(np.linalg.norm(jacobian, axis=0), 1e-12)
    inverse = np.linalg.pinv((jacobian / size).T @ (jacobian / size), rcond=1e-13)
    covariance = np.zeros((len(SEARCH), len(SEARCH)))
    covariance[np.ix_(free, free)] = max(variance, 1e-18) * inverse / np.outer(size, size)
    return q, covariance


def _slopes(q: Array, free: NDArray[np.bool_], data: FrictionData) -> Array:
    """Return the derivatives of the model by the free search variables, (n, k), exact: a step along the imaginary."""
    columns = []
    for k in np.flatnonzero(free):
        moved = q.astype(np.complex128)
        moved[k] += 1e-30j
        columns.append(_at(_ratios(moved), data).imag * 1e30)
    return np.column_stack(columns)


def _polished(q: Array, free: NDArray[np.bool_], data: FrictionData) -> Array:
    """Return the minimum near `q` to round-off: where a search stops depends on the processor, the minimum does not."""
    for _ in range(POLISHES if free.any() else 0):
        jacobian = _slopes(q, free, data)
        size = np.maximum(np.sqrt(np.sum(jacobian**2, axis=0)), 1e-300)
        scaled = jacobian / size
        gradient = np.array([np.sum(column * (model(q, data) - data.coefficient)) for column in scaled.T])
        step = np.zeros(q.size)
        step[free] = np.linalg.lstsq(scaled.T @ scaled, gradient, rcond=1e-13)[0] / size
        better = q - step
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            after = float(np.sum((model(better, data) - data.coefficient) ** 2))
        if not after <= 1.000001 * float(np.sum((model(q, data) - data.coefficient) ** 2)):
            return q  # not determined: the search's answer stands, with its warnings
        q = better
    return q
