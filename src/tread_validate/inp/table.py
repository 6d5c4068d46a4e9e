"""Data lines of numbers, read in bulk: a line at a time only where something is unusual."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .deck import LARGEST_LABEL, DataLine, Lines

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
CHUNK = 20_000  # lines at a time: bounds the memory that the pieces of text take


def number_table(lines: Lines, width: int, what: str) -> Floats:
    """Return data lines of numbers as rows; fields left out are 0.

    Parameters
    ----------
    lines : Lines
    width : int
        Columns of the table; more fields in a line are an error.
    what : str
        What a line should be, for messages.

    Returns
    -------
    (n, width) array of float

    Raises
    ------
    InputError
        With the line: not a finite number, too many fields, a first field that is no whole number.
    """
    table = np.zeros((len(lines), width))
    for first in range(0, len(lines), CHUNK):
        part = lines[first : first + CHUNK]
        rows = _uniform(part.texts, width)
        if rows is None:
            for row, line in enumerate(part):
                table[first + row] = number_row(line, width, what)
        else:
            table[first : first + len(part)] = rows
    return table


def number_row(line: DataLine, width: int, what: str) -> list[float]:
    """Return one line's label and numbers, as `number_table` does."""
    fields = line.fields
    if len(fields) > width:
        raise InputError(line.where, f"{len(fields)} fields", what)
    label = line.integer_at(0, what)
    return [label, *(line.number_at(i, what, 0.0) for i in range(1, width))]


def _uniform(texts: object, width: int) -> Floats | None:
    """Return rows of plain numbers, `width` to each; None where a line is anything else."""
    listed: list[str] = list(texts)  # type: ignore[call-overload]  # an array of texts is a sequence of them
    if any(text.count(",") != width - 1 for text in listed):
        return None
    joined = ",".join(listed)
    if "_" in joined:
        return None
    try:
        table = np.array(list(map(float, joined.split(","))), dtype=np.float64).reshape(len(listed), width)
    except ValueError:
        return None
    labels = table[:, 0]
    if not np.isfinite(table).all() or (labels != np.rint(labels)).any() or (np.abs(labels) > LARGEST_LABEL).any():
        return None
    return table


def integer_rows(lines: Lines, width: int) -> Ints | None:
    """Return lines of exactly `width` labels as rows, (n, width); None where a line is anything else."""
    table = np.zeros((len(lines), width), dtype=np.int64)
    for first in range(0, len(lines), CHUNK):
        listed = list(lines.texts[first : first + CHUNK])
        if any(text.count(",") != width - 1 for text in listed):
            return None
        try:
            rows = np.array(list(map(int, ",".join(listed).split(","))), dtype=np.int64)
        except (ValueError, OverflowError):
            return None
        if rows.size != len(listed) * width or rows.min(initial=0) < 0 or rows.max(initial=0) > LARGEST_LABEL:
            return None
        table[first : first + len(listed)] = rows.reshape(-1, width)
    return table


def plain_rows(lines: Lines) -> Floats | None:
    """Return lines of equally many plain numbers, a label first, as rows; None where a line is anything else."""
    if not len(lines):
        return np.zeros((0, 1))
    width = lines.texts[0].count(",") + 1
    parts = []
    for first in range(0, len(lines), CHUNK):
        rows = _uniform(lines.texts[first : first + CHUNK], width)
        if rows is None:
            return None
        parts.append(rows)
    return np.concatenate(parts)


def all_numbers(lines: Lines, least: int, most: int) -> bool:
    """Whether every line holds `least` to `most` plain finite numbers; False says only that one should look closer."""
    for first in range(0, len(lines), CHUNK):
        texts = list(lines.texts[first : first + CHUNK])
        if any(not least <= text.count(",") + 1 <= most for text in texts):
            return False
        joined = ",".join(texts)
        if "_" in joined:
            return False
        try:
            values = np.array(list(map(float, joined.split(","))))
        except ValueError:
            return False
        if not np.isfinite(values).all():
            return False
    return True
