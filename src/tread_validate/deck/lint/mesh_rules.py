"""Rules on elements, sections and materials."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ...inp import Deck, KeywordBlock
from ...inp.sets import sorted_labels
from . import elements as kinds
from .findings import Findings
from .material_rules import check_material
from .mesh_tables import ElementTable
from .names import Names
from .table import SECTION_KEYWORDS

MOST = 5
"""Findings of one rule at most in one element block; the last says how many more there are."""

# natural coordinates of a hexahedron's corners
CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], dtype=float
)
CHUNK = 50_000  # elements at a time


def check_mesh(deck: Deck, names: Names, findings: Findings) -> None:
    """Check that elements have nodes, a positive Jacobian and one section with a whole material."""
    _check_element_nodes(names, findings)
    used = check_sections(deck, names, findings)
    for name, block in names.named.get("MATERIAL", {}).items():
        check_material(deck, names, name, block, name in used, findings)


def _check_element_nodes(names: Names, findings: Findings) -> None:
    order = np.argsort(names.node_ids)
    sorted_ids = names.node_ids[order]
    for part in names.elements:
        if not part.nodes.size:
            continue
        if not sorted_ids.size:
            if not names.open_mesh:
                findings.add(part.block, "undefined-node", "elements without any node")
            continue
        place = np.clip(np.searchsorted(sorted_ids, part.nodes), 0, sorted_ids.size - 1)
        missing = sorted_ids[place] != part.nodes
        if part.nodes.shape[1] > 8 or not kinds.needs_section(part.kind):
            missing &= part.nodes != 0  # a midside node or a second end may be left out as 0
        if not names.open_mesh:
            absent = np.unique(part.nodes[missing])
            for node in absent[:MOST].tolist():
                rows = np.flatnonzero((missing & (part.nodes == node)).any(axis=1))
                more = f" (nor for {rows.size - 1} more elements)" if rows.size > 1 else ""
                text = f"element {names.shown(part.ids[rows[0]])}: there is no node {names.shown(node)}{more}"
                findings.add(part.line(int(rows[0])), "undefined-node", text)
        _check_volumes(part, names, findings, names.coordinates[order], place, np.flatnonzero(~missing.any(axis=1)))


def _first(bad: NDArray[np.int64], what: str) -> Iterator[tuple[int, str]]:
    """Yield the first few rows, the last of them with how many more there are."""
    for count, row in enumerate(bad[:MOST].tolist()):
        rest = bad.size - MOST
        yield row, f" (and {rest} more {what})" if count == MOST - 1 and rest > 0 else ""


def _check_volumes(
    part: ElementTable,
    names: Names,
    findings: Findings,
    coordinates: NDArray[np.float64],
    place: NDArray[np.int64],
    whole: NDArray[np.int64],
) -> None:
    """Check the volume of hexahedra and tetrahedra, and the corners of hexahedra."""
    if not whole.size or not (kinds.is_hexahedron(part.kind) or kinds.is_tetrahedron(part.kind)):
        return
    centre, least = np.empty(whole.size), np.empty(whole.size)
    for first in range(0, whole.size, CHUNK):
        some = slice(first, first + CHUNK)
        if kinds.is_tetrahedron(part.kind):
            a, b, c, d = np.moveaxis(coordinates[place[whole[some]][:, :4]], 1, 0)
            with np.errstate(all="ignore"):
                centre[some] = least[some] = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)
        else:
            centre[some], least[some] = _jacobians(coordinates[place[whole[some]][:, :8]])
    for row, more in _first(whole[~(centre > 0.0)], "elements"):
        text = f"element {names.shown(part.ids[row])} is inside out or folded{more}"
        findings.add(part.line(row), "negative-jacobian", text)
    for row, more in _first(whole[(centre > 0.0) & ~(least > 0.0)], "elements"):
        findings.add(part.line(row), "distorted", f"element {names.shown(part.ids[row])} is folded in a corner{more}")


def _jacobians(corners: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the Jacobian determinant at the centre, and the least at the corners, of (m, 8, 3) hexahedra."""
    found = []
    for at in (*CORNERS, np.zeros(3)):
        factor = 1.0 + CORNERS * at
        gradient = 0.125 * np.stack(
            [
                CORNERS[:, 0] * factor[:, 1] * factor[:, 2],
                CORNERS[:, 1] * factor[:, 0] * factor[:, 2],
                CORNERS[:, 2] * factor[:, 0] * factor[:, 1],
            ]
        )
        with np.errstate(all="ignore"):  # absurd coordinates: the determinant is then no number, and is reported
            a, b, c = np.moveaxis(gradient @ corners, 1, 0)
            found.append(np.einsum("ij,ij->i", np.cross(a, b), c))
    return found[-1], np.min(found[:-1], axis=0)


def check_sections(deck: Deck, names: Names, findings: Findings) -> set[str]:
    """Check sections against elements and materials; return the materials that deformable elements use."""
    used: set[str] = set()
    lost = False  # a section whose elements are not known: none is called bare
    covered: list[NDArray[np.int64]] = []
    owner: dict[str, tuple[KeywordBlock, NDArray[np.int64]]] = {}
    bodies = [block.parameters.get("ELSET") or "" for block in deck.named("RIGID BODY")]
    rigid = [names.elsets[name] for name in bodies if name in names.elsets]
    stiff = sorted_labels(np.concatenate(rigid)) if rigid else np.zeros(0, dtype=np.int64)
    for block in deck.blocks:
        elset = block.parameters.get("ELSET")
        if (
            not (block.keyword.endswith("SECTION") or block.keyword == "UEL PROPERTY")
            or block.keyword == "SURFACE SECTION"
        ):
            continue
        _check_section_names(block, names, findings)
        if not elset:
            continue
        if not names.has_elset(elset):
            if block.keyword in SECTION_KEYWORDS:
                lost = True
                findings.add(block, "dangling-elset", f"*{block.keyword}: there is no element set {elset}")
            continue
        ids = names.elsets.get(elset, np.zeros(0, dtype=np.int64))
        covered.append(ids)
        if block.parameters.get("MATERIAL") and not (ids.size and np.isin(ids, stiff).all()):
            used.add(block.parameters["MATERIAL"] or "")
        if block.keyword in SECTION_KEYWORDS:
            for other, before in owner.values():
                both = np.intersect1d(ids, before, assume_unique=True)
                if both.size:
                    element = names.shown(both[0])
                    text = f"element {element} already has a section in line {other.line}"
                    findings.add(block, "two-sections", text)
                    break
            owner[elset] = (block, ids)
    if not lost and not (names.fragment and not covered):
        all_covered = sorted_labels(np.concatenate(covered)) if covered else np.zeros(0, dtype=np.int64)
        _check_bare(names, all_covered, stiff, findings)
    return used


def _check_section_names(block: KeywordBlock, names: Names, findings: Findings) -> None:
    for parameter, kind in (
        ("MATERIAL", "MATERIAL"),
        ("CONTROLS", "SECTION CONTROLS"),
        ("ORIENTATION", "ORIENTATION"),
    ):
        name = block.parameters.get(parameter)
        if name and not names.has(kind, name):
            rule = f"dangling-{parameter.lower()}"
            findings.add(block, rule, f"*{block.keyword}, {parameter}={name}: there is no such *{kind}")


def _check_bare(names: Names, covered: NDArray[np.int64], stiff: NDArray[np.int64], findings: Findings) -> None:
    if names.open_mesh:
        return
    for part in names.elements:
        if not kinds.needs_section(part.kind):
            continue
        bare = np.flatnonzero(~np.isin(part.ids, covered) & ~np.isin(part.ids, stiff))
        if bare.size:
            more = f" (and {bare.size - 1} more)" if bare.size > 1 else ""
            text = f"element {names.shown(part.ids[bare[0]])} has no section{more}"
            findings.add(part.line(int(bare[0])), "no-section", text)
