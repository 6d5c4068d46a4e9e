"""Published statements with their computed counterparts."""

from __future__ import annotations

from typing import Any

from . import wording
from .content import Cell, Column, Row, Table
from .marks import Marks
from .results import value_cell, verdict_cell
from .tables import Tables, number, records

NOTHING = 1e-4  # less than the last digit of any published number, in its unit
# what agreement with a published statement is worth, by the claims' `kind`
CLAIM_GROUPS = {
    "model": "Predicted by a model, compared with the paper",
    "tuned": "Met because the stand-in compound was made to meet it",
    "study": "Follows from the study's inputs alone",
    "published": "Published numbers against each other",
    "input": "Taken over as an input",
    "context": "Not compared, and why",
}


def claims_table(tables: Tables, marks: Marks) -> Table:
    """Return every published statement with its computed counterpart and verdict."""
    rows: list[tuple[int, Row]] = []
    order = {kind: rank for rank, kind in enumerate(CLAIM_GROUPS)}
    for record in records(tables.claims):
        computed, published = number(record["computed"]), number(record["published"])
        unit = wording.unit(str(record["unit"]))
        stated, bounds = _stated(record, published)
        error = number(record["error"])
        cells = (
            Cell(str(record["section"])),
            Cell(str(record["statement"])),
            value_cell(published, stated, note=bounds),
            value_cell(computed, _computed(computed)),
            Cell(unit),
            value_cell(error, _error(error, str(record["error_type"]))),
            Cell(wording.source(str(record["source"])) if record["source"] else "–"),
            verdict_cell(record["verdict"], record["note"], record["status"]),
        )
        group = "context" if record["status"] == "not_compared" else str(record["kind"])
        rows.append(
            (order.get(group, 0), Row(cells, marks.of(record["assumed"]), group=CLAIM_GROUPS.get(group, group)))
        )
    rows.sort(key=lambda item: item[0])
    columns = (
        Column("Section"),
        Column("Published statement", wide=True),
        Column("Published", numeric=True),
        Column("Computed", numeric=True),
        Column("Unit"),
        Column("Error", "% or in the unit", numeric=True),
        Column("Source"),
        Column("Verdict", wide=True),
    )
    title = "What the paper states, and what is found here"
    return Table("claims", title, columns, tuple(row for _, row in rows), with_marks=True)


def _computed(value: float | None) -> str:
    """Write a computed value with four digits; one that is zero but for rounding is 0."""
    return wording.plain(0.0 if value is not None and abs(value) < NOTHING else value, 4)


def _error(value: float | None, error_type: str) -> str:
    """Write a relative error in per cent, an absolute one in the row's unit, which stands beside it."""
    return wording.error(0.0 if value is not None and abs(value) < NOTHING else value, error_type)


def _stated(record: dict[str, Any], value: float | None) -> tuple[str, str]:
    """Return the published value as printed, and its bounds; a range without a value stands in the value's place."""
    low, high = number(record["published_low"]), number(record["published_high"])
    kind = str(record.get("spread_kind", "") or "")
    kind = "" if kind == "none" else kind
    bounds = f"{wording.plain(low)} to {wording.plain(high)}" if low is not None and high is not None else ""
    if value is None:
        return bounds or "–", kind if bounds else ""
    return wording.plain(value), f"{bounds} ({kind})" if bounds and kind else bounds or kind
