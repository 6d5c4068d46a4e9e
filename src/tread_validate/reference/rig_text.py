"""A rig record in text: a heading over columns, read in one go however long."""

from __future__ import annotations

import codecs
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, one_line
from ..instrument.cells import COMMA, EMPTY, POINT
from ..text_table import leading_comments
from .rig_units import channel_factor, is_channel, stem

Array = NDArray[np.float64]

HEAD = 65536  # bytes in which comments and heading stand
LARGEST = 8_000_000_000  # bytes
SEPARATORS = ";\t,"
FEWEST_COLUMNS = 3  # two forces and a trigger or an angle


@dataclass(frozen=True)
class _Layout:
    encoding: str
    separator: str
    decimal: str
    heading: list[str]
    units: list[str]
    first: int  # line of the first row of numbers, from 1
    comments: dict[str, str]


def read_text_channels(
    path: Path | str, names: Mapping[str, str], needed: tuple[str, ...]
) -> tuple[dict[str, Array], int, dict[str, str], tuple[str, ...]]:
    """Return channels in SI by name, the line of their first row, the file's comments, and what was understood.

    An empty cell is NaN. Raises `InputError` with line and column for text among numbers, and for short or long rows.
    """
    source = Path(path)
    layout = _layout(source)
    places, factors, told = {}, {}, []
    for name, wanted in names.items():
        found = [k for k, heading in enumerate(layout.heading) if is_channel(heading, name, wanted)]
        place = f"{path}:{layout.first - 1}"
        if len(found) > 1:
            raise InputError(place, f"column {wanted} twice", f"one (--channel {name}=HEADING)")
        if not found:
            if name in needed:
                have = one_line("columns " + ", ".join(layout.heading), 160)
                raise InputError(place, have, f"column {wanted} (or --channel {name}=HEADING)")
            continue
        heading = layout.heading[found[0]]
        unit = stem(heading, name)[1] or (layout.units[found[0]] if layout.units else "")
        places[name], factors[name] = found[0], channel_factor(name, unit, f"{place}: {heading}")
        told.append(f"{name} = column {found[0] + 1} '{heading}'" + (f" in {unit}" if unit else ""))
    columns = _numbers(source, layout, places)
    values = {}
    for name, column in places.items():
        values[name] = columns[column]
        if factors[name] != 1.0:
            values[name] *= factors[name]
    return values, layout.first, layout.comments, tuple(told)


def _layout(path: Path) -> _Layout:
    try:
        size = path.stat().st_size
        with path.open("rb") as stream:
            data = stream.read(HEAD)
    except FileNotFoundError:
        raise InputError(path, "no such file", "an existing file") from None
    except OSError as error:
        raise InputError(path, error.strerror or error, "a readable file") from None
    if not data.strip():
        raise InputError(path, "an empty file", "a record")
    if size > LARGEST:
        raise InputError(path, f"{size} bytes", f"at most {LARGEST}")
    encoding = _encoding(path, data)
    text = codecs.getincrementaldecoder(encoding)(errors="replace").decode(data)
    if "\x00" in text:
        raise InputError(path, "binary data (a NUL byte)", "text, or a file named .tdms")
    lines = text.splitlines()
    comments, start = leading_comments(lines)
    start = _heading(lines, start)
    if start + 1 >= len(lines):
        raise InputError(path, "no rows", "a heading with column names over rows of numbers")
    separator = max(SEPARATORS, key=lines[start].count)
    heading = [cell.strip().strip('"') for cell in lines[start].split(separator)]
    cells = [cell.strip().strip('"') for cell in lines[start + 1].split(separator)]
    units: list[str] = []
    if len(cells) == len(heading) and not any(POINT.fullmatch(cell) or COMMA.fullmatch(cell) for cell in cells):
        units = [cell.strip("()[] ") for cell in cells]
        start += 1
        cells = [cell.strip() for cell in lines[start + 1].split(separator)] if start + 1 < len(lines) else []
    comma = separator != "," and any("," in cell for cell in cells)
    return _Layout(encoding, separator, "," if comma else ".", heading, units, start + 2, comments)


def _heading(lines: list[str], start: int) -> int:
    """Return the first line from `start` that has enough columns: what stands above is the instrument's."""
    wide = (k for k in range(start, len(lines)) if max(map(lines[k].count, SEPARATORS)) >= FEWEST_COLUMNS - 1)
    return next(wide, start)


def _encoding(path: Path, data: bytes) -> str:
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    try:
        codecs.getincrementaldecoder("utf-8")().decode(data)
        return "utf-8-sig" if data.startswith(codecs.BOM_UTF8) else "utf-8"
    except UnicodeDecodeError as error:
        if any(byte < 32 and byte not in b"\t\n\r\x0c\x1b" for byte in data):
            raise InputError(path, f"binary data at byte {error.start}", "text, or a file named .tdms") from None
        return "cp1252"


def _numbers(path: Path, layout: _Layout, places: Mapping[str, int]) -> dict[int, Array]:
    import pandas as pd  # late: most runs read no record

    wanted = sorted(set(places.values()))
    try:
        frame = pd.read_csv(
            path, sep=layout.separator, decimal=layout.decimal, header=None, usecols=wanted, dtype=np.float64,
            skiprows=layout.first - 1, skip_blank_lines=False, encoding=layout.encoding, encoding_errors="replace",
            engine="c", memory_map=layout.encoding != "utf-16",
        )  # fmt: skip
    except (ValueError, pd.errors.ParserError, UnicodeError):
        _explain(path, layout, wanted, None)
        raise InputError(path, "rows that cannot be read", "one number a cell") from None
    columns = {place: frame[place].to_numpy() for place in wanted}
    del frame
    rows = next(iter(columns.values())).size
    empty = np.zeros(rows, dtype=np.bool_)
    for column in columns.values():
        empty |= ~np.isfinite(column)
    if empty.any():
        _explain(path, layout, wanted, set((np.flatnonzero(empty) + layout.first).tolist()))
    last = rows
    while last and all(np.isnan(column[last - 1]) for column in columns.values()):
        last -= 1
    return {place: np.array(column[:last]) for place, column in columns.items()}


def _explain(path: Path, layout: _Layout, wanted: list[int], rows: set[int] | None) -> None:
    """Raise `InputError` for the first bad cell or row; looks at the lines `rows` alone unless it is None."""
    for number, line in _lines(path, layout.encoding):
        if number < layout.first or (rows is not None and number not in rows) or not line.strip():
            continue
        cells = line.rstrip("\r\n").split(layout.separator)
        if len(cells) != len(layout.heading):
            hint = " (decimal commas in a comma-separated file?)" if len(cells) > len(layout.heading) else ""
            raise InputError(
                f"{path}:{number}", f"{len(cells)} cells", f"{len(layout.heading)}, as in the header{hint}"
            )
        pattern = COMMA if layout.decimal == "," else POINT
        for place in wanted:
            text = cells[place].strip().strip('"')
            if text.lower() in EMPTY:
                continue
            where = f"{path}:{number}: {layout.heading[place]}"
            if not pattern.fullmatch(text) or "d" in text.lower():  # Fortran's 1D3 is for small tables
                raise InputError(where, one_line(repr(text), 60), f"a number (decimal mark '{layout.decimal}')")
            if not np.isfinite(float(text.replace(",", "."))):
                raise InputError(where, one_line(text, 60), "a finite number")


def _lines(path: Path, encoding: str) -> Iterator[tuple[int, str]]:
    with path.open(encoding=encoding, errors="replace", newline="") as stream:
        yield from enumerate(stream, start=1)
