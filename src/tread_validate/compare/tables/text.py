"""Tables as text: the same bytes for the same numbers, on one core or two; and text as rows again."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

from ...errors import InputError
from ...files import write_text
from ...text_table import read_text_table
from .row import TableRow

DIGITS = 7
AnyRow = TypeVar("AnyRow", bound=TableRow)


def cell(value: Any) -> str:
    """Return a value as a table cell: numbers with 7 significant digits, true/false, empty for None."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        if not math.isfinite(value):
            return ""
        text = f"{value:.{DIGITS}g}"
        return "0" if float(text) == 0.0 else text
    if isinstance(value, tuple | list):
        return " ".join(str(item) for item in value)
    return str(value)


def table_text(columns: Sequence[str], rows: Iterable[Mapping[str, Any]]) -> str:
    """Return a CSV table; a row without one of the columns is a `KeyError`, so that no column is lost silently."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(columns)
    for row in rows:
        writer.writerow([cell(row[name]) for name in columns])
    return out.getvalue()


def write_table(path: Path, columns: Sequence[str], rows: Iterable[Mapping[str, Any]]) -> None:
    """Write a CSV table, atomically."""
    write_text(path, table_text(columns, rows))


def rows_text(kind: type[AnyRow], rows: Iterable[AnyRow]) -> str:
    """Return a table of rows of one class as CSV."""
    return table_text(kind.header(), (row.cells() for row in rows))


def write_rows(folder: Path, kind: type[AnyRow], rows: Iterable[AnyRow]) -> None:
    """Write ``<table>.csv`` into a folder, atomically."""
    write_text(folder / f"{kind.table}.csv", rows_text(kind, rows))


def read_rows(path: Path | str, kind: type[AnyRow]) -> tuple[AnyRow, ...]:
    """Read a table back.

    Raises `InputError`, with file and line, for a missing or another column, a row of another length, a cell that is
    not of its column's kind, and two rows with one key.
    """
    table = read_text_table(path)
    missing = [name for name in kind.header() if name not in table.header]
    if missing:
        where = f"{path}:{table.line}"
        raise InputError(where, f"no column {missing[0]}", "columns " + ", ".join(kind.header()))
    table.check(kind.header(), exactly=True)
    rows: list[AnyRow] = []
    seen: set[tuple[str, ...]] = set()
    for where, cells in table.records():
        row = kind.read(cells, where)
        if row.identity() in seen:
            raise InputError(where, f"{' '.join(row.identity())} again", "each row once")
        seen.add(row.identity())
        rows.append(row)
    return tuple(rows)
