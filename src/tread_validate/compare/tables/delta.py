"""Rows of what moved since the accepted baseline, and of the headline numbers of every baseline so far."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal

from .row import TableColumn, TableRow, column, table_row
from .runs import SOURCE

Outcome = Literal["within", "moved", "new", "missing", "stale", "changed"]
OF_ERROR = ("error", "u_numerical", "u_input", "u_data", "uncertainty", "tolerance")
PLACES = ("source", "reference_source", "case_id", "quantity", "metric")


@table_row
class Delta(TableRow):
    """What became of one cell, or of a whole row where `in_column` is empty."""

    table = "delta"
    title = "Every cell that is not what it was in the accepted baseline"
    key = ("in_table", "row_key", "in_column")

    outcome: Outcome = column(
        "`within` its noise; `moved` beyond it; `new`, `missing`: a row or a value on one side only; `stale`: a run "
        "or reference that is not current; `changed`: another word"
    )
    kind: str = column(
        "`flip`: an assessment; `rule`: what they depend on (tolerance, noise, published value); `input`; `run`: a "
        "scalar of a run; `consequence`: what is computed from runs"
    )
    in_table: str = column("table of the results")
    row_key: str = column("key of the row, `, ` between its parts")
    source: str = column(SOURCE)
    reference_source: str = column(SOURCE)
    case_id: str = column("name of the case, or of the statement")
    quantity: str = column("scalar, force or coefficient")
    metric: str = column("`scalar`, score, shape or set")
    in_column: str = column("column of the cell; empty for a whole row")
    unit: str = column("unit of the numbers")
    baseline: str = column("accepted value")
    current: str = column("value of today")
    change: float | None = column("current less baseline")
    noise_width: float = column("change that another processor may make")
    times_noise: float | None = column("|change| over that; empty where there is no number to compare")
    passed: bool = column("whether the outcome is `within`")
    note: str = column("a word on it")

    @classmethod
    def of_row(cls, table: str, kind: str, outcome: Outcome, cells: Mapping[str, str], name: str, note: str) -> Delta:
        """Return the fate of a whole row (or, with a name, of a whole column)."""
        return cls(
            outcome, kind, table, _key(table, cells), *_place(cells), name, "", "", "", None, 0.0, None,
            outcome == "within", note,
        )  # fmt: skip

    @classmethod
    def of_cell(
        cls, table: str, kind: str, outcome: Outcome, cells: Mapping[str, str], found: TableColumn, a: str, b: str,
        change: float | None, width: float, note: str,
    ) -> Delta:  # fmt: skip
        """Return the fate of one cell."""
        times = None
        if change is not None and width > 0.0:
            times = abs(change) / width
        fraction = found.name in OF_ERROR and cells.get("error_type") == "relative"
        unit = found.unit or (cells.get("unit", "") if found.kind == "number" and not fraction else "")
        return cls(
            outcome, kind, table, _key(table, cells), *_place(cells), found.name, unit, a, b, change, width, times,
            outcome == "within", note,
        )  # fmt: skip

    def sortable(self) -> float:
        """Return how far out the cell is: infinitely, where there is no number to compare."""
        if self.times_noise is None or not math.isfinite(self.times_noise):
            return 0.0 if self.passed else 1e300
        return self.times_noise

    @property
    def name(self) -> str:
        """Words that say which cell it is."""
        against = f" against {self.reference_source}" if self.reference_source else ""
        parts = [f"{self.source}{against}", self.case_id, self.quantity, "" if self.metric == "scalar" else self.metric]
        where = ", ".join(part for part in parts if part)
        return f"{self.in_table}: {where}" + (f": {self.in_column}" if self.in_column else "")


@table_row
class TrendRow(TableRow):
    """One headline number of one accepted baseline."""

    table = "trend"
    title = "Headline numbers of every accepted baseline, oldest first"
    key = ("when", "predicted_source", "reference_source", "quantity", "metric")

    when: str = column("when it was accepted, UTC")
    commit: str = column("commit of the code that made the tables")
    reason: str = column("why it was accepted")
    predicted_source: str = column(SOURCE)
    reference_source: str = column(SOURCE)
    quantity: str = column("scalar, or force whose histories are compared")
    metric: str = column("`scalar`, or the score of two histories")
    unit: str = column("unit of the errors; 1 for a relative one or a score")
    compared: int = column("cases with an error")
    passed: int = column("cases whose error is within its tolerance")
    mean_abs_error: float | None = column("mean of |error|")
    largest_abs_error: float | None = column("largest |error|")


def _place(cells: Mapping[str, str]) -> tuple[str, str, str, str, str]:
    """Return source, reference, case, quantity and metric of a row of any table."""

    def first(*names: str) -> str:
        return next((cells[name] for name in names if cells.get(name)), "")

    return (
        first("predicted_source", "source", "source_b"),
        first("reference_source", "source_a"),
        first("case_id", "claim_id", "id", "group", "input"),
        first("quantity", "coefficient"),
        first("metric", "variation") or _set(cells),
    )


def _set(cells: Mapping[str, str]) -> str:
    """Return shape and set of a coefficient, empty for rows of anything else."""
    if "coefficient" not in cells:
        return ""
    return " ".join(cells[name] for name in ("shape", "set") if cells.get(name))


def _key(table: str, cells: Mapping[str, str]) -> str:
    from .catalogue import TABLES

    names = TABLES[table].key if table in TABLES else tuple(cells)
    return ", ".join(cells.get(name, "") for name in names)
