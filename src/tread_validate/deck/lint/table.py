"""The element types that the lint knows, and the vocabulary it checks keywords against.

A keyword that is not in the vocabulary is reported, never passed over in silence.
"""

from __future__ import annotations

from ...inp.vocabulary import Keyword, keywords

__all__ = ["ELEMENT_NODES", "FACES", "HEXAHEDRA", "KEYWORDS", "SECTIONLESS", "SECTION_KEYWORDS", "Keyword"]

KEYWORDS: dict[str, Keyword] = keywords()

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
