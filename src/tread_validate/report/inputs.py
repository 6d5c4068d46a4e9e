"""Sections on what a report depends on: assumptions, published inputs, references, provenance."""

from __future__ import annotations

import re
from collections.abc import Sequence

from .. import provenance
from ..compare.tables import PublishedRow, cell
from ..compare.tables import TableRow as ResultRow
from . import wording
from .content import Cell, Column, Item, Paragraph, Row, Section, Table
from .marks import Marks
from .tables import Tables

# endings of column names and the units they stand for; the longest match comes first
UNITS = {
    "percent_s_per_m": "% per m/s", "percent_per_degC": "% per °C", "N_s": "N s", "rad_s": "rad/s", "m_s": "m/s",
    "percent": "%", "degC": "°C", "MPa": "MPa", "mm": "mm", "N": "N", "s": "s", "mb": "MB",
}  # fmt: skip

SPELLED = {
    "abs": "absolute", "ci": "confidence interval", "fe": "FE", "iso18571": "ISO/TS 18571", "p05": "5th percentile",
    "p95": "95th percentile", "sd": "standard deviation", "tangential": "longitudinal", "gent": "Gent",
    "lindley": "Lindley", "own": "study's",
}  # fmt: skip


def inputs_section(tables: Tables, marks: Marks) -> Section:
    """Return the assumptions with their codes, and what the paper's other numbers are used for."""
    counts = {row.input: row.cases for row in tables.assumed}
    rows = []
    for mark in marks.all():
        name, _, source = mark.text.partition(f" ({mark.origin})")
        cases = counts.get(name, counts.get(f"{name} ({mark.origin})"))
        cells = (
            Cell(mark.code),
            Cell(name),
            Cell(mark.origin),
            Cell(source.removeprefix(": ") or "no run of this study takes it"),
            Cell("–" if cases is None else f"{cases}", sort=cases),
        )
        rows.append(Row(cells, key=f"assumption-{mark.code}"))
    columns = (
        Column("Code"),
        Column("Input"),
        Column("Origin"),
        Column("Surrogate, and why", wide=True),
        Column("Cases that depend on it", numeric=True),
    )
    assumptions = Table(
        "assumptions", "Assumed and synthetic inputs", columns, tuple(rows), empty="None.", csv="assumed.csv"
    )
    items: list[Item] = [
        Paragraph(
            "Assumed: a value that the paper does not give and that we chose. Synthetic: data made up to have the "
            "published features. Neither is the paper's; every number that depends on one carries its code."
        ),
        assumptions,
        _published(tables),
    ]
    return Section("inputs", "Inputs and assumptions", tuple(items))


def _published(tables: Tables) -> Table:
    rows = []
    for row in tables.published:
        cells = (
            Cell(row.section),
            Cell(row.statement),
            Cell(_printed(row), sort=row.value),
            Cell(row.comparability),
            Cell(row.comparison),
        )
        rows.append(Row(cells))
    columns = (
        Column("Section"),
        Column("Statement", wide=True),
        Column("Value", numeric=True),
        Column("Used as"),
        Column("How it is compared, or why not", wide=True),
    )
    return Table(
        "published", "Every number in the paper's text", columns, tuple(rows), folded=True, csv="published.csv"
    )


def _printed(row: PublishedRow) -> str:
    """Return a printed number, or the range that stands in its place, with its unit; a dash where neither is."""
    shown = "" if row.value is None else wording.plain(row.value)
    if row.value is None and row.low is not None and row.high is not None:
        shown = f"{wording.plain(row.low)} to {wording.plain(row.high)}"
    return f"{shown} {wording.unit(row.unit)}".strip() if shown else "–"


def sensitivity_table(tables: Tables) -> Table | None:
    """Return how the scores move with window and sampling, where that was tabulated."""
    if not tables.sensitivity:
        return None
    rows = []
    for row in tables.sensitivity:
        cells = (
            Cell(wording.quantity(row.quantity, row.metric)),
            Cell(row.variation),
            Cell(wording.digits(row.samples, 6), sort=row.samples),
            Cell(wording.digits(row.value, 4), sort=row.value),
            Cell(wording.signed(wording.digits(row.change)), sort=row.change),
            Cell(row.case_id),
        )
        rows.append(Row(cells))
    columns = (
        Column("Score", wide=True),
        Column("Variation"),
        Column("Samples", numeric=True),
        Column("Value", numeric=True),
        Column("Change", numeric=True),
        Column("Case"),
    )
    title = "Sensitivity of the scores to window and sampling"
    return Table("sensitivity", title, columns, tuple(rows), folded=True, csv="sensitivity.csv")


def provenance_section(tables: Tables, summary: str = "") -> Section:
    """Return commit, versions and input digests; `summary` is the file for programs beside the page, if any."""
    data = tables.provenance
    facts = [
        ("Code commit", data.commit),
        ("Package version", data.version),
        ("Study", data.study),
        ("Study SHA-256", data.study_digest),
        ("Report made by commit", provenance.commit()),
    ]
    states = [
        (wording.source(name), ", ".join(f"{count} {state}" for state, count in counts.items() if count))
        for name, counts in data.sources.items()
    ]
    tables_made = [
        _facts("provenance-code", "Code and study", "Fact", facts),
        _facts("provenance-sources", "Sources", "Source", states),
        _facts("provenance-packages", "Packages", "Package", list(data.packages.items()), folded=True),
        _facts("provenance-inputs", "Input files, SHA-256", "File", list(data.inputs.items()), folded=True),
    ]
    notes = [Paragraph("The same code on the same inputs gives this report byte for byte.")]
    if summary:
        notes.append(Paragraph("Assessments, references and baseline as data, for other programs: ", link=summary))
    return Section("provenance", "Provenance", (*notes, *(table for table in tables_made if table.rows)))


def _facts(key: str, title: str, name: str, facts: list[tuple[str, str]], folded: bool = False) -> Table:
    rows = tuple(Row((Cell(left), Cell(right))) for left, right in facts)
    return Table(key, title, (Column(name), Column("Value", wide=True)), rows, folded=folded)


def stamp(tables: Tables) -> tuple[tuple[str, str], ...]:
    """Return the facts that head and foot the report."""
    data = tables.provenance
    return (
        ("Study", data.study),
        ("Study SHA-256", data.study_digest[:12]),
        ("Code", f"tread_validate {data.version}, commit {data.commit}"),
    )


def plain_table(
    key: str, kind: type[ResultRow], found: Sequence[ResultRow], marks: Marks, *, folded: bool = False, limit: int = 400
) -> Table:
    """Return any table of results as it is, headed by what its row class declares."""
    shown = [item for item in kind.columns() if item.name != "assumed"]
    rows = []
    for one in found[:limit]:
        values = one.cells()
        cells = []
        for item in shown:
            value = values[item.name]
            if item.kind in ("number", "integer"):
                cells.append(Cell(wording.plain(value, 4), sort=value))
            else:
                cells.append(Cell(wording.plain_text(cell(value))))
        rows.append(Row(tuple(cells), marks.of(values.get("assumed", ""))))
    columns = tuple(Column(*_title(item.name), numeric=item.kind in ("number", "integer")) for item in shown)
    caption = f"First {limit} of {len(found)} rows." if len(found) > limit else ""
    marked = len(shown) < len(kind.columns())
    return Table(key, kind.title, columns, tuple(rows), caption, with_marks=marked, folded=folded)


def _title(name: str) -> tuple[str, str]:
    """Split a column's name into words and the unit that it ends with."""
    for ending, unit in UNITS.items():
        if name.endswith(f"_{ending}"):
            return _words(name.removesuffix(f"_{ending}")), unit
    return _words(name), ""


def _words(name: str) -> str:
    """Write a column's name in words: symbols stay as they are, short forms are spelled out."""
    words = re.sub(r"\ba (v|theta)\b", r"a_\1", " ".join(SPELLED.get(word, word) for word in name.split("_")))
    return words if words.startswith("a_") else words[:1].upper() + words[1:]
