"""Published statements with their computed counterparts."""

from __future__ import annotations

from typing import Any

from . import wording
from .content import Cell, Column, Row, Table
from .marks import Marks
from .results import value_cell, verdict_cell
from .tables import Tables, number, records

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
        stated, bounds = _stated(record, published, unit)
        error = number(record["error"])
        cells = (
            Cell(str(record["section"])),
            Cell(str(record["statement"])),
            value_cell(published, stated, note=bounds),
            Cell(wording.source(str(record["source"])) if record["source"] else "–"),
            value_cell(computed, f"{wording.plain(computed, 4)} {unit}".strip() if computed is not None else "–"),
            value_cell(error, wording.error(error, str(record["error_type"]), unit)),
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
        Column("Source"),
        Column("Computed", numeric=True),
        Column("Error", numeric=True),
        Column("Verdict", wide=True),
    )
    title = "What the paper states, and what is found here"
    return Table("claims", title, columns, tuple(row for _, row in rows), with_marks=True)


def _stated(record: dict[str, Any], value: float | None, unit: str) -> tuple[str, str]:
    """Return the published value as printed, and its bounds; a range without a value stands in the value's place."""
    low, high = number(record["published_low"]), number(record["published_high"])
    kind = str(record.get("spread_kind", "") or "")
    kind = "" if kind == "none" else kind
    bounds = f"{wording.plain(low)} to {wording.plain(high)}" if low is not None and high is not None else ""
    if value is None:
        return (f"{bounds} {unit}".strip() if bounds else "–"), kind if bounds else ""
    return f"{wording.plain(value)} {unit}".strip(), f"{bounds} ({kind})" if bounds and kind else bounds or kind
