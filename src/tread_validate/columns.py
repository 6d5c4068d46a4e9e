"""Reading columns of numbers, and saying exactly which row is wrong."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .bounds import first_beyond
from .errors import InputError, one_line
from .text_table import read_text_table

NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?")
COMMA_NUMBER = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
EMPTY = ("", "nan", "NaN", "NA")


@dataclass(frozen=True)
class ColumnTable:
    """Named columns of one table.

    Attributes
    ----------
    values : mapping of column name to (n,) array
        NaN for an empty cell.
    line : (n,) array of int
        Line of the file that each row stands on, from 1.
    source : str
    comments : mapping of str to str
        ``# key: value`` lines before the header.
    """

    values: dict[str, NDArray[np.float64]]
    line: NDArray[np.int64]
    source: str
    comments: dict[str, str]

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return one column, (n,)."""
        return self.values[name]

    def where(self, row: int) -> str:
        """Return file and line of a row, for an error message."""
        return f"{self.source}:{self.line[row]}"

    def refuse(self, wrong: NDArray[np.bool_], name: str, expected: str) -> None:
        """Raise `InputError` at the first row of column `name` that is `wrong`."""
        if np.any(wrong):
            row = int(np.argmax(wrong))
            value = self.values[name][row]
            found = "an empty cell" if np.isnan(value) else f"{value:g}"
            raise InputError(f"{self.where(row)}: {name}", found, expected)


def read_columns(
    path: Path | str, needed: Sequence[str], optional: Iterable[str] = (), gaps: bool = False
) -> ColumnTable:
    """Read a table with a header line, separated by commas, semicolons or tabs, ``#`` lines before it.

    A UTF-8 byte-order mark at the start is taken off. Decimal commas are read where the separator is a semicolon or a
    tab and every number is written so. Columns that are not asked for are passed over, unless `needed` is empty: then
    all are read. Empty cells are refused unless `gaps`.

    Raises `InputError`, with file and line, for a missing column, a row of another length, a cell that is not a
    number, decimal points mixed with decimal commas, a byte-order mark inside the file, or UTF-16.
    """
    table = read_text_table(path, ";\t,")
    table.check(needed)
    wanted = [name for name in table.header if not needed or name in needed or name in set(optional)]
    if not table.rows:
        raise InputError(path, "a header without rows", "at least one row of numbers")
    line = np.array([number for number, _ in table.rows], dtype=np.int64)
    cells = {name: [row[table.header.index(name)] for _, row in table.rows] for name in wanted}
    values = _quickly(cells)
    if values is None:
        decimal: list[str] = []
        values = {
            name: np.array(
                [
                    _number(path, number, name, cell, gaps, decimal)
                    for number, cell in zip(line.tolist(), column, strict=True)
                ]
            )
            for name, column in cells.items()
        }
    _check_bounds(path, values, line)
    return ColumnTable(values, line, str(path), dict(table.comments))


def _check_bounds(path: Path | str, values: Mapping[str, NDArray[np.float64]], line: NDArray[np.int64]) -> None:
    for name, column in values.items():
        beyond = first_beyond(column, name)
        if beyond is not None:
            row, expected = beyond
            raise InputError(f"{path}:{line[row]}: {name}", f"{column[row]:g}", expected)


def _quickly(cells: Mapping[str, Sequence[str]]) -> dict[str, NDArray[np.float64]] | None:
    """Return the columns of a table that is beyond reproach; None leaves all of it to the careful way."""
    found = {}
    for name, column in cells.items():
        try:
            numbers = np.array([float(cell) for cell in column])
        except ValueError:
            return None
        if not np.all(np.isfinite(numbers)) or "_" in "".join(column):
            return None
        found[name] = numbers
    return found


def _number(path: Path | str, line: int, name: str, cell: str, gaps: bool, decimal: list[str]) -> float:
    """Return a cell's number; `decimal` remembers the first decimal mark of the file and where it stood."""
    text = cell.strip().strip('"')
    if text in EMPTY:
        if not gaps:
            raise InputError(f"{path}:{line}: {name}", "an empty cell", "a number")
        return float("nan")
    if COMMA_NUMBER.fullmatch(text):
        mark, text = ",", text.replace(",", ".")
    elif NUMBER.fullmatch(text):
        mark = "." if "." in text else ""
    else:
        raise InputError(f"{path}:{line}: {name}", one_line(repr(text), 60), "a number")
    if mark and not decimal:
        decimal.extend((mark, str(line)))
    if mark and mark != decimal[0]:
        raise InputError(
            f"{path}:{line}: {name}",
            f"{cell.strip()} with a decimal {'comma' if mark == ',' else 'point'}",
            f"one decimal mark throughout (line {decimal[1]} has a {'comma' if decimal[0] == ',' else 'point'})",
        )
    value = float(text)
    if not np.isfinite(value):
        raise InputError(f"{path}:{line}: {name}", one_line(text, 60), "a finite number")
    return value
