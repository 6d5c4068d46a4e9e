"""Huemer's friction law fitted to a tribometer table.

The search is in `fit_search`; here is what its answer is worth: intervals, what the table cannot determine, misfit.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import f as f_distribution
from scipy.stats import t as t_distribution

from ..errors import InputError
from .fit_search import SEARCH, constants, model, solve
from .huemer_form import FITTED as CONSTANTS
from .huemer_form import huemer_law
from .law import FrictionLaw
from .table_file import FrictionData

Array = NDArray[np.float64]

HOLDABLE = ("beta", "n", "m")
FALLBACKS: tuple[tuple[str, float], ...] = (("beta", 0.0), ("m", 10.0))
FEWEST_SPEEDS = 4
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
    found = solve(data, held)
    weak = _weak(*found)
    for name, value in FALLBACKS:
        if not weak or name in held:
            continue
        warnings.append(f"the table does not determine {', '.join(weak)}: {name} is held at {value:g}")
        held[name] = value
        found = solve(data, held)
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


def _spread(q: Array, covariance: Array) -> Array:
    """Return the covariance of the seven constants by linearisation."""
    jacobian = np.zeros((len(CONSTANTS), q.size))
    for k in range(q.size):
        step = np.zeros(q.size)
        step[k] = 1e-6
        more, less = constants(q + step), constants(q - step)
        jacobian[:, k] = [(more[name] - less[name]) / 2e-6 for name in CONSTANTS]
    return jacobian @ covariance @ jacobian.T


def _weak(q: Array, covariance: Array) -> list[str]:
    """Name the constants whose 95 % half-width is as large as the constant, or that move only together."""
    spread = _spread(q, covariance)
    half = 1.96 * np.sqrt(np.diag(spread))
    k = constants(q)
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
    values = constants(q)
    freedom = max(data.coefficient.size - (len(SEARCH) - len(held)), 1)
    half = float(t_distribution.ppf(0.975, freedom)) * np.sqrt(np.diag(_spread(q, covariance)))
    intervals = {name: (values[name] - h, values[name] + h) for name, h in zip(CONSTANTS, half.tolist(), strict=True)}
    fitted = model(q, data)
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
        **values,
        least_pressure=least_pressure,
        least_slip_speed=least_slip_speed,
        static_coefficient=static_coefficient,
        where=data.source,
    )
    rms = float(np.sqrt(np.mean(residual**2)))
    if lack is not None and lack < DOUBTFUL:
        warnings = (*warnings, f"lack of fit: the law misses the table by more than its scatter (p = {lack:.2g})")
    return FrictionFit(data, law, values, intervals, dict(held), warnings, fitted, residual, rms, repeatability, lack)


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
