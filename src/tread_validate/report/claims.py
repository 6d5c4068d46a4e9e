"""Published statements with their computed counterparts."""

from __future__ import annotations

from collections.abc import Sequence

from ..compare.tables import ClaimRow
from . import wording
from .content import Cell, Column, Row, Table
from .marks import Marks
from .results import assessment_cell, value_cell
from .tables import Tables

NOTHING = 1e-4  # less than the last digit of any published number, in its unit
# what agreement with a published statement is worth, by the claims' `kind`
CLAIM_GROUPS = {
    "model": "Predicted by a model, compared with the paper",
    "tuned": "Met because the surrogate compound was made to meet it",
    "study": "Follows from the study's inputs alone",
    "published": "Published numbers against each other",
    "input": "Taken over as an input",
    "context": "Not compared, and why",
}


def claims_table(tables: Tables, marks: Marks) -> Table:
    """Return every published statement once, with what each source gives for it and the assessment under the value."""
    sources = _model_sources(tables.claims)
    order = {kind: rank for rank, kind in enumerate(CLAIM_GROUPS)}
    found: dict[tuple[str, str], list[ClaimRow]] = {}
    for row in tables.claims:
        kind = "context" if row.status == "not_compared" else row.kind
        found.setdefault((kind, row.claim_id), []).append(row)
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
    caption = "Under each value its assessment and its error, in per cent or in the unit."
    return Table(
        "claims",
        "What the paper states, and what is found here",
        columns,
        lines,
        caption,
        with_marks=True,
        csv="claims.csv",
        help="Grouped by what agreement is worth; a model is judged only where the inputs are the paper's.",
    )


def _model_sources(rows: Sequence[ClaimRow]) -> list[str]:
    """Return the FE and spring sources in order of appearance, FE first."""
    names = dict.fromkeys(row.source for row in rows)
    kinds = ("fe:", "spring:", "model:")
    models = [name for name in names if name.startswith(kinds) and not name.endswith(":published")]
    return sorted(models, key=lambda name: not name.startswith("fe:"))


def _line(kind: str, members: list[ClaimRow], sources: list[str], marks: Marks) -> Row:
    first = members[0]
    stated, bounds = _stated(first)
    by_source = {row.source: row for row in members}
    others = [row for row in members if row.source not in sources]
    cells = (
        Cell(first.section),
        Cell(first.statement[:1].upper() + first.statement[1:]),
        value_cell(first.published, stated, note=bounds),
        Cell(wording.unit(first.unit) or "–"),
        *(_found(by_source.get(name)) for name in sources),
        _other(others),
    )
    own = marks.of(*(row.assumed for row in members))
    return Row(cells, own, group=CLAIM_GROUPS.get(kind, kind))


def _found(row: ClaimRow | None) -> Cell:
    """Return a source's value with its assessment, error and note; nothing where the source has no part in it."""
    if row is None:
        return Cell("–", tone="mute")
    assessment = assessment_cell(row.assessment, row.note, row.status)
    parts = [assessment.text, _error(row.error, row.error_type) if row.error is not None else "", assessment.note]
    note = "; ".join(part for part in parts if part)
    return Cell(_computed(row.computed), sort=row.computed, tone=assessment.tone, note=note)


def _other(members: list[ClaimRow]) -> Cell:
    """Return what the study's inputs or other published numbers give, and why nothing is compared."""
    texts, notes = [], []
    for row in members:
        cell = _found(row)
        if row.computed is not None:
            texts.append(f"{cell.text} ({wording.source(row.source)})" if row.source else cell.text)
        notes.append(cell.note)
    tone = _found(members[0]).tone if members else ""
    return Cell("; ".join(texts) or "–", tone=tone, note="; ".join(dict.fromkeys(note for note in notes if note)))


def _computed(value: float | None) -> str:
    """Write a computed value with four digits; one that is zero but for rounding is 0."""
    return wording.plain(0.0 if value is not None and abs(value) < NOTHING else value, 4)


def _error(value: float | None, error_type: str) -> str:
    """Write a relative error in per cent, an absolute one in the row's unit, which stands beside it."""
    return wording.error(0.0 if value is not None and abs(value) < NOTHING else value, error_type)


def _stated(row: ClaimRow) -> tuple[str, str]:
    """Return the published value as printed, and its bounds; a range without a value stands in the value's place."""
    low, high = row.published_low, row.published_high
    kind = "" if row.spread_kind == "none" else row.spread_kind
    bounds = f"{wording.plain(low)} to {wording.plain(high)}" if low is not None and high is not None else ""
    if row.published is None:
        return bounds or "–", kind if bounds else ""
    return wording.plain(row.published), f"{bounds} ({kind})" if bounds and kind else bounds or kind
