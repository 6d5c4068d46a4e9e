"""Can a_v = 3.4 % s/m and a_theta = -0.60 %/degC belong to one linear compound with the paper's WLF constants?"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize

from ..material import prony_series, relative_shift
from ..study import Case
from ..units import PERCENT
from .rate_response import Coefficients, RigTable, rig_table
from .tables import Compatibility

Array = NDArray[np.float64]

A_V, A_THETA = 0.034, -0.0060
"""Table 1, finite elements, rectangular block: s/m and 1/degC."""
A_V_SD, A_THETA_HALF_RANGE = 0.008, 0.0002
"""Their spread there: standard deviation over four sets, half the range of two."""
TIMES = np.geomspace(1e-8, 1e3, 45)
"""Relaxation times of the search at the data's temperature, s: four a decade."""
STARTS = 8


def compatibility_rows(cases: Sequence[Case], seed: int = 2010) -> list[dict[str, Any]]:
    """Return the published pair, power laws, the study's compound, bell spectra and a search over all spectra.

    `cases` are a study's; the rectangular rig runs among them are used. The rows' columns are those of `Compatibility`.
    """
    rig = [case for case in cases if case.path.gives_coefficients and case.block.shape == "rectangle"]
    if not rig:
        return []
    compound = rig[0].compound
    law, data = compound.time_shift, compound.data_temperature_degC
    table = rig_table(rig, TIMES, law, data)
    warm, cold = table.temperatures[-1], table.temperatures[0]
    decades = float(-np.log10(relative_shift(warm, cold, law)))
    rows = [
        _row("published", "Table 1, finite elements, rectangle", (A_V, A_THETA), A_V_SD, note="to be met at once"),
        *_power_laws(table.speeds, decades, warm - cold),
    ]
    series = prony_series(compound, rig[0].root)
    own = rig_table(rig, series.relaxation_times, law, data)
    found = own.coefficients(np.append(series.moduli, series.long_term_modulus))
    rows.append(_row("the study's compound", "independent springs", found.pair, found.spread))
    rows += _bells(table)
    rows += _search(table, seed)
    return rows


def _row(
    family: str,
    what: str,
    pair: tuple[float, float],
    spread: float | None = None,
    parameter: str = "",
    value: float | None = None,
    note: str = "",
) -> dict[str, Any]:
    meets = (
        abs(pair[0] - A_V) <= A_V_SD,
        abs(pair[1] - A_THETA) <= A_THETA_HALF_RANGE + 1e-12,
        None if spread is None else spread <= A_V_SD + 1e-12,
    )
    percent = (pair[0] / PERCENT, None if spread is None else spread / PERCENT, pair[1] / PERCENT)
    return dict(zip(Compatibility.header(), (family, what, *percent, parameter, value, *meets, note), strict=True))


def _power_laws(speeds: Array, decades: float, span: float) -> list[dict[str, Any]]:
    """Meet either number with E ~ w^m, F ~ (v a_T)^m, and see what the other becomes: both hang on one exponent."""

    def pair(exponent: float) -> tuple[float, float]:
        slope, intercept = np.polyfit(speeds, speeds**exponent, 1)
        return float(slope / intercept), (10.0 ** (-decades * exponent) - 1.0) / span

    for_v = float(brentq(lambda m: pair(m)[0] - A_V, 1e-6, 0.8))
    for_theta = float(brentq(lambda m: pair(m)[1] - A_THETA, 1e-6, 0.8))
    note = (
        f"E ~ w^m; {span:g} degC are {decades:.3f} decades of rate, the speeds {np.log10(speeds[-1] / speeds[0]):.3f}"
    )
    return [
        _row("power law", "exponent that meets a_v", pair(for_v), 0.0, "exponent m", for_v, note),
        _row("power law", "exponent that meets a_theta", pair(for_theta), 0.0, "exponent m", for_theta, note),
    ]


def _bells(table: RigTable) -> list[dict[str, Any]]:
    """Spectra with one bell in log tau over an elastic rest: for each width the one with the least |a_theta|."""
    log_times = np.log10(TIMES)
    rows = []
    for width in (0.5, 0.75, 1.0, 1.5, 2.0, 3.0):
        best: tuple[float, Coefficients, float, float] | None = None
        for centre in np.arange(-7.0, 1.01, 0.25):
            bell = np.exp(-0.5 * ((log_times - centre) / width) ** 2)
            for rest in np.geomspace(0.02, 20.0, 13):
                found = table.coefficients(np.append(bell / bell.sum(), rest))
                if found.pair[0] >= A_V and (best is None or abs(found.pair[1]) < best[0]):
                    best = abs(found.pair[1]), found, centre, rest
        if best is None:
            continue
        _, found, centre, rest = best
        note = f"bell at 10^{centre:.2f} s, elastic rest {rest:.2g} of the bell"
        rows.append(
            _row("one bell", "least |a_theta| with a_v met", found.pair, found.spread, "width, decades", width, note)
        )
    return rows


def _search(table: RigTable, seed: int) -> list[dict[str, Any]]:
    """Search every spectrum >= 0 from many starts: for the pair alone, then with the published spread of a_v too."""
    rows = []
    for what, strict in (("nearest to the pair", False), ("nearest to the pair and its spread", True)):
        random = np.random.default_rng(seed)
        best: tuple[float, Array] | None = None
        for _ in range(STARTS):
            start = random.normal(-3.0, 2.0, TIMES.size + 1)
            found = minimize(_misfit, start, (table, strict), jac=True, method="L-BFGS-B", options={"maxiter": 2000})
            if best is None or found.fun < best[0]:
                best = float(found.fun), _moduli(found.x)
        assert best is not None
        misfit, moduli = best
        coefficients = table.coefficients(moduli)
        strong = moduli[:-1] > 0.03
        where = ", ".join(
            f"{100 * m:.0f} % at {t:.0e} s" for m, t in zip(moduli[:-1][strong], TIMES[strong], strict=True)
        )
        note = f"of E_0: {where}; elastic {100 * moduli[-1]:.0f} %; misfit {misfit:.1e}"
        rows.append(_row("any spectrum >= 0", what, coefficients.pair, coefficients.spread, "misfit", misfit, note))
    return rows


def _moduli(x: Array) -> Array:
    moduli = np.exp(np.clip(x, -20.0, 20.0) - np.max(x))
    return np.asarray(moduli / moduli.sum())


def _misfit(x: Array, table: RigTable, strict: bool) -> tuple[float, Array]:
    """Return squared relative misses in published tolerances, and their gradient in log moduli."""
    moduli = _moduli(x)
    found = table.coefficients(moduli)
    parts = [
        (found.pair[0] - A_V) / A_V_SD,
        (found.pair[1] - A_THETA) / A_THETA_HALF_RANGE,
    ]
    gradients = [found.a_v_gradient.mean(axis=0) / A_V_SD, found.a_theta_gradient.mean(axis=0) / A_THETA_HALF_RANGE]
    if strict and found.spread > A_V_SD:
        centred = found.a_v - found.a_v.mean()
        parts.append((found.spread - A_V_SD) / A_V_SD)
        gradients.append(centred @ found.a_v_gradient / ((centred.size - 1) * found.spread) / A_V_SD)
    value = float(sum(part**2 for part in parts))
    in_moduli = sum((2.0 * part * gradient for part, gradient in zip(parts, gradients, strict=True)), np.zeros(x.size))
    # the coefficients do not change with the scale, so that the normalisation drops out
    return value, np.asarray(in_moduli * moduli)
