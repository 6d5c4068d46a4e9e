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
    """An assumed or synthetic input that a number depends on: its code in the list of assumptions, and its kind."""

    code: str
    origin: str
    text: str


@dataclass(frozen=True)
class Cell:
    """One table cell: what is shown, what it sorts by, its tone (never the only carrier of a meaning).

    `case` is the case that it leads to; cells of another `kind` (a unit) are sorted apart.
    """

    text: str
    sort: float | str | None = None
    tone: Tone = ""
    note: str = ""
    case: str = ""
    kind: str = ""


@dataclass(frozen=True)
class Column:
    """A table column; `unit` is printed under the title, `marks` tag every number below.

    A `wide` one holds words, one that is `long` too sentences.
    """

    title: str
    unit: str = ""
    numeric: bool = False
    marks: tuple[Mark, ...] = ()
    wide: bool = False
    long: bool = False


@dataclass(frozen=True)
class Row:
    """A table row; `marks` tag every computed number in it."""

    cells: tuple[Cell, ...]
    marks: tuple[Mark, ...] = ()
    key: str = ""
    group: str = ""


@dataclass(frozen=True)
class Table:
    """A sortable table; `help` is a line on how to read it, `csv` the name of the table of the results behind it.

    `printed` is the number of rows in the PDF; the page has all of them.
    """

    key: str
    title: str
    columns: tuple[Column, ...]
    rows: tuple[Row, ...]
    caption: str = ""
    with_marks: bool = False
    folded: bool = False
    empty: str = "No rows."
    help: str = ""
    csv: str = ""
    printed: int = 24


@dataclass(frozen=True)
class Figure:
    """A drawn figure: an SVG file, its numbers as CSV and the words for it; `case` is the one that it shows."""

    key: str
    title: str
    caption: str
    svg: Path
    marks: tuple[Mark, ...] = ()
    wide: bool = False
    data: Path | None = None
    case: str = ""


@dataclass(frozen=True)
class Figures:
    """Figures that belong side by side; `pdf_only` ones take the place of a widget of the page."""

    items: tuple[Figure, ...]
    pdf_only: bool = False


@dataclass(frozen=True)
class Paragraph:
    """A paragraph of plain text; `link` is the file beside the report that it ends with."""

    text: str
    tone: Tone = ""
    marks: tuple[Mark, ...] = ()
    pdf_only: bool = False
    link: str = ""


@dataclass(frozen=True)
class Fact:
    """One line of the first screen beside the models: what it is about, what is found, and where the rest stands."""

    label: str
    text: str
    tone: Tone = ""
    link: str = ""
    marks: tuple[Mark, ...] = ()


@dataclass(frozen=True)
class FirstScreen:
    """What a reader sees first: what was compared, a row for every model, the facts, and one picture.

    `alarm` is the sentence that stands before all others where nothing could be compared.
    """

    sentence: str
    models: Table
    facts: tuple[Fact, ...]
    alarm: str = ""
    picture: Figure | None = None


@dataclass(frozen=True)
class Widget:
    """A part that only the page has; `data` goes to its template."""

    kind: Literal["browser", "heatmap", "scatter"]
    data: Mapping[str, Any] = field(default_factory=dict)


Item = Table | Figures | Paragraph | FirstScreen | Widget


@dataclass(frozen=True)
class Section:
    """A numbered section; `page_only` ones are left out of the PDF, `pdf_only` ones of the page."""

    key: str
    title: str
    items: tuple[Item, ...]
    page_only: bool = False
    pdf_only: bool = False


@dataclass(frozen=True)
class Report:
    """A whole report."""

    title: str
    subtitle: str
    sections: tuple[Section, ...]
    stamp: tuple[tuple[str, str], ...]
    page_data: Mapping[str, Any] = field(default_factory=dict)
