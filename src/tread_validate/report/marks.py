"""Codes for the assumed (A) and synthetic (S) inputs, so that every number can carry them."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ..compare.tables import AssumedRow
from .content import Mark

_ENDING = re.compile(r"\s*\((assumed|synthetic)\)$")


class Marks:
    """Turn the tables' ``assumed`` columns into coded marks (S1, A2, ...), in the order of the list of assumptions."""

    def __init__(self, assumed: Iterable[AssumedRow]) -> None:
        self._known: dict[str, Mark] = {}
        for row in assumed:
            self._add(row.input, row.origin, row.source)

    def of(self, *texts: object) -> tuple[Mark, ...]:
        """Return the marks named in ``"; "``-joined lists, without doubles, in order of their codes."""
        names: dict[str, None] = {}
        for text in texts:
            names.update(dict.fromkeys(part.strip() for part in str(text or "").split(";") if part.strip()))
        found = {mark.code: mark for mark in (self._mark(name) for name in names)}
        return tuple(sorted(found.values(), key=lambda mark: int(mark.code[1:])))

    def of_column(self, values: Iterable[object]) -> tuple[Mark, ...]:
        """Return the marks named anywhere in a column."""
        return self.of(*dict.fromkeys(str(value) for value in values))

    def all(self) -> tuple[Mark, ...]:
        """Return every mark known by now."""
        return tuple(self._known.values())

    def _mark(self, name: str) -> Mark:
        plain = _ENDING.sub("", name)
        if plain not in self._known:
            ending = _ENDING.search(name)
            self._add(name, ending.group(1) if ending else "assumed", "")
        return self._known[plain]

    def _add(self, name: str, origin: str, source: str) -> None:
        plain = _ENDING.sub("", name)
        text = f"{plain} ({origin})" + (f": {source}" if source else "")
        letter = "S" if origin == "synthetic" else "A"
        self._known[plain] = Mark(f"{letter}{len(self._known) + 1}", origin, text)


def by_origin(marks: Iterable[Mark]) -> list[tuple[str, list[Mark]]]:
    """Group marks by what they are: assumed, synthetic."""
    found: dict[str, list[Mark]] = {}
    for mark in marks:
        found.setdefault(mark.origin, []).append(mark)
    return list(found.items())


def in_words(marks: Iterable[Mark]) -> str:
    """Write marks as text: ``synthetic S1 · assumed A2 A4``."""
    return " · ".join(f"{origin} {' '.join(mark.code for mark in members)}" for origin, members in by_origin(marks))
