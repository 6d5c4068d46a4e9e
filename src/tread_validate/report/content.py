"""What a report says, apart from how it is set: sections of paragraphs, tables, figures and widgets.

The HTML page and the PDF are both made from one `Report`, so they cannot disagree.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

Tone = Literal["", "good", "bad", "unknown", "warn", "mute"]


@dataclass(frozen=True)
class Mark:
    """An assumed or synthetic input that a number rests on: its code in the list of assumptions, and its kind."""

    code: str
    origin: str
    text: str


@dataclass(frozen=True)
class Cell:
    """One table cell: what is shown, what it sorts by, and its tone (never the only carrier of a meaning)."""

    text: str
    sort: float | str | None = None
    tone: Tone = ""
    note: str = ""


@dataclass(frozen=True)
class Column:
    """A table column; `unit` is printed under the title, `marks` tag every number below."""

    title: str
    unit: str = ""
    numeric: bool = False
    marks: tuple[Mark, ...] = ()
    wide: bool = False


@dataclass(frozen=True)
class Row:
    """A table row; `marks` tag every computed number in it."""

    cells: tuple[Cell, ...]
    marks: tuple[Mark, ...] = ()
    key: str = ""
    group: str = ""


@dataclass(frozen=True)
class Table:
    """A sortable table."""

    key: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    caption: str = ""
    with_marks: bool = False
    folded: bool = False
    empty: str = "No rows."


@dataclass(frozen=True)
class Figure:
    """A drawn figure: an SVG file, with the words that stand for it."""

    key: str
    title: str
    caption: str
    svg: Path
    marks: tuple[Mark, ...] = ()
    wide: bool = False


@dataclass(frozen=True)
class Figures:
    """Figures that belong side by side; `pdf_only` ones stand in for a widget of the page."""

    items: tuple[Figure, ...]
    pdf_only: bool = False


@dataclass(frozen=True)
class Paragraph:
    """A paragraph of plain text."""

    text: str
    tone: Tone = ""
    marks: tuple[Mark, ...] = ()
    pdf_only: bool = False


@dataclass(frozen=True)
class Verdict:
    """One line of the summary: a question, the answer in words, and its tone."""

    question: str
    answer: str
    tone: Tone
    label: str
    marks: tuple[Mark, ...] = ()
    link: str = ""


@dataclass(frozen=True)
class Verdicts:
    """The summary's lines."""

    items: tuple[Verdict, ...]


@dataclass(frozen=True)
class Widget:
    """A part that only the page has; `data` goes to its template."""

    kind: Literal["browser", "heatmap", "scatter"]
    data: Mapping[str, Any] = field(default_factory=dict)


Item = Table | Figures | Paragraph | Verdicts | Widget


@dataclass(frozen=True)
class Section:
    """A numbered section; `page_only` ones are left out of the PDF."""

    key: str
    title: str
    items: tuple[Item, ...]
    page_only: bool = False


@dataclass(frozen=True)
class Report:
    """A whole report."""

    title: str
    subtitle: str
    lead: tuple[str, ...]
    notes: tuple[str, ...]
    sections: tuple[Section, ...]
    stamp: tuple[tuple[str, str], ...]
    page_data: Mapping[str, Any] = field(default_factory=dict)
