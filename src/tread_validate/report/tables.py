"""The comparison's tables as rows, and free tables whose columns the report does not know."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ..compare.tables import (
    AssumedRow,
    CaseRow,
    ClaimRow,
    Coefficient,
    Difference,
    Ensemble,
    ExpectedRow,
    MetricRow,
    PeakRow,
    PublishedRow,
    Residual,
    Sensitivity,
    StatisticsRow,
    read_rows,
)  # fmt: skip
from ..compare.tables.made_from import MadeFrom, read_made_from

Pair = tuple[str, str]
"""Predicted source and reference source."""


@dataclass(frozen=True)
class Tables:
    """Every table of one comparison."""

    cases: tuple[CaseRow, ...]
    peaks: tuple[PeakRow, ...]
    errors: tuple[MetricRow, ...]
    ensemble: tuple[Ensemble, ...]
    expected: tuple[ExpectedRow, ...]
    statistics_rows: tuple[StatisticsRow, ...]
    regression: tuple[Coefficient, ...]
    differences: tuple[Difference, ...]
    residuals: tuple[Residual, ...]
    claims: tuple[ClaimRow, ...]
    published: tuple[PublishedRow, ...]
    assumed: tuple[AssumedRow, ...]
    sensitivity: tuple[Sensitivity, ...]
    provenance: MadeFrom
    folder: Path

    def sources(self, kind: str) -> list[str]:
        """Return the sources of `kind` (``spring``, ``fe`` or ``rig``) that have runs, in the order of the peaks."""
        names = dict.fromkeys(row.source for row in self.peaks)
        return [name for name in names if name.split(":")[0] == kind and not name.endswith(":published")]

    def statistics(self, pair: Pair, quantity: str, metric: str = "scalar", group: str = "all") -> Ensemble | None:
        """Return one row of the statistics, None where there is none."""
        for row in self.ensemble:
            if (row.group, row.quantity, row.metric) == (group, quantity, metric) and pair_of(row) == pair:
                return row
        return None

    def sliding(self, pair: Pair) -> tuple[float, float] | None:
        """Return the share of the face that slides, reference and prediction, mean over the cases that give both."""
        both = [
            (row.reference, row.predicted)
            for row in self.errors
            if row.quantity == "slipping_share" and row.metric == "scalar" and pair_of(row) == pair
        ]
        known = [(x, y) for x, y in both if x is not None and y is not None]
        return (sum(x for x, _ in known) / len(known), sum(y for _, y in known) / len(known)) if known else None

    def of_pair(self, pair: Pair) -> list[MetricRow]:
        """Return the errors of one source against one other."""
        return [row for row in self.errors if pair_of(row) == pair]


def pair_of(row: MetricRow | Ensemble) -> Pair:
    """Return who is compared with whom."""
    return row.predicted_source, row.reference_source


def pairs_of(rows: Iterable[MetricRow | Ensemble]) -> list[Pair]:
    """Return every pair once, in order of appearance."""
    return list(dict.fromkeys(map(pair_of, rows)))


def read_tables(folder: Path | str) -> Tables:
    """Read ``results/tables``; a missing table, another column or a cell of another kind is an `InputError`."""
    place = Path(folder)
    return Tables(
        cases=read_rows(place / "cases.csv", CaseRow),
        peaks=read_rows(place / "peaks.csv", PeakRow),
        errors=read_rows(place / "errors.csv", MetricRow),
        ensemble=read_rows(place / "ensemble.csv", Ensemble),
        statistics_rows=read_rows(place / "statistics.csv", StatisticsRow),
        expected=read_rows(place / "expected.csv", ExpectedRow),
        regression=read_rows(place / "regression.csv", Coefficient),
        differences=read_rows(place / "regression_differences.csv", Difference),
        residuals=read_rows(place / "regression_residuals.csv", Residual),
        claims=read_rows(place / "claims.csv", ClaimRow),
        published=read_rows(place / "published.csv", PublishedRow),
        assumed=read_rows(place / "assumed.csv", AssumedRow),
        sensitivity=read_rows(place / "sensitivity.csv", Sensitivity),
        provenance=read_made_from(place),
        folder=place,
    )


def number(value: object) -> float | None:
    """Return a table value as a number, None where nothing (or no number) is written."""
    if isinstance(value, str):
        try:
            value = float(value)
        except ValueError:
            return None
    if not isinstance(value, int | float) and not hasattr(value, "__float__"):
        return None
    result = float(value)
    return None if math.isnan(result) else result
