"""The keywords and element types that the lint knows; the keywords themselves are listed in ``keywords.yaml``.

A keyword that is not in the list is reported, never passed over in silence.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Literal

import yaml

Place = Literal["model", "step", "any"]


@dataclass(frozen=True)
class Keyword:
    """Form of one keyword.

    Attributes
    ----------
    place : str
        ``model`` (before the first step), ``step`` (inside one) or ``any``.
    required, optional : frozenset of str
        Parameter names.
    values : dict of str to tuple of str
        Parameters whose values are a closed list.
    fields : tuple of int or None
        Least and most fields of a data line; None where this depends on more than the keyword.
    lines : tuple of int
        Least and most data lines (the most may be -1: any number).
    numeric : bool
        Whether every field of a data line is a number.
    parents : tuple of str
        Keywords one of which must precede it, with nothing but other options in between.
    open : bool
        Known by name and place only: parameters are not checked.
    """

    place: Place
    required: frozenset[str]
    optional: frozenset[str]
    values: dict[str, tuple[str, ...]]
    fields: tuple[int, int] | None
    lines: tuple[int, int]
    numeric: bool
    parents: tuple[str, ...]
    open: bool


def _keyword(entry: dict[str, Any]) -> Keyword:
    fields = entry.get("fields")
    lines = entry.get("lines", (0, -1))
    return Keyword(
        place=entry["place"],
        required=frozenset(entry.get("required", ())),
        optional=frozenset(entry.get("optional", ())),
        values={name: tuple(values) for name, values in entry.get("values", {}).items()},
        fields=None if fields is None else (fields[0], fields[1]),
        lines=(lines[0], lines[1]),
        numeric=entry.get("numbers", False),
        parents=tuple(entry.get("below", ())),
        open=entry.get("open", False),
    )


def _load() -> dict[str, Keyword]:
    text = (files("tread_validate.deck.lint") / "keywords.yaml").read_text(encoding="utf-8")
    return {name: _keyword(entry) for name, entry in yaml.safe_load(text).items()}


KEYWORDS: dict[str, Keyword] = _load()

ELEMENT_NODES = {
    "C3D4": 4, "C3D6": 6, "C3D8": 8, "C3D8R": 8, "C3D8I": 8, "C3D8H": 8, "C3D8RH": 8, "C3D8T": 8, "C3D8RT": 8,
    "C3D10": 10, "C3D10M": 10, "C3D20": 20, "C3D20R": 20, "R3D3": 3, "R3D4": 4, "S3R": 3, "S4": 4, "S4R": 4,
    "M3D3": 3, "M3D4": 4, "M3D4R": 4, "SFM3D3": 3, "SFM3D4": 4, "SFM3D4R": 4, "CPE4R": 4, "CPS4R": 4, "CAX4R": 4,
    "T3D2": 2, "B31": 2, "MASS": 1, "ROTARYI": 1, "SPRINGA": 2, "DASHPOTA": 2, "CONN3D2": 2,
}  # fmt: skip
"""Nodes of each known element type."""

HEXAHEDRA = frozenset({"C3D8", "C3D8R", "C3D8I", "C3D8H", "C3D8RH", "C3D8T", "C3D8RT"})
SECTIONLESS = frozenset({"R3D3", "R3D4", "MASS", "ROTARYI", "SPRINGA", "DASHPOTA", "CONN3D2"})
SECTION_KEYWORDS = frozenset({"SOLID SECTION", "SHELL SECTION", "MEMBRANE SECTION"})
FACES = {"C3D4": 4, "C3D6": 5, "C3D10": 4, "C3D10M": 4}
"""Faces S1.. of solid elements other than hexahedra (6)."""
