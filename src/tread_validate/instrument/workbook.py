"""Sheets of a workbook (.xlsx) as rows of text."""

from __future__ import annotations

import zipfile
from pathlib import Path

from ..errors import InputError, one_line


def read_sheets(path: Path | str) -> list[tuple[str, list[list[str]]]]:
    """Return name and rows of every sheet; numbers as text with a decimal point, formulas as their stored values."""
    from openpyxl import load_workbook  # type: ignore[import-untyped]  # the package has no types

    if not Path(path).is_file():
        raise InputError(path, "no such file", "an existing file")
    try:
        book = load_workbook(path, read_only=True, data_only=True)
        return [
            (sheet.title, [[_text(cell) for cell in row] for row in sheet.iter_rows(values_only=True)])
            for sheet in book.worksheets
        ]
    except (zipfile.BadZipFile, KeyError, ValueError, OSError, EOFError, SyntaxError, TypeError) as error:
        raise InputError(path, one_line(f"no workbook ({error})", 120), "a workbook (.xlsx)") from None


def _text(cell: object) -> str:
    if cell is None or isinstance(cell, bool):
        return ""
    return repr(float(cell)) if isinstance(cell, int | float) else str(cell).strip()
