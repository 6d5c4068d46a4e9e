"""What a deck asks to be solved, apart from how it is written down: its digest, and how two decks differ.

Comments, the heading, blanks, letter case, includes and the order of a keyword's parameters do not belong to the
problem: a deck in one file and the same deck in several have one digest.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import zip_longest
from pathlib import Path

from ..files import read_text
from .deck import Deck
from .reader import read_deck

RELATIVE_TOLERANCE = 1e-6
"""Numbers of two decks that agree to this are equal; far below any mesh error. In a table of `TABLE_LINES` lines or
more it is a share of the column's largest number, so that a coordinate near zero is held to the body's size."""
TABLE_LINES = 20
NOT_THE_PROBLEM = frozenset({"HEADING", "INCLUDE", "PARAMETER", "PREPRINT"})
FORTRAN_COMMENTS = ("c", "C", "*", "!")
USER_ROUTINE = "*USER SUBROUTINE"
"""Stands above the lines of the friction routine, which belongs to the problem as the deck does."""

NUMBER = re.compile(r"(?<![A-Za-z_0-9.])[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?")


@dataclass(frozen=True)
class Part:
    """A keyword line and the lines below it.

    Attributes
    ----------
    keyword : str
        In canonical form: upper case, parameters sorted by name.
    lines : tuple of str
        Fields without blanks around them.
    places : tuple of str
        ``file:line`` of the keyword and of each line; empty where the deck came out of a store.
    """

    keyword: str
    lines: tuple[str, ...]
    places: tuple[str, ...] = ()

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the lines, in hex."""
        return hashlib.sha256("\n".join(self.lines).encode()).hexdigest()

    def place(self, line: int) -> str:
        """Return where a line stands (0: the first below the keyword; -1: the keyword)."""
        if self.places:
            return self.places[line + 1]
        return self.keyword if line < 0 else f"{self.keyword}, line {line + 1}"


@dataclass(frozen=True)
class Problem:
    """The problem that a deck and its friction routine pose."""

    parts: tuple[Part, ...]

    @cached_property
    def digest(self) -> str:
        """SHA-256 of the problem, in hex: the binding of a result to its deck."""
        return hashlib.sha256("\n".join(f"{part.keyword} {part.digest}" for part in self.parts).encode()).hexdigest()

    @cached_property
    def structure(self) -> str:
        """SHA-256 of the problem with every number left out, in hex: decks that could be equal agree in it."""
        total = hashlib.sha256()
        for part in self.parts:
            for line in (part.keyword, *part.lines):
                total.update(NUMBER.sub("#", line).encode() + b"\n")
        return total.hexdigest()


@dataclass(frozen=True)
class Difference:
    """One line in which two decks differ.

    Attributes
    ----------
    place : str
        ``file:line`` in today's deck, or the keyword.
    filed, today : str
        The lines, or the numbers in them that differ most.
    relative : float or None
        Distance of two numbers over the larger one; None where words differ.
    """

    place: str
    filed: str
    today: str
    relative: float | None = None

    def __str__(self) -> str:
        """Say it in one line."""
        by = "" if self.relative is None else f" ({self.relative:.2g} apart)"
        return f"{self.place}: {self.filed[:60]} when it was run, {self.today[:60]} today{by}"


def problem_of(deck: Deck | Path | str, user: str | None = None) -> Problem:
    """Return the problem of a deck, its includes expanded.

    Parameters
    ----------
    deck : Deck or path
    user : str or None
        Text of the friction routine; its comment lines (``c``, ``C``, ``*`` or ``!`` in column 1) do not count.

    Raises
    ------
    InputError
        A deck that cannot be read.
    """
    read = deck if isinstance(deck, Deck) else read_deck(deck)
    parts = []
    for block in read.blocks:
        if block.keyword in NOT_THE_PROBLEM:
            continue
        named = [name if value is None else f"{name}={value}" for name, value in sorted(block.parameters.items())]
        lines = tuple(",".join(line.fields) for line in block.data)
        places = (block.where, *(line.where for line in block.data))
        parts.append(Part(", ".join([f"*{block.keyword}", *named]), lines, places))
    if user is not None:
        kept = tuple(line.rstrip() for line in user.splitlines() if line.strip() and line[0] not in FORTRAN_COMMENTS)
        parts.append(Part(USER_ROUTINE, kept))
    return Problem(tuple(parts))


def problem_of_files(deck: Path, user: Path | None) -> Problem:
    """Return the problem of a deck file and, where there is one, its friction routine's file."""
    return problem_of(deck, read_text(user) if user is not None and user.is_file() else None)


def differences(filed: Problem, today: Problem, tolerance: float = RELATIVE_TOLERANCE) -> Iterator[Difference]:
    """Yield the lines in which two problems differ beyond the tolerance, in the order of the deck."""
    if filed.digest == today.digest:
        return
    for old, new in zip_longest(filed.parts, today.parts):
        if old is None or new is None:
            here = old or new
            place = here.place(-1)
            yield Difference(
                place, "nothing" if old is None else old.keyword, "nothing" if new is None else new.keyword
            )
            return
        found = _line_difference(old.keyword, new.keyword, tolerance, ())
        if found is not None:
            yield Difference(new.place(-1), *found)
            if NUMBER.sub("#", old.keyword) != NUMBER.sub("#", new.keyword):
                return
        if old.digest != new.digest:
            yield from _between(old, new, tolerance)


def _between(old: Part, new: Part, tolerance: float) -> Iterator[Difference]:
    if len(old.lines) != len(new.lines):
        yield Difference(new.place(-1), f"{len(old.lines)} lines", f"{len(new.lines)} lines")
        return
    scales = _scales(old.lines) if len(old.lines) >= TABLE_LINES else ()
    for index, (a, b) in enumerate(zip(old.lines, new.lines, strict=True)):
        if a != b:
            found = _line_difference(a, b, tolerance, scales)
            if found is not None:
                yield Difference(new.place(index), *found)


def _scales(lines: Sequence[str]) -> tuple[float, ...]:
    """Return the largest number of each column."""
    largest: list[float] = []
    for line in lines:
        for column, text in enumerate(NUMBER.findall(line)):
            value = abs(_value(text))
            if column == len(largest):
                largest.append(value)
            elif value > largest[column]:
                largest[column] = value
    return tuple(largest)


def _line_difference(
    filed: str, today: str, tolerance: float, scales: Sequence[float]
) -> tuple[str, str, float | None] | None:
    """Return what differs in a line (texts, relative distance), None where it agrees."""
    if filed == today:
        return None
    if NUMBER.sub("#", filed) != NUMBER.sub("#", today):
        return filed, today, None
    worst: tuple[str, str, float | None] | None = None
    for column, (a, b) in enumerate(zip(NUMBER.findall(filed), NUMBER.findall(today), strict=True)):
        if a == b:
            continue
        first, second = _value(a), _value(b)
        apart = abs(first - second)
        scale = max(abs(first), abs(second))
        whole = a.lstrip("+-").isdigit() and b.lstrip("+-").isdigit()  # labels and counts agree exactly or not at all
        allowed = 0.0 if whole else tolerance * max(scale, scales[column] if column < len(scales) else 0.0)
        if apart > allowed and (worst is None or worst[2] is None or apart / scale > worst[2]):
            worst = a, b, apart / scale
    return worst


def _value(text: str) -> float:
    return float(text.upper().replace("D", "E"))
