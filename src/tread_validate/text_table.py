"""Tables of cells in a text file: comments, header, separator, and on which line each row stands."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from .errors import InputError, one_line
from .files import read_text

LARGEST = 200_000_000  # characters
BYTE_ORDER_MARKS = ((b"\xff\xfe", "UTF-16"), (b"\xfe\xff", "UTF-16"))


@dataclass(frozen=True)
class TextTable:
    """The cells of one table, as text.

    Attributes
    ----------
    source : str
    header : tuple of str
        Names of the columns, each once.
    rows : tuple of (int, list of str)
        Line of the file, from 1, and the cells, as many as the header has.
    comments : mapping of str to str
        ``# key: value`` lines before the header.
    line : int
        Line of the header.
    separator : str
    """

    source: str
    header: tuple[str, ...]
    rows: tuple[tuple[int, list[str]], ...]
    comments: Mapping[str, str]
    line: int
    separator: str

    def records(self) -> Iterator[tuple[str, dict[str, str]]]:
        """Yield file and line, and the cells by column, of every row."""
        for line, cells in self.rows:
            yield f"{self.source}:{line}", dict(zip(self.header, cells, strict=True))

    def check(self, needed: Sequence[str], exactly: bool = False) -> None:
        """Raise `InputError` unless these columns are there; with `exactly`, these in this order and no other."""
        missing = [name for name in needed if name not in self.header]
        if missing:
            found = one_line("columns " + ", ".join(self.header), 160)
            where = f"{self.source}:{self.line}"
            raise InputError(where, found, f"column {missing[0]} (all of {', '.join(needed)})")
        if exactly and self.header != tuple(needed):
            strange = next((f"column {one_line(name, 60)}" for name in self.header if name not in needed), "order")
            raise InputError(f"{self.source}:{self.line}", strange, "columns " + ", ".join(needed))


def read_text_table(path: Path | str, separators: str = ",") -> TextTable:
    """Read a table with a header line, ``#`` lines before it; of the separators, the most frequent in the header.

    A UTF-8 byte-order mark at the start is taken off; a cell may stand in double quotes.

    Raises `InputError`, with file and line, for a file that is no text, one without a header, a column twice, a row of
    another length, and a byte-order mark inside the file.
    """
    source = Path(path)
    if source.is_file():
        with source.open("rb") as stream:
            first = stream.read(2)
        for mark, name in BYTE_ORDER_MARKS:
            if first == mark:
                raise InputError(f"{path}:1", f"a {name} byte-order mark", "UTF-8 text (save the export as UTF-8)")
        if source.stat().st_size > LARGEST:
            raise InputError(path, f"{source.stat().st_size} bytes", f"at most {LARGEST}")
    return text_table(read_text(path), path, separators)


def text_table(text: str, source: Path | str, separators: str = ",") -> TextTable:
    """Return the table in a text; see `read_text_table`."""
    lines = text.splitlines()
    if "\ufeff" in text:
        number = next(number for number, line in enumerate(lines, start=1) if "\ufeff" in line)
        raise InputError(f"{source}:{number}", "a byte-order mark inside the file", "one file, not several joined")
    comments, start = leading_comments(lines)
    if start == len(lines):
        raise InputError(source, "no header", "a header line with column names")
    separator = max(separators, key=lines[start].count)
    found = _cells(lines[start:], source, start, separator)
    header = tuple(name.strip() for name in next(found, (0, [""]))[1])
    twice = sorted({name for name in header if header.count(name) > 1})
    if twice:
        raise InputError(f"{source}:{start + 1}", f"column {twice[0]} twice", "each column once")
    rows = tuple(found)
    for line, cells in rows:
        if len(cells) != len(header):
            hint = (
                " (decimal commas in a comma-separated file?)" if separator == "," and len(cells) > len(header) else ""
            )
            raise InputError(f"{source}:{line}", f"{len(cells)} cells", f"{len(header)}, as in the header{hint}")
    return TextTable(str(source), header, rows, comments, start + 1, separator)


def leading_comments(lines: Sequence[str]) -> tuple[dict[str, str], int]:
    """Return the ``# key: value`` lines before a header, and the index of the first line below them."""
    comments: dict[str, str] = {}
    start = 0
    while start < len(lines) and (not lines[start].strip() or lines[start].lstrip().startswith("#")):
        key, colon, value = lines[start].lstrip("# ").partition(":")
        if colon:
            comments[key.strip()] = value.strip()
        start += 1
    return comments, start


def _cells(lines: Sequence[str], source: Path | str, start: int, separator: str) -> Iterator[tuple[int, list[str]]]:
    """Yield line and cells of every line that is not blank."""
    reader = csv.reader(lines, delimiter=separator)
    try:
        for cells in reader:
            if len(cells) > 1 or (cells and cells[0].strip()):
                yield start + reader.line_num, cells
    except csv.Error as error:
        raise InputError(f"{source}:{start + reader.line_num}", error, "cells of a table") from None
