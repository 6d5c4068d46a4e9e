"""Headline numbers of every baseline that was accepted: a small table that only grows."""

from __future__ import annotations

from pathlib import Path

from ...files import write_text
from ..quantities import HEADLINE
from ..tables import Ensemble, TrendRow, read_rows, rows_text
from .store import Acceptance

TREND = f"{TrendRow.table}.csv"


def read_trend(folder: Path | str) -> tuple[TrendRow, ...]:
    """Return the headline numbers of every baseline so far, oldest first; none where none is kept."""
    path = Path(folder) / TREND
    return read_rows(path, TrendRow) if path.is_file() else ()


def add_to_trend(folder: Path | str, tables: Path | str, acceptance: Acceptance) -> tuple[TrendRow, ...]:
    """Append the headline numbers of the tables; what stands there already is not touched."""
    place = Path(folder)
    rows = [*read_trend(place), *headline(read_rows(Path(tables) / "ensemble.csv", Ensemble), acceptance)]
    write_text(place / TREND, rows_text(TrendRow, rows))
    return tuple(rows)


def headline(statistics: tuple[Ensemble, ...], acceptance: Acceptance) -> list[TrendRow]:
    """Return a row for every model and headline quantity over all cases that could be compared."""
    return [
        TrendRow(
            acceptance.when, acceptance.commit, acceptance.reason, row.predicted_source, row.reference_source,
            row.quantity, row.metric, row.unit, row.compared, row.passed, row.mean_abs_error, row.largest_abs_error,
        )
        for row in statistics
        if row.group == "all" and row.compared and (row.quantity, row.metric) in HEADLINE
    ]  # fmt: skip
