"""Reading columns of numbers from laboratory exports, and saying exactly which row is wrong."""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .bounds import first_beyond
from .errors import InputError, one_line
from .files import read_text

LONG = 2000  # rows from which a table is first read in one go
LARGEST = 200_000_000  # characters
NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eE][+-]?\d+)?")
COMMA_NUMBER = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
EMPTY = ("", "nan", "NaN", "NA")
BYTE_ORDER_MARKS = ((b"\xff\xfe", "UTF-16"), (b"\xfe\xff", "UTF-16"))


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
    lines = _lines(path)
    comments: dict[str, str] = {}
    start = 0
    while start < len(lines) and (not lines[start].strip() or lines[start].lstrip().startswith("#")):
        key, colon, value = lines[start].lstrip("# ").partition(":")
        if colon:
            comments[key.strip()] = value.strip()
        start += 1
    if start == len(lines):
        raise InputError(path, "no header", "a header line with column names")
    separator = max(";\t,", key=lines[start].count)
    header = [name.strip().strip('"') for name in lines[start].split(separator)]
    _check_header(path, start, header, needed)
    wanted = [name for name in header if not needed or name in needed or name in set(optional)]
    rows = [(n + 1, line.split(separator)) for n, line in enumerate(lines) if n > start and line.strip()]
    if not rows:
        raise InputError(path, "a header without rows", "at least one row of numbers")
    for number, cells in rows:
        if len(cells) != len(header):
            hint = " (decimal commas in a comma-separated file?)" if separator == "," else ""
            raise InputError(f"{path}:{number}", f"{len(cells)} cells", f"{len(header)}, as in the header{hint}")
    line = np.array([number for number, _ in rows], dtype=np.int64)
    values = _quickly(lines, line, separator, header, wanted)
    if values is not None:
        _check_bounds(path, values, line)
        return ColumnTable(values, line, str(path), comments)
    values = {}
    decimal: list[str] = []
    for name in wanted:
        column = header.index(name)
        values[name] = np.array([_number(path, number, name, cells[column], gaps, decimal) for number, cells in rows])
    _check_bounds(path, values, line)
    return ColumnTable(values, line, str(path), comments)


def _check_bounds(path: Path | str, values: Mapping[str, NDArray[np.float64]], line: NDArray[np.int64]) -> None:
    for name, column in values.items():
        beyond = first_beyond(column, name)
        if beyond is not None:
            row, expected = beyond
            raise InputError(f"{path}:{line[row]}: {name}", f"{column[row]:g}", expected)


def _quickly(
    lines: list[str], line: NDArray[np.int64], separator: str, header: list[str], wanted: list[str]
) -> dict[str, NDArray[np.float64]] | None:
    """Return the columns of a long table that is beyond reproach; None leaves the rest to the careful way."""
    if line.size < LONG:
        return None
    import pandas as pd

    body = "\n".join(lines[number - 1] for number in line)
    places = [header.index(name) for name in wanted]
    try:
        frame = pd.read_csv(io.StringIO(body), sep=separator, header=None, usecols=places, dtype=np.float64)
    except (ValueError, pd.errors.ParserError):
        return None
    table = frame.to_numpy()
    if table.shape != (line.size, len(wanted)) or not np.all(np.isfinite(table)):
        return None
    return {name: frame[place].to_numpy() for name, place in zip(wanted, places, strict=True)}


def _lines(path: Path | str) -> list[str]:
    source = Path(path)
    if source.is_file():
        with source.open("rb") as stream:
            first = stream.read(2)
        for mark, name in BYTE_ORDER_MARKS:
            if first == mark:
                raise InputError(f"{path}:1", f"a {name} byte-order mark", "UTF-8 text (save the export as UTF-8)")
        if source.stat().st_size > LARGEST:
            raise InputError(path, f"{source.stat().st_size} bytes", f"at most {LARGEST}")
    lines = read_text(path).splitlines()
    for number, line in enumerate(lines, start=1):
        if "\ufeff" in line:
            raise InputError(f"{path}:{number}", "a byte-order mark inside the file", "one file, not several joined")
    return lines


def _check_header(path: Path | str, start: int, header: list[str], needed: Sequence[str]) -> None:
    missing = [name for name in needed if name not in header]
    if missing:
        found = one_line("columns " + ", ".join(header), 160)
        raise InputError(f"{path}:{start + 1}", found, f"column {missing[0]} (all of {', '.join(needed)})")
    twice = {name for name in header if header.count(name) > 1}
    if twice:
        raise InputError(f"{path}:{start + 1}", f"column {sorted(twice)[0]} twice", "each column once")


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
