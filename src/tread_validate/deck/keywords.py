"""Text of the ABAQUS keyword language: numbers, tables, sets. No meaning, only form.

Data lines hold at most 16 integers or 8 reals, each within 20 characters, as the language asks.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import one_line

LONGEST_LINE = 256


def keyword(name: str, *flags: str, **parameters: object) -> str:
    """Return a keyword line; underscores in parameter names stand for blanks.

    Examples
    --------
    >>> keyword("CONTACT PAIR", INTERACTION="TREAD", MECHANICAL_CONSTRAINT="KINEMATIC")
    '*CONTACT PAIR, INTERACTION=TREAD, MECHANICAL CONSTRAINT=KINEMATIC'
    """
    parts = [f"*{name}", *flags]
    parts += [f"{key.replace('_', ' ')}={value}" for key, value in parameters.items()]
    return ", ".join(parts)


def number(value: float, digits: int = 9) -> str:
    """Return the shortest text of `value` to `digits` significant digits, with a point or an exponent."""
    text = f"{value:.{digits}g}"
    if text == "-0":
        text = "0"
    return text if any(mark in text for mark in ".en") else text + "."


def reals(values: Iterable[float], digits: int = 9, per_line: int = 8) -> list[str]:
    """Return data lines of reals, `per_line` to a line."""
    texts = [number(float(value), digits) for value in values]
    return [", ".join(texts[i : i + per_line]) for i in range(0, len(texts), per_line)]


def integers(values: Sequence[int] | NDArray[np.int64], per_line: int = 16) -> list[str]:
    """Return data lines of integers, `per_line` to a line."""
    texts = [str(int(value)) for value in values]
    return [", ".join(texts[i : i + per_line]) for i in range(0, len(texts), per_line)]


def table(columns: Sequence[NDArray[np.float64] | NDArray[np.int64]], formats: Sequence[str]) -> str:
    """Return one data line per row of equally long columns; `formats` are printf formats. No line end at the end."""
    count = columns[0].size
    flat: list[object] = [None] * (count * len(columns))
    for position, column in enumerate(columns):
        flat[position :: len(columns)] = column.tolist()
    return "\n".join([", ".join(formats)] * count) % tuple(flat)


def comment(text: str) -> str:
    """Return a comment line; what would break the line is folded away, what is too long is cut."""
    return one_line(f"** {text}", LONGEST_LINE - 2) if text else "**"
