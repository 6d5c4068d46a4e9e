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

RELATIVE_TOLERANCE = 1e-5
"""Single numbers of two decks that agree to this are equal: far below any mesh error."""
COLUMN_TOLERANCE = 1e-6
"""In a table of `TABLE_LINES` lines or more numbers agree to this share of their column's largest, which is more than
nothing where a component passes through zero."""
COORDINATE_TOLERANCE = 1.5e-5
"""mm: coordinates agree to one and a half of the last digit that decks have. A share of a coordinate would not do: the
interference is a small difference of large ones."""
COORDINATES = ("*NODE", "*SURFACE")  # keywords whose lines are coordinates
TABLE_LINES = 20
NOT_THE_PROBLEM = frozenset({"HEADING", "INCLUDE", "PARAMETER", "PREPRINT"})
FORTRAN_COMMENTS = ("c", "C", "*", "!")
USER_ROUTINE = "*USER SUBROUTINE"
"""Stands above the lines of the friction routine, which belongs to the problem as the deck does."""

INCLUDED = re.compile(r"^\*include\s*,\s*input\s*=\s*(.+)$", re.IGNORECASE | re.MULTILINE)
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

    @property
    def count(self) -> int:
        """Number of lines."""
        return len(self.lines)

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
        """SHA-256 of the problem without its numbers, in hex (of tables: their size); equal problems agree in it."""
        total = hashlib.sha256()
        for part in self.parts:
            total.update(f"{part.count} ".encode())
            for line in (part.keyword, *(part.lines if part.count < TABLE_LINES else part.lines[:1])):
                total.update(NUMBER.sub("#", line).encode() + b"\n")
        return total.hexdigest()


@dataclass(frozen=True)
class DeckDifference:
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


def agree(filed: Problem, today: Problem) -> bool:
    """Whether two problems are the same to the tolerances above; short parts are looked at before tables."""
    if filed.digest == today.digest:
        return True
    if len(filed.parts) != len(today.parts):
        return False
    pairs = sorted(zip(filed.parts, today.parts, strict=True), key=lambda pair: pair[1].count)
    return all(next(_of_parts(old, new), None) is None for old, new in pairs)


def differences(filed: Problem, today: Problem) -> Iterator[DeckDifference]:
    """Yield the lines in which two problems differ beyond the tolerances, in the order of the deck."""
    if filed.digest == today.digest:
        return
    for old, new in zip_longest(filed.parts, today.parts):
        if old is None or new is None:
            here = old or new
            place = here.place(-1)
            yield DeckDifference(
                place, "nothing" if old is None else old.keyword, "nothing" if new is None else new.keyword
            )
            return
        yield from _of_parts(old, new)
        if NUMBER.sub("#", old.keyword) != NUMBER.sub("#", new.keyword):
            return  # what follows is shifted


def _of_parts(old: Part, new: Part) -> Iterator[DeckDifference]:
    found = _line_difference(old.keyword, new.keyword, ())
    if found is not None:
        yield DeckDifference(new.place(-1), *found)
    if old.digest == new.digest:
        return
    if old.count != new.count:
        yield DeckDifference(new.place(-1), f"{old.count} lines", f"{new.count} lines")
        return
    allowed = _allowed(new)
    for index, (a, b) in enumerate(zip(old.lines, new.lines, strict=True)):
        if a != b:
            found = _line_difference(a, b, allowed)
            if found is not None:
                yield DeckDifference(new.place(index), *found)


def _allowed(part: Part) -> tuple[float, ...]:
    """Return by how much the numbers of each column may differ; empty where each is held to its own size."""
    columns: list[float] = []
    coordinates = part.keyword.split(",", maxsplit=1)[0] in COORDINATES
    if not coordinates and part.count < TABLE_LINES:
        return ()
    for line in part.lines:
        for column, text in enumerate(NUMBER.findall(line)):
            value = COORDINATE_TOLERANCE if coordinates else COLUMN_TOLERANCE * abs(_value(text))
            if column == len(columns):
                columns.append(value)
            elif value > columns[column]:
                columns[column] = value
    return tuple(columns)


def _line_difference(filed: str, today: str, allowed: Sequence[float]) -> tuple[str, str, float | None] | None:
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
        room = allowed[column] if column < len(allowed) else RELATIVE_TOLERANCE * scale
        if a.lstrip("+-").isdigit() and b.lstrip("+-").isdigit():
            room = 0.0  # labels and counts agree exactly or not at all
        if apart > room and (worst is None or worst[2] is None or apart / scale > worst[2]):
            worst = a, b, apart / scale
    return worst


def _value(text: str) -> float:
    return float(text.upper().replace("D", "E"))


@dataclass(frozen=True)
class DeckFiles:
    """A deck and its friction routine as files, read when first asked for."""

    deck: Path
    user: Path | None = None

    @cached_property
    def problem(self) -> Problem:
        """The problem; raises `InputError` for a deck that cannot be read."""
        return problem_of(self.deck, self._user)

    @cached_property
    def text_digest(self) -> str:
        """SHA-256 of all lines but comments, in hex: equal texts pose one problem, and this is quick to find out."""
        total = hashlib.sha256()
        waiting = [self.deck]
        seen: set[Path] = set()
        while waiting:
            file = waiting.pop()
            if file in seen or not file.is_file():
                continue
            seen.add(file)
            text = read_text(file)
            for line in text.splitlines():
                if not line.startswith("**"):
                    total.update(line.rstrip().encode() + b"\n")
            waiting += [self.deck.parent / name.strip('" ') for name in INCLUDED.findall(text)]
        total.update(b"\0" + (self._user or "").encode())
        return total.hexdigest()

    @cached_property
    def _user(self) -> str | None:
        return read_text(self.user) if self.user is not None and self.user.is_file() else None


def deck_files(folder: Path, case_id: str) -> DeckFiles:
    """Return the files of a case's deck in a folder of decks, ``<case_id>/<case_id>.inp`` and ``vfric.f``."""
    return DeckFiles(folder / case_id / f"{case_id}.inp", folder / case_id / "vfric.f")
