"""What of a deck CalculiX can do: read it, refuse by name what that engine would silently ignore."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..files import read_text
from ..inp import Deck, KeywordBlock, label, read_deck
from ..inp.sets import Sets
from ..inp.symmetry import PLANE, is_half
from ..inp.table import integer_rows, number_table
from .motion import PlaneMotion, read_motions

# keyword -> what CalculiX 2.20 does with it
IGNORED = {
    "VISCOELASTIC": "the block would be elastic",
    "TRS": "time would not be reduced",
    "FIXED MASS SCALING": "there is no mass in a quasi-static run",
    "VARIABLE MASS SCALING": "there is no mass in a quasi-static run",
    "EXPANSION": "temperatures are not translated",
    "EQUATION": "constraint equations are not translated",
    "TIE": "ties are not translated",
    "CLOAD": "loads are not translated",
    "DLOAD": "loads are not translated",
    "CONTACT": "general contact is not translated",
}
DROPPED = {
    "DENSITY": "inertia (the run is quasi-static)",
    "DAMPING": "damping of the material (the run is quasi-static)",
    "BULK VISCOSITY": "bulk viscosity (the run is quasi-static)",
    "SECTION CONTROLS": "hourglass control of the deck (CalculiX has its own)",
    "OUTPUT": "output requests (the total forces are printed)",
    "CONTACT OUTPUT": "",
    "NODE OUTPUT": "",
    "ELEMENT OUTPUT": "",
    "ENERGY OUTPUT": "",
    "HEADING": "",
    "END STEP": "",
}
READ = {
    "NODE", "ELEMENT", "NSET", "ELSET", "SURFACE", "RIGID BODY", "AMPLITUDE", "MATERIAL", "ELASTIC", "HYPERELASTIC",
    "SOLID SECTION", "SURFACE INTERACTION", "FRICTION", "INITIAL CONDITIONS", "BOUNDARY", "STEP", "DYNAMIC",
    "CONTACT PAIR",
}  # fmt: skip
KINDS = ("C3D8R", "C3D8")
MEAN_VOLUME = "the one mean volume change of a C3D8 (CalculiX integrates it at eight points, and locks near nu = 0.5)"
NODE_LINE = "a node number and x, y, z"
COULOMB_ROUTINE = re.compile(r"^\s+fricmu\s*=\s*props\(2\)\s*$", re.MULTILINE)


@dataclass(frozen=True)
class ElasticDeck:
    """A deck of the elastic-Coulomb subset, in deck units (mm, MPa, s).

    Attributes
    ----------
    case_id : str
    nodes : mapping of node number to (x, y, z)
        Of the block only.
    elements : (n, 9) int array
        Number and the eight nodes.
    kind : str
        C3D8R or C3D8.
    face : tuple of (element set's elements, face label)
        The contact face.
    mount : mapping of row number to node numbers
        Nodes that move alike.
    motions : mapping of row number to `PlaneMotion`
    road : `PlaneMotion` of the road's reference node
    wheel_radius : float or None
        None for a plane road.
    young, poisson, friction : float
    neo_hookean : bool
        Whether the deck itself asks for the neo-Hookean law.
    durations : tuple of float, s
    symmetry : tuple of int
        Nodes on the plane of symmetry of a deck that models half a block; empty for a whole one.
    dropped : tuple of str
        What the deck asks for and a quasi-static run has no use for.
    """

    case_id: str
    nodes: dict[int, tuple[float, float, float]]
    elements: NDArray[np.int64]
    face: tuple[tuple[int, ...], str]
    mount: dict[int, tuple[int, ...]]
    motions: dict[int, PlaneMotion]
    road: PlaneMotion
    wheel_radius: float | None
    young: float
    poisson: float
    friction: float
    durations: tuple[float, ...]
    dropped: tuple[str, ...] = field(default=())
    symmetry: tuple[int, ...] = field(default=())
    kind: str = "C3D8R"
    neo_hookean: bool = False


def read_elastic_deck(path: Path | str, user: Path | str | None = None) -> ElasticDeck:
    """Read a deck for CalculiX.

    Parameters
    ----------
    path : path
        The deck; its friction is built-in, or VFRIC with Coulomb's law and equal static and kinetic coefficients.
    user : path, optional
        The friction routine of such a deck.

    Raises
    ------
    InputError
        With the line of the keyword that CalculiX would ignore, or that is not of the subset.
    """
    deck = read_deck(path)
    dropped = _sift(deck)
    sets = _sets(deck)
    numbers, places = _block_nodes(deck)
    elements, face = _elements(deck, sets)
    kind = _kind(deck)
    if kind == "C3D8":
        dropped = (*dropped, MEAN_VOLUME)
    used = set(elements[:, 1:].ravel().tolist())
    missing = used - set(numbers)
    if missing:
        raise InputError(f"{deck.path}: *ELEMENT", f"node {min(missing)}", "nodes that *NODE defines")
    mount, motions, road, radius = read_motions(deck, sets, dict(zip(numbers, places, strict=True)))
    young, poisson, neo_hookean = _elastic(deck)
    return ElasticDeck(
        case_id=_case_id(deck),
        nodes={n: p for n, p in zip(numbers, places, strict=True) if n in used},
        elements=elements,
        face=face,
        mount=mount,
        motions=motions,
        road=road,
        wheel_radius=radius,
        young=young,
        poisson=poisson,
        friction=_friction(deck, user),
        durations=tuple(b.data[0].number_at(1, "a duration, s") for b in deck.named("DYNAMIC") if b.data),
        dropped=dropped,
        symmetry=sets[PLANE] if is_half(deck) else (),
        kind=kind,
        neo_hookean=neo_hookean,
    )


def _sift(deck: Deck) -> tuple[str, ...]:
    dropped: list[str] = []
    for block in deck.blocks:
        if block.keyword in IGNORED:
            raise InputError(
                f"{block.where}: *{block.keyword}",
                "a keyword that CalculiX would ignore or that is not translated",
                f"a deck without it: {IGNORED[block.keyword]}",
            )
        if block.keyword in DROPPED:
            if DROPPED[block.keyword] and DROPPED[block.keyword] not in dropped:
                dropped.append(DROPPED[block.keyword])
        elif block.keyword == "INITIAL CONDITIONS":
            dropped.append(f"initial {block.value('TYPE').lower()}")
        elif block.keyword not in READ:
            raise InputError(
                f"{block.where}: *{block.keyword}", "a keyword outside the subset", "the documented subset"
            )
    if "kinematic contact (penalty contact instead)" not in dropped:
        dropped.append("kinematic contact (penalty contact instead)")
    return tuple(dict.fromkeys(dropped))


def _sets(deck: Deck) -> dict[str, tuple[int, ...]]:
    """Return the labels of every node and element set; one name is one set, of nodes or of elements."""
    nodes = [(block, number_table(block.data, 4, NODE_LINE)[:, 0].astype(np.int64)) for block in deck.named("NODE")]
    elements = [(block, _rows(block)) for block in deck.named("ELEMENT")]
    table = np.concatenate([rows for _, rows in elements]) if elements else np.zeros((0, 9), dtype=np.int64)
    sets = Sets(
        np.concatenate([labels for _, labels in nodes]) if nodes else table[:, 0],
        table[:, 0],
        lambda members: np.unique(table[np.isin(table[:, 0], members), 1:]),
    )
    for block, labels in nodes:
        sets.extend("node", block.parameters.get("NSET"), labels)
    for block, rows in elements:
        sets.extend("element", block.parameters.get("ELSET"), rows[:, 0])
    sets.read(deck.blocks)
    return {name: tuple(found.tolist()) for name, found in (*sets.elements.items(), *sets.nodes.items())}


def _rows(block: KeywordBlock) -> NDArray[np.int64]:
    """Return label and nodes of each element, (m, 9)."""
    rows = integer_rows(block.data, 9)
    if rows is None:
        rows = np.array([[line.integer_at(i, "a number") for i in range(9)] for line in block.data], dtype=np.int64)
    return rows


def _block_nodes(deck: Deck) -> tuple[list[int], list[tuple[float, float, float]]]:
    numbers: list[int] = []
    places: list[tuple[float, float, float]] = []
    for block in deck.named("NODE"):
        table = number_table(block.data, 4, NODE_LINE)
        numbers += table[:, 0].astype(np.int64).tolist()
        places += [tuple(place) for place in table[:, 1:].tolist()]
    return numbers, places


def _elements(deck: Deck, sets: dict[str, tuple[int, ...]]) -> tuple[NDArray[np.int64], tuple[tuple[int, ...], str]]:
    rows = []
    for block in deck.named("ELEMENT"):
        rows.append(_rows(block))
    if not rows:
        raise InputError(deck.path, "no *ELEMENT", "a meshed block")
    for block in deck.named("SURFACE"):
        if block.value("TYPE", "ELEMENT") == "ELEMENT" and len(block.data) == 1 and len(block.data[0].fields) == 2:
            name, side = (label(part) for part in block.data[0].fields)
            if name not in sets:
                raise InputError(block.data[0].where, name, "an element set of the deck")
            return np.concatenate(rows), (sets[name], side)
    raise InputError(deck.path, "no element-based contact face", "*SURFACE, TYPE=ELEMENT with one set and face")


def _kind(deck: Deck) -> str:
    """Return the one type of the deck's elements."""
    kinds = {block.value("TYPE"): block for block in deck.named("ELEMENT")}
    for kind, block in kinds.items():
        if kind not in KINDS or len(kinds) > 1:
            found = ", ".join(kinds) if len(kinds) > 1 else kind
            raise InputError(f"{block.where}: *ELEMENT, TYPE", found, f"one of {', '.join(KINDS)}, for all elements")
    return next(iter(kinds))


def _elastic(deck: Deck) -> tuple[float, float, bool]:
    """Return Young's modulus and Poisson's ratio at no strain, and whether the law is neo-Hookean."""
    blocks = [block for block in deck.named("ELASTIC", "HYPERELASTIC") if block.data]
    if len(blocks) != 1 or len(blocks[0].data) != 1:
        raise InputError(f"{deck.path}: *ELASTIC", f"{len(blocks)} of them", "one material with one line")
    block, line = blocks[0], blocks[0].data[0]
    if block.keyword == "ELASTIC":
        return line.number_at(0, "a modulus"), line.number_at(1, "Poisson's ratio"), False
    c10, d1 = line.number_at(0, "C10"), line.number_at(1, "D1", 0.0)
    if "NEO HOOKE" not in block.parameters or not c10 > 0.0 or not d1 > 0.0:
        where = f"{line.where}: *HYPERELASTIC"
        raise InputError(where, ", ".join([*block.parameters, line.text]), "NEO HOOKE with C10 > 0 and D1 > 0")
    shear, bulk = 2.0 * c10, 2.0 / d1
    poisson = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
    return 2.0 * shear * (1.0 + poisson), poisson, True


def _friction(deck: Deck, user: Path | str | None) -> float:
    blocks = list(deck.named("FRICTION"))
    if len(blocks) != 1 or not blocks[0].data:
        raise InputError(f"{deck.path}: *FRICTION", f"{len(blocks)} of them", "one friction law with constants")
    block = blocks[0]
    line = block.data[0]
    if "USER" not in block.parameters:
        if len(line.fields) > 1 or set(block.parameters):
            raise InputError(f"{line.where}: *FRICTION", line.text[:40], "one constant coefficient")
        return line.number_at(0, "a friction coefficient")
    where = f"{block.where}: *FRICTION, USER"
    if user is None or not COULOMB_ROUTINE.search(read_text(user)):
        raise InputError(
            where,
            "a user routine, which CalculiX would ignore",
            "built-in friction, or the routine of a Coulomb law given with --user",
        )
    static, kinetic = line.number_at(0, "a static coefficient"), line.number_at(1, "a kinetic coefficient")
    if static != kinetic:
        raise InputError(where, f"static {static:g}, kinetic {kinetic:g}", "one coefficient: CalculiX has no other law")
    return kinetic


def _case_id(deck: Deck) -> str:
    for block in deck.named("HEADING"):
        if block.data:
            return block.data[0].text.strip()
    return deck.path.stem
