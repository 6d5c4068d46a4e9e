"""Element types: how many nodes and faces they have, as far as their names tell."""

from __future__ import annotations

import re

# family -> node count by the digits in the name ("n"), or a fixed count
COUNTED = re.compile(
    r"(?:AC|DC|EC|CIN|COH|Q)?(?:3D|2D|C3D|CPE|CPS|CAX|CGAX|AX)(\d+)[A-Z0-9]*"
    r"|(?:S|DS|SC|STRI|R3D|R2D|RAX|M3D|SFM3D|T2D|T3D|DCC?|RB2D|RB3D|DC1D|AC1D)(\d+)[A-Z0-9]*"
)
FIXED = {
    "MASS": 1, "ROTARYI": 1, "HEATCAP": 1, "PC3D": 1, "PD3D": 1, "SPRING1": 1, "SPRING2": 2, "SPRINGA": 2,
    "DASHPOT1": 1, "DASHPOT2": 2, "DASHPOTA": 2, "CONN2D2": 2, "CONN3D2": 2, "GAPUNI": 2, "GAPCYL": 2,
    "GAPSPHER": 2, "B21": 2, "B22": 3, "B23": 2, "B31": 2, "B32": 3, "B33": 2, "PIPE21": 2, "PIPE22": 3,
    "PIPE31": 2, "PIPE32": 3, "ELBOW31": 2, "ELBOW32": 3, "SAX1": 2, "SAX2": 3, "MAX1": 2, "MAX2": 3,
    "SFMAX1": 2, "SFMAX2": 3, "FRAME2D": 2, "FRAME3D": 2, "STRI3": 3, "STRI65": 6, "S8R5": 8, "S9R5": 9,
    "S4R5": 4, "JOINTC": 2, "ITSUNI": 2, "DRAG2D": 2, "DRAG3D": 2,
}  # fmt: skip
SOLID = re.compile(r"C3D(4|6|8|10|15|20)([RHITMSPVE]*)")
PLANE = re.compile(r"(CPE|CPS|CAX)(3|4|6|8)([RHITMPE]*)")
SHELL = re.compile(r"(S(3|4|8)(R|RT|RS|RSW)?|SC(6|8)RT?|S4R5|S8R5|S9R5|M3D(3|4|6|8|9)R?)")
EXAMPLES = (
    "C3D4", "C3D6", "C3D8", "C3D8R", "C3D8I", "C3D8H", "C3D8RH", "C3D8T", "C3D8RT", "C3D10", "C3D10M", "C3D20",
    "C3D20R", "S3R", "S4", "S4R", "M3D3", "M3D4R", "R3D3", "R3D4", "CPE4R", "CPS4R", "CAX4R", "T3D2", "B31",
    "MASS", "ROTARYI", "SPRINGA", "DASHPOTA", "CONN3D2", "SFM3D4R",
)  # fmt: skip
"""Common types, against which a misspelt one is recognised."""
OPEN = re.compile(
    r"U\d+|VU\d+|CPEG.*|CGPE.*|CAXA.*|SAXA.*|C3D27.*|C3D15V.*|CCL.*|GK.*|ASI.*|FLINK|FLUID.*|F[23]D\d|FAX\d"
)
"""Types whose node count a name does not tell, user elements among them."""


def node_count(kind: str) -> int | None:
    """Return the number of nodes of an element type; None where its name does not tell.

    Examples
    --------
    >>> node_count("C3D8R"), node_count("CAX4R"), node_count("B31"), node_count("U7")
    (8, 4, 2, None)
    """
    if kind in FIXED:
        return FIXED[kind]
    if OPEN.fullmatch(kind):
        return None
    bare = re.fullmatch(r"(B[23][123]|PIPE[23][12]|ELBOW3[12])[A-Z]*", kind)
    if bare:
        return FIXED[bare[1]]
    found = COUNTED.fullmatch(kind)
    if found is None:
        return None
    digits = int(found[1] or found[2])
    return digits if digits <= 27 else None


def is_known(kind: str) -> bool:
    """Whether a type is one that the lint knows the form of."""
    if kind in FIXED or kind in EXAMPLES or OPEN.fullmatch(kind):
        return True
    if re.search(r"([A-Z])\1$", kind):  # no type's name ends with one letter twice
        return False
    if kind.startswith("C3D"):
        return SOLID.fullmatch(kind) is not None
    return COUNTED.fullmatch(kind) is not None or node_count(kind) is not None


def needs_section(kind: str) -> bool:
    """Whether elements of the type are of a material: solids, plane and axisymmetric elements, shells, membranes."""
    return any(form.fullmatch(kind) for form in (SOLID, PLANE, SHELL))


def is_hexahedron(kind: str) -> bool:
    """Whether the type is a hexahedron whose first eight nodes are its corners."""
    found = SOLID.fullmatch(kind)
    return found is not None and found[1] in ("8", "20")


def is_tetrahedron(kind: str) -> bool:
    """Whether the type is a tetrahedron whose first four nodes are its corners."""
    found = SOLID.fullmatch(kind)
    return found is not None and found[1] in ("4", "10")


def face_count(kind: str) -> int | None:
    """Return the number of faces S1.. of a solid element; None for anything else."""
    found = SOLID.fullmatch(kind)
    return None if found is None else {"4": 4, "10": 4, "6": 5, "15": 5}.get(found[1], 6)
