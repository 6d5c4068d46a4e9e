"""Whether two sources' coefficients differ by more than their spread."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.special import stdtr, stdtrit

from ..tables import Coefficient, Difference
from .line import LEVEL

RESOLUTION = 1e-4
"""Of a coefficient. Its digits, and other processors, leave 5e-6 open; a p value is determined where scatter stands
clear of that, and is not given where it does not."""


def differences(rows: Sequence[Coefficient], level: float = LEVEL) -> tuple[Difference, ...]:
    """Compare the mean coefficients of every pair of sources, shape by shape.

    Two sources with the same sets (both run here) are compared set by set (paired t test); with a published mean,
    only mean, spread and number of sets are known: Welch's t test (Biometrika 34 (1947) 28-35). The range of two
    values is sqrt(2) times their sample standard deviation.
    """
    means = [row for row in rows if row.set == "mean"]
    sets: dict[tuple[str, str, str], dict[str, float | None]] = {}
    for row in rows:
        if row.set != "mean":
            sets.setdefault((row.source, row.shape, row.coefficient), {})[row.set] = row.value
    found = []
    for index, a in enumerate(means):
        for b in means[index + 1 :]:
            if (a.shape, a.coefficient) == (b.shape, b.coefficient) and a.source != b.source:
                key = (a.shape, a.coefficient)
                found.append(_compare(a, b, sets.get((a.source, *key), {}), sets.get((b.source, *key), {}), level))
    return corrected(sorted(found, key=lambda d: (d.shape, d.coefficient)), level)


def corrected(rows: Sequence[Difference], level: float = LEVEL) -> tuple[Difference, ...]:
    """Correct the p values for their number, family by family.

    Holm, Scand. J. Stat. 6 (1979) 65-70: at a level of 5 % one family in twenty has any false difference in it, however
    many tests it holds; uncorrected, one test in twenty has.
    """
    from statsmodels.stats.multitest import multipletests  # late: half a second, and most commands test nothing

    out = list(rows)
    for family in dict.fromkeys(row.family for row in rows):
        own = [i for i, row in enumerate(rows) if row.family == family and row.p_value is not None]
        if not own:
            continue
        _, p_holm, _, _ = multipletests([rows[i].p_value for i in own], alpha=1.0 - level, method="holm")
        for i, p in zip(own, p_holm, strict=True):
            out[i] = replace(rows[i], p_holm=float(p), tests=len(own), significant=bool(p < 1.0 - level))
    return tuple(out)


def sample_sd(row: Coefficient) -> float | None:
    """Return the sample standard deviation behind a mean row, from its spread; None where it has none."""
    if row.spread is None or row.n < 2:
        return None
    if row.spread_kind == "sd":
        return row.spread
    return row.spread / math.sqrt(2.0) if row.n == 2 else None


def _compare(
    a: Coefficient,
    b: Coefficient,
    sets_a: dict[str, float | None],
    sets_b: dict[str, float | None],
    level: float,
) -> Difference:
    assumed = "; ".join(sorted({part for row in (a, b) for part in row.assumed.split("; ") if part}))
    blank = Difference(
        shape=a.shape, coefficient=a.coefficient, source_a=a.source, source_b=b.source, difference=None, unit=a.unit,
        ci_low=None, ci_high=None, p_value=None, p_holm=None, family=_family(a.source, b.source), tests=0,
        significant=None, test="", status="missing", note="", assumed=assumed,
    )  # fmt: skip
    if a.value is None or b.value is None:
        lost = [row.source for row in (a, b) if row.value is None]
        return replace(blank, note="no value of " + " and ".join(lost))
    difference = b.value - a.value
    blank = replace(blank, difference=difference, status="undefined")
    if len(sets_a) > 1 and sets_a.keys() == sets_b.keys():
        pairs = np.array([_known(sets_b[name]) - _known(sets_a[name]) for name in sets_a])
        freedom, error = float(pairs.size - 1), float(np.std(pairs, ddof=1)) / math.sqrt(pairs.size)
        test = "paired t"
    else:
        sd_a, sd_b = sample_sd(a), sample_sd(b)
        if sd_a is None or sd_b is None:
            return replace(blank, note="a spread is not known")
        va, vb = sd_a**2 / a.n, sd_b**2 / b.n
        if va + vb == 0.0:
            return replace(blank, note="no spread in either")
        freedom = (va + vb) ** 2 / (va**2 / (a.n - 1) + vb**2 / (b.n - 1))
        error, test = math.sqrt(va + vb), "Welch t"
    if error <= RESOLUTION * max(abs(a.value), abs(b.value)):
        return replace(blank, test=test, note="no scatter between the sets")
    half = float(stdtrit(freedom, 0.5 + 0.5 * level)) * error
    p = float(2.0 * stdtr(freedom, -abs(difference) / error))
    return replace(
        blank, ci_low=difference - half, ci_high=difference + half, p_value=p, test=test,
        status="current",
    )  # fmt: skip


def _family(a: str, b: str) -> str:
    outside = any(source.endswith((":published", ":measured")) for source in (a, b))
    return "measured or published" if outside else "models"


def _known(value: float | None) -> float:
    return math.nan if value is None else value
