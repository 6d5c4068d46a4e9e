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
    """Return every published statement once, with what each source gives for it and the verdict under the value."""
    rows = records(tables.claims)
    sources = _model_sources(rows)
    order = {kind: rank for rank, kind in enumerate(CLAIM_GROUPS)}
    found: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for record in rows:
        kind = "context" if record["status"] == "not_compared" else str(record["kind"])
        found.setdefault((kind, str(record["claim_id"])), []).append(record)
    ordered = sorted(found.items(), key=lambda item: order.get(item[0][0], 0))
    columns = (
        Column("Section"),
        Column("Published statement", wide=True),
        Column("Published", numeric=True),
        Column("Unit"),
        *(Column(wording.source(name), numeric=True) for name in sources),
        Column("From the study or the paper", wide=True),
    )
    lines = tuple(_line(kind, members, sources, marks) for (kind, _), members in ordered)
    caption = "Under each value its verdict and its error, in per cent or in the unit."
    return Table("claims", "What the paper states, and what is found here", columns, lines, caption, with_marks=True)


def _model_sources(rows: list[dict[str, Any]]) -> list[str]:
    """Return the FE and spring sources in order of appearance, FE first."""
    names = dict.fromkeys(str(row["source"]) for row in rows)
    models = [name for name in names if name.startswith(("fe:", "spring:")) and not name.endswith(":published")]
    return sorted(models, key=lambda name: not name.startswith("fe:"))


def _line(kind: str, members: list[dict[str, Any]], sources: list[str], marks: Marks) -> Row:
    first = members[0]
    published = number(first["published"])
    stated, bounds = _stated(first, published)
    by_source = {str(record["source"]): record for record in members}
    others = [record for record in members if str(record["source"]) not in sources]
    cells = (
        Cell(str(first["section"])),
        Cell(str(first["statement"])[:1].upper() + str(first["statement"])[1:]),
        value_cell(published, stated, note=bounds),
        Cell(wording.unit(str(first["unit"]))),
        *(_found(by_source.get(name)) for name in sources),
        _other(others),
    )
    own = marks.of(*(record["assumed"] for record in members))
    return Row(cells, own, group=CLAIM_GROUPS.get(kind, kind))


def _found(record: dict[str, Any] | None) -> Cell:
    """Return a source's value with its verdict, error and note; nothing where the source has no part in it."""
    if record is None:
        return Cell("")
    value, verdict = number(record["computed"]), verdict_cell(record["verdict"], record["note"], record["status"])
    error = number(record["error"])
    parts = [verdict.text, _error(error, str(record["error_type"])) if error is not None else "", verdict.note]
    return Cell(_computed(value), sort=value, tone=verdict.tone, note="; ".join(part for part in parts if part))


def _other(members: list[dict[str, Any]]) -> Cell:
    """Return what the study's inputs or other published numbers give, and why nothing is compared."""
    texts, notes = [], []
    for record in members:
        cell = _found(record)
        name = str(record["source"])
        if number(record["computed"]) is not None:
            texts.append(f"{cell.text} ({wording.source(name)})" if name else cell.text)
        notes.append(cell.note)
    tone = _found(members[0]).tone if members else ""
    return Cell("; ".join(texts), tone=tone, note="; ".join(dict.fromkeys(note for note in notes if note)))


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
