"""Cases in which stick and slip alternate: means and scatter of FE and models side by side, in place of histories."""

from __future__ import annotations

from collections.abc import Sequence

from ..compare.tables import StatisticsRow
from . import wording
from .content import Cell, Column, Row, Table
from .marks import Marks
from .tables import Tables


def alternating_table(tables: Tables, marks: Marks) -> Table | None:
    """Return the statistics of every run of such a case; None where there is no such case."""
    cases = dict.fromkeys(row.case_id for row in tables.statistics_rows if row.alternates)
    rows: list[Row] = []
    for case_id in cases:
        own = [row for row in tables.statistics_rows if row.case_id == case_id and row.mean_normal_N is not None]
        reference = next(row for row in tables.statistics_rows if row.case_id == case_id and row.alternates)
        rows += [_row(row, reference, marks) for row in own]
    if not rows:
        return None
    columns = (
        Column("Case", wide=True),
        Column("Mean N", "N (error)", numeric=True),
        Column("Mean T", "N (error)", numeric=True),
        Column("RMS of T", "N (error)", numeric=True),
        Column("Scatter of T", "N, RMS", numeric=True),
        Column("Its frequency", "Hz", numeric=True),
    )
    caption = (
        "No reliable history in this regime: friction falls as slip begins or speeds up, and points of the face stick "
        "and slip in turns. Mean, scatter and frequency mean something there; peaks and the course in time are one of "
        "many, and no model is judged by them."
    )
    return Table(
        "alternating", "Where stick and slip alternate", columns, tuple(rows), caption, with_marks=True,
        csv="statistics.csv",
    )  # fmt: skip


def _row(row: StatisticsRow, reference: StatisticsRow, marks: Marks) -> Row:
    names = ("mean_normal_N", "mean_tangential_N", "rms_tangential_N")
    cells: Sequence[Cell] = (
        Cell(row.case_id, case=row.case_id),
        *(_with_error(getattr(row, name), getattr(reference, name), row is reference) for name in names),
        Cell(wording.plain(row.scatter_N, 3), sort=row.scatter_N),
        Cell(wording.plain(row.frequency_Hz, 3), sort=row.frequency_Hz),
    )
    return Row(tuple(cells), marks.of(row.assumed), group=wording.source(row.source))


def _with_error(value: float | None, reference: float | None, own: bool) -> Cell:
    if value is None:
        return Cell("–")
    text = wording.plain(value, 4)
    if own or not reference:
        return Cell(text, sort=value)
    return Cell(f"{text} ({wording.percent(value / reference - 1.0, sign=True)})", sort=value)
