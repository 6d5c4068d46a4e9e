"""What the validity map let a reader expect of each model, beside what came out."""

from __future__ import annotations

from collections.abc import Sequence

from ..compare.tables import ExpectedRow
from . import wording
from .content import Cell, Column, Item, Paragraph, Row, Section, Table, Tone
from .marks import Marks
from .tables import Tables

WORDS = {"normal": "Peak N", "impulse": "Impulse of N", "tangential": "Peaks of T"}
NINE_IN_TEN = "nine in ten below"


def expected_section(tables: Tables, marks: Marks) -> Section | None:
    """Return the section; None where no spring model was run."""
    if not tables.expected:
        return None
    items: list[Item] = [
        Paragraph(
            "The validity map has the errors of each model on a designed study of FE runs. Those of the points nearest "
            "to a case say what to expect of it; nine in ten should stay below the limit. A case outside the map says "
            "why."
        )
    ]
    stale = sorted({row.map_made_by for row in tables.expected if row.map_made_by})
    items += [Paragraph(f"Of the map: {words}; make map runs what is missing.", tone="warn") for words in stale]
    items += [_summary(tables.expected, marks), _cases(tables.expected, marks)]
    return Section("expected", "Expected and actual errors", tuple(items))


def _summary(rows: Sequence[ExpectedRow], marks: Marks) -> Table:
    kinds: dict[tuple[str, str, str], list[ExpectedRow]] = {}
    for row in rows:
        kinds.setdefault((row.predicted_source, row.reference_source, row.quantity), []).append(row)
    lines = []
    for (source, reference, quantity), own in kinds.items():
        inside = [row for row in own if not row.outside_map]
        judged = [row for row in inside if row.inside is not None]
        below = sum(bool(row.inside) for row in judged)
        cells = (
            Cell(WORDS[quantity]),
            Cell(f"{len(inside)} of {len(own)}", sort=float(len(inside))),
            _mean([row.expected for row in inside]),
            _mean([None if row.actual is None else abs(row.actual) for row in inside]),
            _mean([row.limit for row in inside]),
            Cell(f"{below} of {len(judged)}" if judged else "–", sort=float(below), tone=_tone(below, len(judged))),
        )
        group = f"{wording.source(source)} compared with {wording.source(reference)}"
        lines.append(Row(cells, marks.of(own[0].assumed), group=group))
    columns = (
        Column("Quantity"),
        Column("Inside the map", "cases", numeric=True),
        Column("Expected error", "mean", numeric=True),
        Column("Actual |error|", "mean", numeric=True),
        Column("Limit", f"{NINE_IN_TEN}, mean", numeric=True),
        Column("Below the limit", "of those with a reference", numeric=True),
    )
    caption = "Means are over the cases inside the map."
    return Table("expected-means", "Expected and actual errors by model", columns, tuple(lines), caption,
                 with_marks=True, csv="expected.csv")  # fmt: skip


def _tone(below: int, count: int) -> Tone:
    """Nine in ten are what the limit promises."""
    return "mute" if not count else "good" if below >= 0.9 * count else "warn"


def _mean(values: Sequence[float | None]) -> Cell:
    known = [value for value in values if value is not None]
    mean = sum(known) / len(known) if known else None
    return Cell(wording.percent(mean), sort=mean)


def _cases(rows: Sequence[ExpectedRow], marks: Marks) -> Table:
    lines = []
    for row in rows:
        outside = row.outside_map or ""
        cells = (
            Cell(row.case_id, case=row.case_id),
            Cell(WORDS[row.quantity]),
            Cell(wording.percent(row.expected), sort=row.expected),
            Cell(wording.percent(row.limit), sort=row.limit),
            Cell(
                wording.percent(row.actual, sign=row.quantity != "tangential"),
                sort=None if row.actual is None else abs(row.actual),
                tone="" if row.inside is None or row.inside else "warn",
                note="" if row.actual is not None else wording.status(row.status),
            ),
            Cell("outside" if outside else "inside", note=outside, tone="warn" if outside else ""),
        )
        group = f"{wording.source(row.predicted_source)} compared with {wording.source(row.reference_source)}"
        lines.append(Row(cells, marks.of(row.assumed), group=group))
    columns = (
        Column("Case", wide=True),
        Column("Quantity"),
        Column("Expected error", numeric=True),
        Column("Limit", NINE_IN_TEN, numeric=True),
        Column("Actual error", numeric=True),
        Column("Of the map"),
    )
    return Table("expected", "Expected and actual errors case by case", columns, tuple(lines), folded=True,
                 with_marks=True, csv="expected.csv")  # fmt: skip
