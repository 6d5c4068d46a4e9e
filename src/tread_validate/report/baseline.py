"""What moved since the accepted baseline: flipped verdicts first, then what they rest on, then what moved."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..compare.tables import Delta, read_rows
from . import wording
from .content import Cell, Column, Item, Paragraph, Row, Section, Table, Tone
from .marks import Marks

TITLE = "Change since the accepted baseline"
KINDS = {
    "flip": "Verdicts that flipped",
    "rule": "What verdicts rest on",
    "input": "Inputs",
    "run": "Runs that moved",
    "consequence": "What follows from them",
}
LIMIT = 400


def baseline_section(delta: Path | None, marks: Marks) -> tuple[Section, tuple[Tone, str] | None]:
    """Return the section, and for the summary a tone and a sentence (None where no check was made)."""
    if delta is None or not delta.is_file():
        words = "No check against a baseline was made for this report; the command “tread-validate check” makes one."
        return Section("baseline", TITLE, (Paragraph(words),)), None
    rows = read_rows(delta, Delta)
    failed = [row for row in rows if not row.passed]
    outcome: tuple[Tone, str] = ("good", "No number and no word differs from the baseline beyond its noise.")
    if failed:
        flips = sum(row.kind == "flip" for row in failed)
        places = len({(row.in_table, row.row_key) for row in failed})
        words = f"{wording.plural(flips, 'verdict')} flipped; " if flips else "No verdict flipped; "
        outcome = ("bad", f"{words}{wording.plural(places, 'row')} moved beyond noise, or are new, missing or stale.")
    items: list[Item] = [Paragraph(outcome[1])]
    if rows:
        items.append(_table(rows))
    return Section("baseline", TITLE, tuple(items)), outcome


def _table(rows: Sequence[Delta]) -> Table:
    columns = (
        Column("What happened"),
        Column("Where", wide=True),
        Column("Column"),
        Column("Baseline", numeric=True),
        Column("Now", numeric=True),
        Column("Times its noise", numeric=True),
    )
    lines = tuple(_line(row) for row in rows[:LIMIT])
    caption = f"First {LIMIT} of {len(rows)} rows." if len(rows) > LIMIT else ""
    return Table("delta", "Every cell that is not what it was", columns, lines, caption)


def _line(row: Delta) -> Row:
    name = row.name.removesuffix(f": {row.in_column}") if row.in_column else row.name
    unit = wording.unit(row.unit)
    cells = (
        Cell(row.outcome, tone="" if row.passed else "bad", note=row.note),
        Cell(name),
        Cell(row.in_column.replace("_", " ") or "whole row"),
        Cell(f"{row.baseline or '–'} {unit if row.baseline else ''}".strip()),
        Cell(f"{row.current or '–'} {unit if row.current else ''}".strip()),
        Cell(wording.digits(row.times_noise), sort=row.times_noise),
    )
    return Row(cells, group=KINDS.get(row.kind, row.kind) if not row.passed else "Within noise")
