"""Tables as text: the same bytes for the same numbers, on one core or two."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ...files import write_text

DIGITS = 7


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
