"""Finding the tables in an export: separator, decimal mark, heading, unit row, blocks of numbers."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, field
from pathlib import Path

from ..errors import InputError, one_line
from .quantities import UNIT_WORDS
from .text import read_lines
from .workbook import read_sheets

SEPARATORS = (";", "\t", ",", "")  # "" is a run of blanks
NAMES = {";": "semicolons", "\t": "tabs", ",": "commas", "": "blanks"}
POINT = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)([eEdD][+-]?\d+)?")
COMMA = re.compile(r"[+-]?(\d+(,\d*)?|,\d+)([eE][+-]?\d+)?")
EMPTY = ("", "nan", "na", "-", "--", "---", "novalue", "n/a")


@dataclass(frozen=True)
class CellBlock:
    """One table of an export.

    Attributes
    ----------
    where : str
        File, with the sheet of a workbook.
    names, units : lists of str, one a column
        From the heading; an empty unit where none is said there.
    cells : list of rows of str
    line : list of int
        Line (row of the sheet) of each row, from 1.
    above : list of str
        The lines between the table before and this one's heading.
    decimal : str
        The mark that the numbers of this block use, "." or ",".
    """

    where: str
    names: list[str]
    units: list[str]
    cells: list[list[str]]
    line: list[int]
    above: list[str] = field(default_factory=list)
    decimal: str = "."

    def number(self, row: int, column: int) -> float | None:
        """Return a cell's number; None where it is empty. Raises `InputError` where it is neither."""
        text = self.cells[row][column].strip()
        if text.lower() in EMPTY:
            return None
        mark = COMMA if self.decimal == "," else POINT
        place = f"{self.where}:{self.line[row]}: {self.names[column]}"
        if not mark.fullmatch(text):
            other = (POINT if self.decimal == "," else COMMA).fullmatch(text)
            if other:
                found = f"{text} with a decimal {'point' if self.decimal == ',' else 'comma'}"
                word = "comma" if self.decimal == "," else "point"
                raise InputError(place, found, f"one decimal mark throughout (the others have a {word})")
            raise InputError(place, one_line(repr(text), 60), "a number")
        value = float(text.replace(",", ".").replace("D", "e").replace("d", "e"))
        if not abs(value) < float("inf"):
            raise InputError(place, one_line(text, 60), "a finite number")
        return value


def read_blocks(path: Path | str) -> tuple[list[CellBlock], str]:
    """Return every table of a text file or workbook (.xlsx), in order, and how the file was read, in words.

    Raises `InputError` where no table is found, or a row has another number of cells than its heading.
    """
    if Path(path).suffix.lower() in (".xlsx", ".xlsm"):
        blocks: list[CellBlock] = []
        for name, rows in read_sheets(path):
            blocks += _blocks(f"{path}[{name}]", rows, ".", exact=False)
        told = "workbook"
    else:
        lines, encoding = read_lines(path)
        separator, decimal = _separator(lines)
        rows = [_split(line, separator) for line in lines]
        blocks = _blocks(str(path), rows, decimal, exact=True)
        told = f"{encoding}, {NAMES[separator]}, decimal {'comma' if decimal == ',' else 'point'}"
    if not blocks:
        raise InputError(path, "no table", "a heading with column names over rows of numbers")
    return blocks, told


def _split(line: str, separator: str) -> list[str]:
    if not line.strip():
        return []
    if not separator:
        return line.split()
    if '"' in line:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]
    return [cell.strip() for cell in line.split(separator)]


def _separator(lines: list[str]) -> tuple[str, str]:
    """Return the separator and decimal mark under which most lines are rows of at least two numbers."""
    best, found = -1, (",", ".")
    for separator in SEPARATORS:
        for mark, pattern in ((".", POINT), (",", COMMA)):
            if mark == "," and separator == ",":
                continue
            count = 0
            for line in lines:
                cells = _split(line, separator) if separator in line or not separator else []
                numbers = sum(bool(pattern.fullmatch(cell)) for cell in cells)
                count += numbers if numbers >= 2 else 0
            if count > best * (1.2 if not separator else 1.0):
                best, found = count, (separator, mark)
    return found


def _numeric(cell: str) -> bool:
    return bool(POINT.fullmatch(cell) or COMMA.fullmatch(cell))


def _blocks(where: str, rows: list[list[str]], decimal: str, exact: bool) -> list[CellBlock]:
    blocks: list[CellBlock] = []
    above: list[list[str]] = []
    k = 0
    while k < len(rows):
        row = rows[k]
        if sum(_numeric(cell) for cell in row) >= 2 and not _is_comment(row):
            first = k
            while k < len(rows) and _belongs(rows[k], rows[first]):
                k += 1
            blocks.append(_block(where, above, rows[first:k], first, decimal, blocks[-1] if blocks else None, exact))
            above = []
        else:
            above.append(row)
            k += 1
    return blocks


def _is_comment(row: list[str]) -> bool:
    return bool(row) and row[0].startswith(("#", "%", "!", "//"))


def _belongs(row: list[str], first: list[str]) -> bool:
    """Whether a row goes on with the block that `first` opened: any number in it, or only empty cells of its length."""
    if not row or _is_comment(row):
        return False
    return any(_numeric(cell) for cell in row)


def _block(
    where: str,
    above: list[list[str]],
    rows: list[list[str]],
    first: int,
    decimal: str,
    before: CellBlock | None,
    exact: bool,
) -> CellBlock:
    lines = list(range(first + 1, first + len(rows) + 1))
    heading, units = _heading(above, len(rows[0]))
    if not heading and before is not None and len(before.names) == len(rows[0]):
        heading, units = before.names, before.units
    if not heading:
        found = one_line(" | ".join(above[-1]) if above and above[-1] else "no heading", 120)
        raise InputError(f"{where}:{first + 1}", found, f"a heading of {len(rows[0])} column names above the numbers")
    for number, row in zip(lines, rows, strict=True):
        if len(row) != len(heading):
            if not exact or (len(row) > len(heading) and not any(row[len(heading) :])):
                row[:] = (row + [""] * len(heading))[: len(heading)]
                continue
            hint = " (decimal commas in a comma-separated file?)" if len(row) > len(heading) else ""
            raise InputError(f"{where}:{number}", f"{len(row)} cells", f"{len(heading)}, as in the heading{hint}")
    told = [" ".join(cell for cell in row if cell) for row in above if row]
    return CellBlock(where, heading, units, rows, lines, told, decimal)


def _heading(above: list[list[str]], width: int) -> tuple[list[str], list[str]]:
    """Return names and units of the last rows above a block, a row of units told from a row of names."""
    wide = [row for row in above if row and not (_is_comment(row) and len(row) != width)]
    if wide and _is_comment(wide[-1]):
        wide[-1] = [wide[-1][0].lstrip("#%!/ "), *wide[-1][1:]]
    fitting = [row for row in wide[-4:] if width - 1 <= len(_trimmed(row)) <= width or len(row) == width]
    if not fitting:
        return [], []
    last = (fitting[-1] + [""] * width)[:width]
    if _is_units(last) and len(fitting) > 1:
        return (fitting[-2] + [""] * width)[:width], [_bare(cell) for cell in last]
    return last, [""] * width


def _trimmed(row: list[str]) -> list[str]:
    end = len(row)
    while end and not row[end - 1]:
        end -= 1
    return row[:end]


def _bare(cell: str) -> str:
    return cell.strip().strip("()[]").strip()


def _is_units(row: list[str]) -> bool:
    """Whether a row says units: most of its filled cells are known ones."""
    filled = [_bare(cell) for cell in row if _bare(cell)]
    return bool(filled) and sum(cell.lower() in UNIT_WORDS for cell in filled) > 0.6 * len(filled)
