"""Huemer's friction law fitted to a tribometer table.

The law keeps its value when alpha, beta, a, b and c are multiplied by one number, so the denominator is set to 1 at
1 m/s (a + b + c = 1): alpha + beta is then the coefficient at 1 MPa and 1 m/s. The denominator is written
d + c (u - u0)^2 with u = |v|^(-1/m) and c, d > 0, which keeps it positive; u0 is where friction peaks.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import f as f_distribution
from scipy.stats import t as t_distribution

from ..errors import InputError
from ..units import MPA
from .huemer_form import FITTED as CONSTANTS
from .huemer_form import huemer_law
from .law import FrictionLaw
from .table_file import FrictionData

Array = NDArray[np.float64]

# search variables: ln alpha, beta, n, ln m, u0, ln(c/d)
SEARCH = ("alpha", "beta", "n", "m", "u0", "c/d")
HOLDABLE = ("beta", "n", "m")
FALLBACKS: tuple[tuple[str, float], ...] = (("beta", 0.0), ("m", 10.0))
FEWEST_SPEEDS = 4
POLISHES = 8
DOUBTFUL = 0.05  # probability of the misfit by scatter alone, below which a warning says so ...
REFUSED = 1e-3  # ... and below which the law is refused
LARGEST_MISFIT = 0.03  # if the misfit is also larger than this, relative
PARALLEL = 0.999  # correlation beyond which two constants cannot be told apart


@dataclass(frozen=True)
class FrictionFit:
    """Constants of the law with their intervals, and how well they fit.

    Attributes
    ----------
    constants : mapping of name to float
        alpha, beta, n, m, a, b, c (p in MPa, v in m/s), scaled so that a + b + c = 1.
    intervals : mapping of name to (float, float)
        95 % confidence, linearised; equal ends for a constant that was held.
    held : mapping of name to float
        Constants that were not fitted.
    warnings : tuple of str
        What the table could not determine, in words.
    fitted, residual : (n,) arrays
        Law at each row, and measured less fitted.
    rms : float
    repeatability : float or None
        Standard deviation of repeats; None without repeats.
    lack_of_fit : float or None
        Probability of so large a misfit by scatter alone (F test of misfit against repeats); None without repeats.
    """

    data: FrictionData
    law: FrictionLaw
    constants: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]
    held: Mapping[str, float]
    warnings: tuple[str, ...]
    fitted: Array
    residual: Array
    rms: float
    repeatability: float | None
    lack_of_fit: float | None

    @property
    def misfit(self) -> float:
        """Root mean square of the residuals that scatter does not explain, over the mean coefficient."""
        unexplained = max(self.rms**2 - (self.repeatability or 0.0) ** 2, 0.0)
        return float(np.sqrt(unexplained) / np.mean(self.data.coefficient))

    @property
    def describes(self) -> bool:
        """False where scatter explains the misfit with p < 0.001 only and the misfit is more than 3 %."""
        return self.lack_of_fit is None or self.lack_of_fit >= REFUSED or self.misfit <= LARGEST_MISFIT


def fit_friction(
    data: FrictionData,
    hold: Mapping[str, float] | None = None,
    static_coefficient: float = 0.9,
    least_pressure: float = 10e3,
    least_slip_speed: float = 1e-3,
) -> FrictionFit:
    """Fit the law by least squares; `hold` fixes beta, n or m at given values.

    Where the table cannot determine all constants, beta is held at 0, then m at 10, and a warning says so; what
    remains undetermined is named too. Floors in Pa and m/s go into the law, not into the fit.

    Raises `InputError` for one pressure only (unless n and beta are held), fewer than four slip speeds, or fewer rows
    than constants.
    """
    held = dict(hold or {})
    for name in held:
        if name not in HOLDABLE:
            raise InputError(f"held constant {name}", name, f"one of {', '.join(HOLDABLE)}")
    _check(data, held)
    warnings: list[str] = []
    found = _solve(data, held)
    weak = _weak(*found)
    for name, value in FALLBACKS:
        if not weak or name in held:
            continue
        warnings.append(f"the table does not determine {', '.join(weak)}: {name} is held at {value:g}")
        held[name] = value
        found = _solve(data, held)
        weak = _weak(*found)
    if weak:
        warnings.append(f"the table does not determine {', '.join(weak)}: measure over wider pressures and speeds")
    return _result(
        data, found[0], found[1], held, tuple(warnings), static_coefficient, least_pressure, least_slip_speed
    )


def _check(data: FrictionData, held: Mapping[str, float]) -> None:
    if data.pressures.size < 2 and not {"beta", "n"} <= set(held):
        found = f"one pressure only, {data.pressures[0]:.4g} Pa"
        raise InputError(data.source, found, "two or more pressures, or n and beta held (--hold n=1 --hold beta=0)")
    if data.speeds.size < 2:
        raise InputError(data.source, f"one slip speed only, {data.speeds[0]:.4g} m/s", "four or more slip speeds")
    if data.speeds.size < FEWEST_SPEEDS:
        raise InputError(data.source, f"{data.speeds.size} slip speeds", f"at least {FEWEST_SPEEDS}")
    combinations = np.unique(np.column_stack([data.pressure_level, data.speed_level]), axis=0).shape[0]
    if combinations < len(SEARCH) - len(held) + 1:
        found = f"{combinations} combinations of pressure and speed"
        raise InputError(data.source, found, f"at least {len(SEARCH) - len(held) + 1}")


def _constants(q: Array) -> dict[str, float]:
    """Return the constants of the search variables, a + b + c = 1."""
    return {name: float(value) for name, value in zip(CONSTANTS, _ratios(q), strict=True)}


def _ratios(q: NDArray[Any]) -> tuple[Any, ...]:
    u0, ratio = q[4], np.exp(q[5])
    at_one = 1.0 + ratio * (1.0 - u0) ** 2
    a, b, c = (1.0 + ratio * u0**2) / at_one, -2.0 * ratio * u0 / at_one, ratio / at_one
    return np.exp(q[0]), q[1], q[2], np.exp(q[3]), a, b, c


def _model(q: Array, data: FrictionData) -> Array:
    return np.asarray(_at(_ratios(q), data), dtype=np.float64)


def _at(constants: tuple[Any, ...], data: FrictionData) -> NDArray[Any]:
    """Return the law at each row, (n,); constants may be complex, to be differentiated."""
    alpha, beta, n, m, a, b, c = constants
    u = data.slip_speed ** (-1.0 / m)
    above = alpha * (data.pressure / MPA) ** (n - 1.0) + beta
    return np.asarray(above / (a + b * u + c * u * u))


def _solve(data: FrictionData, held: Mapping[str, float]) -> tuple[Array, Array]:
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
        return np.asarray(_model(full(q), data) - data.coefficient, dtype=np.float64)

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
    variance = float(np.sum((_model(q, data) - data.coefficient) ** 2)) / freedom
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
        gradient = np.array([np.sum(column * (_model(q, data) - data.coefficient)) for column in scaled.T])
        step = np.zeros(q.size)
        step[free] = np.linalg.lstsq(scaled.T @ scaled, gradient, rcond=1e-13)[0] / size
        better = q - step
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            after = float(np.sum((_model(better, data) - data.coefficient) ** 2))
        if not after <= 1.000001 * float(np.sum((_model(q, data) - data.coefficient) ** 2)):
            return q  # not determined: the search's answer stands, with its warnings
        q = better
    return q


def _spread(q: Array, covariance: Array) -> Array:
    """Return the covariance of the seven constants by linearisation."""
    jacobian = np.zeros((len(CONSTANTS), q.size))
    for k in range(q.size):
        step = np.zeros(q.size)
        step[k] = 1e-6
        more, less = _constants(q + step), _constants(q - step)
        jacobian[:, k] = [(more[name] - less[name]) / 2e-6 for name in CONSTANTS]
    return jacobian @ covariance @ jacobian.T


def _weak(q: Array, covariance: Array) -> list[str]:
    """Name the constants whose 95 % half-width is as large as the constant, or that move only together."""
    spread = _spread(q, covariance)
    half = 1.96 * np.sqrt(np.diag(spread))
    k = _constants(q)
    size = {name: abs(k[name]) for name in CONSTANTS}
    size["beta"] = abs(k["alpha"]) + abs(k["beta"])
    size["n"] = 0.5
    weak = [name for name, h in zip(CONSTANTS, half, strict=True) if h > size[name]]
    deviations = np.sqrt(np.diag(covariance))
    free = deviations > 0
    correlation = covariance[np.ix_(free, free)] / np.outer(deviations[free], deviations[free])
    names = np.array(SEARCH)[free]
    for i in range(names.size):
        for j in range(i):
            if abs(correlation[i, j]) > PARALLEL and not weak:
                weak += [str(names[j]), str(names[i])]
    return weak


def _result(
    data: FrictionData,
    q: Array,
    covariance: Array,
    held: Mapping[str, float],
    warnings: tuple[str, ...],
    static_coefficient: float,
    least_pressure: float,
    least_slip_speed: float,
) -> FrictionFit:
    constants = _constants(q)
    freedom = max(data.coefficient.size - (len(SEARCH) - len(held)), 1)
    half = float(t_distribution.ppf(0.975, freedom)) * np.sqrt(np.diag(_spread(q, covariance)))
    intervals = {
        name: (constants[name] - h, constants[name] + h) for name, h in zip(CONSTANTS, half.tolist(), strict=True)
    }
    fitted = _model(q, data)
    residual = data.coefficient - fitted
    highest = int(np.argmax(fitted))
    if fitted[highest] > static_coefficient:
        warnings = (
            *warnings,
            f"the kinetic coefficient reaches {fitted[highest]:.3g} (at {data.pressure[highest]:.3g} Pa and "
            f"{data.slip_speed[highest]:.3g} m/s), above the static one of {static_coefficient:g}",
        )
    repeatability, lack = _lack_of_fit(data, residual, len(SEARCH) - len(held))
    law = huemer_law(
        **constants,
        least_pressure=least_pressure,
        least_slip_speed=least_slip_speed,
        static_coefficient=static_coefficient,
        where=data.source,
    )
    rms = float(np.sqrt(np.mean(residual**2)))
    if lack is not None and lack < DOUBTFUL:
        warnings = (*warnings, f"lack of fit: the law misses the table by more than its scatter (p = {lack:.2g})")
    return FrictionFit(
        data, law, constants, intervals, dict(held), warnings, fitted, residual, rms, repeatability, lack
    )


def _lack_of_fit(data: FrictionData, residual: Array, parameters: int) -> tuple[float | None, float | None]:
    """Return the standard deviation of repeats and the F test's probability of the misfit."""
    groups: dict[tuple[int, int], list[int]] = {}
    for row, key in enumerate(zip(data.pressure_level.tolist(), data.speed_level.tolist(), strict=True)):
        groups.setdefault(key, []).append(row)
    # residuals, not readings: the settings of repeats differ a little, and the law allows for that
    pure = sum(float(np.sum((residual[rows] - residual[rows].mean()) ** 2)) for rows in groups.values())
    freedom = residual.size - len(groups)
    if freedom < 1:
        return None, None
    repeatability = float(np.sqrt(pure / freedom))
    misfit_freedom = len(groups) - parameters
    if misfit_freedom < 1 or pure <= 0:
        return repeatability, None
    misfit = (float(residual @ residual) - pure) / misfit_freedom
    return repeatability, float(f_distribution.sf(misfit / (pure / freedom), misfit_freedom, freedom))
