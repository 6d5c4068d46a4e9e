"""The report as a PDF, set by typst.

Every text goes to typst as a string in a JSON file, never as markup, so nothing in a study can be read as code.
"""

from __future__ import annotations

import itertools
import json
import re
import shutil
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from importlib import resources
from pathlib import Path
from typing import Any

import typst

from .. import provenance
from ..errors import EngineError
from ..files import write_bytes
from .content import Cell, Column, Figures, FirstScreen, Item, Paragraph, Report, Table
from .marks import in_words

WIDEST_TABLE = 12  # columns
DENSE = 6  # columns: with more, numbers stand without their notes
LONGEST_WORD = 12  # signs: a longer text may be broken
TALLEST = 0.85  # height over width: a taller figure is set narrower, so that it fits beside others
TALLEST_WIDE = 1.25  # of one that has the page's width: many small panels stay readable
LEFT_OUT = ("claims",)  # sections whose tables are attached, for they have hundreds of rows


def write_pdf(report: Report, path: Path, tables: Path | None = None) -> None:
    """Write the report as a PDF with the CSV tables of a folder attached; raises `EngineError` where typst refuses.

    It is written atomically. Fonts are the ones inside the typst wheel and its date is that of the code's commit, so
    that one input gives one file.
    """
    with tempfile.TemporaryDirectory(prefix="tread-report-") as name:
        folder = Path(name)
        template = resources.files("tread_validate.report").joinpath("templates", "report.typ")
        (folder / "report.typ").write_text(template.read_text(encoding="utf-8"), encoding="utf-8")
        data = {
            "title": report.title,
            "subtitle": report.subtitle,
            "stamp": [list(pair) for pair in report.stamp],
            "author": f"tread_validate {provenance.version()}, code {provenance.commit()}",
            "date": provenance.commit_date(),
            "sections": _sections(report, folder),
            "attached": _attached(tables, folder),
        }
        (folder / "data.json").write_text(json.dumps(data, ensure_ascii=False), encoding="utf-8")
        try:
            made = typst.compile(
                str(folder / "report.typ"),
                root=str(folder),
                ignore_system_fonts=True,
                timestamp=0,
                package_path=str(folder),
                package_cache_path=str(folder),
            )
        except RuntimeError as error:
            raise EngineError(f"typst: {error}") from error
    write_bytes(path, made)


def _sections(report: Report, folder: Path) -> list[dict[str, Any]]:
    """Return the sections; tables that the page folds away are attached as CSV in their place."""
    found: list[dict[str, Any]] = []
    for section in report.sections:
        if section.page_only or section.key in LEFT_OUT:
            continue
        items: list[dict[str, Any]] = []
        for item in section.items:
            if not (isinstance(item, Table) and item.folded):
                items.extend(_items(item, folder))
        if items:
            found.append({"title": section.title, "items": items})
    return found


def _attached(tables: Path | None, folder: Path) -> list[str]:
    """Copy the CSV tables to where typst finds them and return their names."""
    names = [] if tables is None else sorted(path.name for path in tables.glob("*.csv"))
    for name in names:
        shutil.copyfile(Path(tables or folder) / name, folder / name)
    return names


def _items(item: Item, folder: Path) -> list[dict[str, Any]]:
    if isinstance(item, Paragraph):
        return [{"kind": "paragraph", "text": item.text + item.link, "tone": item.tone, "marks": in_words(item.marks)}]
    if isinstance(item, FirstScreen):
        return _first(item, folder)
    if isinstance(item, Figures):
        return [_figures(item, folder)]
    if isinstance(item, Table) and len(item.columns) > WIDEST_TABLE:
        words = f"{item.title}: {len(item.columns)} columns do not fit a page; see the HTML page or the CSV tables."
        return [{"kind": "paragraph", "text": words, "tone": "mute", "marks": ""}]
    if isinstance(item, Table):
        return [_table(item)]
    return []


def _first(screen: FirstScreen, folder: Path) -> list[dict[str, Any]]:
    """Return alarm, sentence, models, picture and facts in this order."""
    told = [{"kind": "paragraph", "text": screen.alarm, "tone": "bad", "marks": ""}] if screen.alarm else []
    told.append({"kind": "paragraph", "text": screen.sentence, "tone": "", "marks": ""})
    facts = [
        {"label": fact.label, "text": fact.text, "tone": fact.tone, "marks": in_words(fact.marks)}
        for fact in screen.facts
    ]
    pictures = [_figures(Figures((screen.picture,)), folder)] if screen.picture else []
    return [*told, _table(screen.models), *pictures, {"kind": "facts", "items": facts}]


def _figures(figures: Figures, folder: Path) -> dict[str, Any]:
    found = []
    for figure in figures.items:
        shutil.copyfile(figure.svg, folder / f"{figure.key}.svg")
        found.append(
            {
                "file": f"{figure.key}.svg",
                "title": figure.title,
                "caption": figure.caption,
                "marks": in_words(figure.marks),
                "wide": figure.wide,
                "width": round(100.0 * min(1.0, (TALLEST_WIDE if figure.wide else TALLEST) / _tallness(figure.svg)), 1),
            }
        )
    return {"kind": "figures", "items": found}


def _tallness(file: Path) -> float:
    """Return the height of an SVG over its width."""
    found = re.search(r'width="([0-9.]+)pt" height="([0-9.]+)pt"', file.read_text(encoding="utf-8"))
    return float(found[2]) / float(found[1]) if found else TALLEST


def _table(table: Table) -> dict[str, Any]:
    columns = [_column(column) for column in table.columns]
    if table.with_marks:
        legend = "S synthetic, A assumed"
        columns.append({"title": "Depends on", "unit": legend, "numeric": False, "marks": "", "wide": False})
    rows: list[dict[str, Any]] = []
    dense = len(table.columns) > DENSE
    for group, members in itertools.groupby(table.rows[: table.printed], key=lambda row: row.group):
        if group:
            rows.append({"group": group, "cells": []})
        for row in members:
            shown = zip(row.cells, table.columns, strict=True)
            # a number's case is a link of the page; here it would be stacked in a narrow cell
            cells = [_cell(replace(cell, note="") if column.numeric and dense else cell) for cell, column in shown]
            if table.with_marks:
                cells.append({"text": " ".join(mark.code for mark in row.marks), "note": "", "tone": "mute"})
            rows.append({"group": "", "cells": cells})
    caption = table.caption
    if len(table.rows) > table.printed:
        told = re.match(r"First \d+ of (\d+) rows\.", caption)  # of a page that has not all either
        caption = caption.removeprefix(told[0] if told else "")
        rest = table.csv or "the page"
        caption += f" The first {table.printed} of {told[1] if told else len(table.rows)} rows; the rest is in {rest}."
    return {
        "kind": "table",
        "title": table.title,
        "caption": caption.strip(),
        "columns": columns,
        "rows": rows,
        "weights": _weights(table.columns, table.with_marks),
        "empty": table.empty,
    }


def _column(column: Column) -> dict[str, Any]:
    return {
        "title": column.title,
        "unit": column.unit,
        "numeric": column.numeric,
        "marks": in_words(column.marks),
        "wide": column.wide,
    }


def _cell(cell: Cell) -> dict[str, str]:
    return {"text": _breakable(cell.text), "note": _breakable(cell.note), "tone": cell.tone}


def _breakable(text: str) -> str:
    """Let long names such as case ids break after a hyphen or an underscore."""
    return "".join(sign + ("\u200b" if sign in "-_" else "") for sign in text) if len(text) > LONGEST_WORD else text


def _weights(columns: Sequence[Column], with_marks: bool) -> list[float]:
    """Share the page's width: texts that may wrap get more than twice what a number gets."""
    found = [(4.2 if column.long else 2.8) if column.wide else (1.2 if column.numeric else 1.3) for column in columns]
    return [*found, 1.2] if with_marks else found
