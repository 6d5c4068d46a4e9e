"""How force depends on speed and temperature: the coefficients a_v and a_theta of the paper's Table 1."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from ...errors import InputError
from ..tables import Coefficient, Residual
from .fit import Fit, Peak, fieller
from .together import NOTE as TOGETHER
from .together import balanced, fit_together, levels

REFERENCE_TEMPERATURE = 22.0  # degC, of a_theta; not printed in the paper: assumed
EXCLUDED_INTERFERENCES = (0.3,)  # mm: left out of the paper's regressions
LEVEL = 0.95


@dataclass(frozen=True)
class Regression:
    """All coefficients of one source with the residuals behind them."""

    coefficients: tuple[Coefficient, ...]
    residuals: tuple[Residual, ...]


def fit_line(x: NDArray[np.float64], force: NDArray[np.float64], level: float = LEVEL) -> Fit:
    """Fit F = F0 (1 + a x), Eq. (4) of the paper, by ordinary least squares.

    Parameters
    ----------
    x : (n,) array
        Speed in m/s, or temperature above the reference in K.
    force : (n,) array, N

    The interval of the ratio of slope and intercept is Fieller's (J. R. Stat. Soc. B 16 (1954) 175-185), from the
    covariance of the least-squares coefficients with n - 2 degrees of freedom. Raises `InputError` for fewer than
    two different x and for an intercept of zero.
    """
    from statsmodels.regression.linear_model import OLS  # late: half a second, and most commands fit nothing

    if np.unique(x).size < 2:
        raise InputError("regression", f"{np.unique(x).size} level(s)", "at least two different levels")
    result = OLS(force, np.column_stack([np.ones_like(x), x])).fit()
    intercept, slope = (float(value) for value in result.params)
    if intercept == 0.0:
        raise InputError("regression", "intercept 0", "a force at x = 0 to be relative to")
    freedom = int(result.df_resid)
    fitted = np.asarray(result.fittedvalues, dtype=np.float64)
    if freedom < 1:
        return Fit(slope / intercept, -math.inf, math.inf, fitted)
    covariance = np.asarray(result.cov_params(), dtype=np.float64)
    low, high = fieller(slope, intercept, covariance[1, 1], covariance[0, 0], covariance[0, 1], freedom, level)
    return Fit(slope / intercept, low, high, fitted)


def mean_interval(mean: float, sd: float, n: int, level: float = LEVEL) -> tuple[float, float]:
    """Return the confidence interval of the mean of n values with sample standard deviation `sd` (Student)."""
    if n < 2:
        return -math.inf, math.inf
    half = float(stdtrit(n - 1, 0.5 + 0.5 * level)) * sd / math.sqrt(n)
    return mean - half, mean + half


def regress(
    peaks: Sequence[Peak],
    *,
    source: str = "",
    exclude: Sequence[float] = EXCLUDED_INTERFERENCES,
    reference_temperature: float = REFERENCE_TEMPERATURE,
    level: float = LEVEL,
    assumed: str = "",
    drop_missing: bool = False,
) -> Regression:
    """Return a_v and a_theta of every block shape, set by set and as means.

    a_v: one line over the speeds for each (temperature, interference); mean and sample standard deviation of the
    sets. a_theta: one line over the temperatures, less `reference_temperature`, for each interference with the
    speeds grouped; mean and range of the sets. Where the speeds of a set differ between its temperatures, speed and
    temperature are fitted together, and the row's note says so. A set with a missing run has no value and takes its
    mean with it; with `drop_missing` a run without a force counts as one that is not there.
    """
    chosen = [peak for peak in peaks if not any(abs(peak.interference - left) < 1e-9 for left in exclude)]
    if drop_missing:
        chosen = [peak for peak in chosen if peak.force is not None]
    coefficients: list[Coefficient] = []
    residuals: list[Residual] = []
    for shape in sorted({peak.shape for peak in chosen}):
        of_shape = [peak for peak in chosen if peak.shape == shape]
        for name in ("a_v", "a_theta"):
            rows: list[Coefficient] = []
            for label, members in _sets(of_shape, name).items():
                row, left = _one_set(source, shape, name, label, members, reference_temperature, level, assumed)
                rows.append(row)
                residuals += left
            coefficients += [*rows, _mean(source, shape, name, rows, level, assumed)]
    return Regression(tuple(coefficients), tuple(residuals))


def _sets(peaks: Sequence[Peak], name: str) -> dict[str, list[Peak]]:
    sets: dict[str, list[Peak]] = {}
    for peak in sorted(peaks, key=lambda item: (item.temperature, item.interference, item.speed)):
        label = f"{peak.interference:g} mm"
        if name == "a_v":
            label = f"{peak.temperature:g} degC {label}"
        sets.setdefault(label, []).append(peak)
    return sets


def _one_set(
    source: str, shape: str, name: str, label: str, members: list[Peak], zero: float, level: float, assumed: str
) -> tuple[Coefficient, list[Residual]]:
    unit, x_unit = ("s/m", "m/s") if name == "a_v" else ("1/degC", "degC")

    def without(note: str, status: str) -> tuple[Coefficient, list[Residual]]:
        return Coefficient(
            source, shape, name, label, None, unit, None, "", None, None, None, None, level, len(members), status,
            note, assumed,
        ), []  # fmt: skip

    lost = [peak.case_id for peak in members if peak.force is None]
    if lost:
        return without(f"{len(lost)} of {len(members)} runs without a force, first {lost[0]}", "missing")
    x = np.array([peak.speed if name == "a_v" else peak.temperature - zero for peak in members])
    force = np.array([peak.force for peak in members], dtype=np.float64)
    together = name == "a_theta" and not balanced(members)
    try:
        if name == "a_v" and len(set(levels([peak.speed for peak in members]).values())) < 2:
            raise InputError("regression", "1 level", "at least two different levels (speeds within 0.5 % are repeats)")
        fit = fit_together(members, zero, level) if together else fit_line(x, force, level)
    except InputError as error:
        return without(str(error), "undefined")
    low, high = _finite(fit.low), _finite(fit.high)
    note = "; ".join(([TOGETHER] if together else []) + ([] if low is not None else ["interval unbounded"]))
    row = Coefficient(
        source, shape, name, label, fit.coefficient, unit, None, "", None, None, low, high, level, len(members),
        "current", note, assumed,
    )  # fmt: skip
    left = [
        _residual((source, shape, name, label, peak.case_id), position, x_unit, float(value), float(line), assumed)
        for peak, position, value, line in zip(
            members, [p.speed if name == "a_v" else p.temperature for p in members], force, fit.fitted, strict=True
        )
    ]
    return row, left


def _residual(
    key: tuple[str, str, str, str, str], x: float, x_unit: str, force: float, fitted: float, assumed: str
) -> Residual:
    left = force - fitted
    return Residual(*key, x, x_unit, force, fitted, left, 100.0 * left / fitted if fitted else None, assumed)


def _mean(source: str, shape: str, name: str, rows: Sequence[Coefficient], level: float, assumed: str) -> Coefficient:
    unit = rows[0].unit
    kind = "sd" if name == "a_v" else "range"
    values = [row.value for row in rows if row.value is not None]
    if len(values) < len(rows):
        note = f"{len(rows) - len(values)} of {len(rows)} sets without a value"
        return Coefficient(
            source, shape, name, "mean", None, unit, None, kind, None, None, None, None, level, len(values), "missing",
            note, assumed,
        )  # fmt: skip
    mean = float(np.mean(values))
    sd = float(np.std(values, ddof=1)) if len(values) > 1 else None
    ci = mean_interval(mean, sd, len(values), level) if sd is not None else (None, None)
    if name == "a_v":
        spread, low, high = sd, None if sd is None else mean - sd, None if sd is None else mean + sd
    else:
        spread, low, high = max(values) - min(values), min(values), max(values)
    return Coefficient(
        source, shape, name, "mean", mean, unit, spread, kind, low, high, ci[0], ci[1], level, len(values), "current",
        "", assumed,
    )  # fmt: skip


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
