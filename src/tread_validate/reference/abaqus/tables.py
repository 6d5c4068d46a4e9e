"""Force tables as they leave ABAQUS: the extraction script's CSV, a Viewer XY report, two bare columns.

An XY report (``session.writeXYReport``, or Report > XY in the Viewer) is a blank line, a line of column names right
aligned under at least two blanks, a blank line, then rows of numbers in engineering notation; appending to a file
repeats the whole. Long names run over several lines of the heading, each part above or below the other. A curve that
has no value at a time says ``NoValue``. The end of one step and the start of the next stand in two rows of one time.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError, one_line
from ...files import read_text

Layout = Literal["csv", "xy report", "two columns"]
LARGEST_FILE = 50_000_000
MOST_HEADING_LINES = 4
X_NAME = re.compile(r"\s*X\s{2,}\S")
NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")


@dataclass(frozen=True)
class AbaqusTable:
    """Columns of numbers over time.

    Attributes
    ----------
    source : str
        File name, for messages.
    layout : str
    columns : tuple of str
        Names as written; the first column is the time. Empty strings where the file has none.
    values : (n, m) array
        As written: no unit or sign is changed.
    notes : mapping
        What ``# key: value`` lines say.
    """

    source: str
    layout: Layout
    columns: tuple[str, ...]
    values: NDArray[np.float64]
    notes: Mapping[str, str] = field(default_factory=dict)

    def column(self, variable: str) -> NDArray[np.float64] | None:
        """Return the column whose leading name is `variable` (``CFN2``), or None.

        Raises
        ------
        InputError
            More than one such column: two contact pairs, or an appended report.
        """
        found = [index for index, name in enumerate(self.columns) if index and leading_name(name) == variable.upper()]
        if len(found) > 1:
            raise InputError(f"{self.source}: {variable}", f"{len(found)} columns", "one column (one contact pair)")
        if not found:
            return None
        values = self.values[:, found[0]]
        if np.isnan(values).any():
            row = int(np.argmax(np.isnan(values))) + 1
            expected = "a number (write the report with interpolation on)"
            raise InputError(f"{self.source}: {variable}, row {row} of numbers", "NoValue", expected)
        return values


def leading_name(column: str) -> str:
    """Return the variable of a column: ``CFN2: CFN2     ASSEMBLY_A/ASSEMBLY_B in NSET C`` gives ``CFN2``."""
    words = re.split(r"[\s:@]+", column.strip().lstrip("_"))
    name = words[0].upper() if words else ""
    return name.removesuffix("_N")


def read_table(path: Path | str) -> AbaqusTable:
    """Read a force table; the layout is found from the text.

    Raises
    ------
    InputError
        A missing, binary, empty or oversized file, a row of another length, a word that is no number, times out of
        order, or a report with more than one table.
    """
    source = Path(path)
    try:
        if source.stat().st_size > LARGEST_FILE:
            raise InputError(source, f"{source.stat().st_size} bytes", f"at most {LARGEST_FILE}")
    except OSError:
        pass  # read_text says it better
    lines = read_text(source).splitlines()
    body = [(number, line) for number, line in enumerate(lines, start=1) if line.strip()]
    notes: dict[str, str] = {}
    while body and body[0][1].lstrip().startswith("#"):
        key, _, value = body.pop(0)[1].lstrip()[1:].partition(":")
        notes[key.strip()] = value.strip()
    if not body:
        raise InputError(source, "no table", "a header or rows of numbers")
    number, first = body[0]
    if _heading_lines(body):
        table = _xy_report(source, body)
    elif "," in first and _number(first.split(",")[0]) is None:
        columns = tuple(name.strip() for name in first.split(","))
        table = AbaqusTable(str(source), "csv", columns, _rows(source, body[1:], len(columns), ","), notes)
    elif _number(_words(first)[0]) is not None:
        width = len(_words(first))
        if width != 2:
            raise InputError(f"{source}:{number}", f"{width} numbers without names", "two: time and one force")
        table = AbaqusTable(str(source), "two columns", ("", ""), _rows(source, body, 2, None), notes)
    else:
        raise InputError(
            f"{source}:{number}", one_line(first, 60), "a CSV header, an XY report (X ...) or two columns of numbers"
        )
    table = _without_repeats(table)
    if not np.all(np.diff(table.values[:, 0]) > 0):
        row = int(np.argmax(np.diff(table.values[:, 0]) <= 0)) + 2
        raise InputError(f"{source}: time, row {row}", table.values[row - 1, 0], "a time after the one before")
    return table


def _heading_lines(body: list[tuple[int, str]]) -> int:
    """Return how many lines the heading of an XY report takes; 0 where the text is none."""
    for count in range(1, MOST_HEADING_LINES + 1):
        if count < len(body) and _number(_words(body[count][1])[0]) is not None:
            return count if any(X_NAME.match(line) for _, line in body[:count]) else 0
    return 1 if X_NAME.match(body[0][1]) else 0


def _xy_report(source: Path, body: list[tuple[int, str]]) -> AbaqusTable:
    count = _heading_lines(body)
    columns = _names(source, body[:count], len(_words(body[count][1])) if count < len(body) else 0)
    again = [number for number, line in body[count:] if X_NAME.match(line)]
    if again:
        raise InputError(f"{source}:{again[0]}", "a second table", "one table (the report was appended to)")
    return AbaqusTable(str(source), "xy report", columns, _rows(source, body[count:], len(columns), None, gaps=True))


def _names(source: Path, heading: list[tuple[int, str]], width: int) -> tuple[str, ...]:
    """Return the columns' names; parts on several lines belong to the column under whose place they stand."""
    if len(heading) == 1:
        return tuple(re.split(r"\s{2,}", _joined_names(heading[0][1])))
    parts = [(match.group(), 0.5 * (match.start() + match.end())) for _, line in heading
             for match in re.finditer(r"\S+(?: \S+)*", line.expandtabs())]  # fmt: skip
    base = next(line for _, line in heading if X_NAME.match(line)).expandtabs()
    fields = list(re.finditer(r"\S+(?: \S+)*", base))
    places = [0.5 * (match.start() + match.end()) for match in fields]
    if len(places) != width:
        found = f"{len(places)} names over {width} columns of numbers"
        raise InputError(f"{source}:{heading[0][0]}", found, "a name for each column")
    names = ["" for _ in places]
    for text, place in parts:
        column = min(range(width), key=lambda k: abs(places[k] - place))
        names[column] = f"{names[column]} {text}".strip()
    return tuple(names)


def _without_repeats(table: AbaqusTable) -> AbaqusTable:
    """Take out the second of two rows of one time: a step's end and the next one's start."""
    time = table.values[:, 0]
    repeated = np.concatenate([[False], np.diff(time) == 0])
    if not repeated.any():
        return table
    if table.layout != "xy report" or np.any(repeated[1:] & repeated[:-1]):
        return table
    return replace(table, values=table.values[~repeated])


def _joined_names(line: str) -> str:
    """Close the padding inside history names, ``CFN2     ASSEMBLY_...``, so that it does not split a column."""
    return re.sub(r"\b([A-Z]{2,6}\d?)\s{2,}(?=ASSEMBLY)", r"\1 ", line.strip())


def _rows(
    source: Path, body: list[tuple[int, str]], width: int, separator: str | None, gaps: bool = False
) -> NDArray[np.float64]:
    """Return the numbers; with `gaps`, NoValue is NaN (a column that is used may have none)."""
    rows: list[list[float]] = []
    for number, line in body:
        words = [word.strip() for word in line.split(separator)] if separator else _words(line)
        if len(words) != width:
            raise InputError(f"{source}:{number}", f"{len(words)} fields", f"{width}, as in the line of names")
        values: list[float] = []
        for word in words:
            value = math.nan if gaps and values and word.lower() == "novalue" else _number(word)
            if value is None:
                raise InputError(f"{source}:{number}", one_line(word, 40) or "nothing", "a number")
            values.append(value)
        rows.append(values)
    if len(rows) < 2:
        raise InputError(source, f"{len(rows)} row(s) of numbers", "at least 2")
    return np.array(rows, dtype=np.float64)


def _words(line: str) -> list[str]:
    return [word for word in re.split(r"[\s;,]+", line.strip()) if word] or [""]


def _number(word: str) -> float | None:
    if not NUMBER.fullmatch(word.strip()):
        return None
    value = float(word.upper().replace("D", "E"))
    return value if math.isfinite(value) else None
