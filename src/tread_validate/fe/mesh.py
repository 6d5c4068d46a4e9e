"""Nodes, elements, sets and surfaces of a deck as index arrays."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import DataLine, KeywordBlock, label
from ..inp.deck import LARGEST_LABEL
from ..inp.sets import Sets, is_label
from ..inp.table import integer_rows, number_table
from .rigid_surface import RigidSurface, read_rigid_surface

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

# Faces of a hexahedron in the language's order; the right-hand normal of each points into the element.
FACES = np.array([[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]])


NODE_LINE = "a node label and x, y, z"


@dataclass
class Mesh:
    """The mesh of a deck.

    Attributes
    ----------
    node_labels : (n,) int
    coordinates : (n, 3)
    element_labels : (m,) int
    connectivity : (m, 8) int
        Node indices, the language's order.
    node_sets, element_sets : dict of name to index array
        Sorted, each index once.
    faces : dict of surface name to (k, 4) int
        Node indices of element-based surfaces, right-hand normal into the body.
    rigid_surfaces : dict of surface name to `RigidSurface`
    full : (m,) bool
        Whether an element is integrated fully (C3D8) or at one point (C3D8R).
    """

    node_labels: Ints
    coordinates: Floats
    element_labels: Ints
    connectivity: Ints
    full: NDArray[np.bool_]
    node_sets: dict[str, Ints] = field(default_factory=dict)
    element_sets: dict[str, Ints] = field(default_factory=dict)
    faces: dict[str, Ints] = field(default_factory=dict)
    rigid_surfaces: dict[str, RigidSurface] = field(default_factory=dict)

    def nodes_of(self, text: str, line: DataLine | KeywordBlock) -> Ints:
        """Return node indices of a set name or a node label."""
        return _members(text, self.node_sets, self.node_labels, line.where, "node")

    def elements_of(self, text: str, line: DataLine | KeywordBlock) -> Ints:
        """Return element indices of a set name or an element label."""
        return _members(text, self.element_sets, self.element_labels, line.where, "element")


def read_mesh(blocks: list[KeywordBlock]) -> Mesh:
    """Read NODE, ELEMENT, NSET, ELSET and SURFACE blocks.

    Raises
    ------
    InputError
        A label twice, an unknown label or set, no elements.
    """
    node_blocks = [b for b in blocks if b.keyword == "NODE"]
    element_blocks = [b for b in blocks if b.keyword == "ELEMENT"]
    if not node_blocks or not element_blocks:
        missing = "*ELEMENT" if node_blocks else "*NODE"
        raise InputError(blocks[0].file if blocks else "deck", f"no {missing}", "a mesh of C3D8R or C3D8 elements")
    labels, coordinates = _nodes(node_blocks)
    element_labels, connectivity, full = _elements(element_blocks, labels)
    mesh = Mesh(labels, coordinates, element_labels, connectivity, full)
    sets = Sets(labels, element_labels, lambda members: _nodes_of(members, mesh))
    for block in node_blocks:
        if block.parameters.get("NSET"):
            sets.extend("node", block.value("NSET"), number_table(block.data, 4, NODE_LINE)[:, 0].astype(np.int64))
    for block in element_blocks:
        if block.parameters.get("ELSET"):
            sets.extend("element", block.value("ELSET"), _element_rows(block)[:, 0])
    sets.read(blocks)
    mesh.node_sets = {name: np.searchsorted(labels, members) for name, members in sets.nodes.items()}
    mesh.element_sets = {name: np.searchsorted(element_labels, members) for name, members in sets.elements.items()}
    for block in blocks:
        if block.keyword == "SURFACE":
            _surface(block, mesh)
    return mesh


def _nodes_of(elements: Ints, mesh: Mesh) -> Ints:
    """Return the labels of the nodes of element labels."""
    at = np.searchsorted(mesh.element_labels, elements)
    return np.unique(mesh.node_labels[mesh.connectivity[at]])


def _nodes(blocks: list[KeywordBlock]) -> tuple[Ints, Floats]:
    table = np.concatenate([number_table(block.data, 4, NODE_LINE) for block in blocks])
    array = table[:, 0].astype(np.int64)
    order = np.argsort(array, kind="stable")
    array = array[order]
    twice = np.flatnonzero(np.diff(array) == 0)
    if twice.size:
        raise InputError(blocks[0].where, f"node {array[twice[0]]} twice", "each node once")
    return array, np.ascontiguousarray(table[order, 1:])


def _joined(block: KeywordBlock) -> list[tuple[tuple[str, ...], str]]:
    """Join element lines that end with a comma to the next one."""
    rows: list[tuple[tuple[str, ...], str]] = []
    held: tuple[str, ...] = ()
    where = ""
    for line in block.data:
        where = where if held else line.where
        held += line.fields
        if line.text.rstrip().endswith(","):
            continue
        rows.append((held, where))
        held = ()
    if held:
        rows.append((held, where))
    return rows


def _element_rows(block: KeywordBlock) -> Ints:
    """Return label and nodes of each element of a block, (m, 9)."""
    rows = integer_rows(block.data, 9)
    if rows is not None:
        return rows
    table: list[list[int]] = []
    for fields, where in _joined(block):
        if len(fields) != 9:
            raise InputError(where, f"{len(fields)} fields", "an element label and 8 nodes")
        try:
            table.append([int(text) for text in fields])
        except ValueError:
            raise InputError(where, ", ".join(fields), "9 integers") from None
        if max(map(abs, table[-1])) > LARGEST_LABEL:
            raise InputError(where, max(table[-1]), f"labels of at most {LARGEST_LABEL}")
    return np.array(table, dtype=np.int64).reshape(-1, 9)


def _elements(blocks: list[KeywordBlock], labels: Ints) -> tuple[Ints, Ints, NDArray[np.bool_]]:
    rows = [_element_rows(block) for block in blocks]
    array = np.concatenate(rows)
    if not array.size:
        raise InputError(blocks[0].where, "no element", "at least one C3D8R or C3D8")
    order = np.argsort(array[:, 0], kind="stable")
    full = np.repeat([block.value("TYPE") == "C3D8" for block in blocks], [len(own) for own in rows])[order]
    array = array[order]
    twice = np.flatnonzero(np.diff(array[:, 0]) == 0)
    if twice.size:
        raise InputError(blocks[0].where, f"element {array[twice[0], 0]} twice", "each element once")
    return array[:, 0], _index(array[:, 1:].ravel(), labels, blocks[0].where, "node").reshape(-1, 8), full


def _index(wanted: Ints, labels: Ints, where: str, what: str) -> Ints:
    """Return positions of `wanted` labels in the sorted `labels`."""
    at = np.searchsorted(labels, wanted)
    at = np.minimum(at, labels.size - 1)
    bad = np.flatnonzero(labels[at] != wanted)
    if bad.size:
        raise InputError(where, f"{what} {wanted[bad[0]]}", f"a {what} that exists")
    return np.asarray(at, dtype=np.int64)


def _members(text: str, sets: dict[str, Ints], labels: Ints, where: str, what: str) -> Ints:
    name = label(text)
    if name in sets:
        return sets[name]
    if not is_label(name):
        raise InputError(where, f"{what} set {text}", f"a {what} set or label that exists")
    return _index(np.array([int(name)], dtype=np.int64), labels, where, what)


def _surface(block: KeywordBlock, mesh: Mesh) -> None:
    name = block.value("NAME")
    if name in mesh.faces or name in mesh.rigid_surfaces:
        raise InputError(block.where, f"surface {name} twice", "each surface once")
    if block.parameters.get("TYPE") in ("CYLINDER", "REVOLUTION"):
        mesh.rigid_surfaces[name] = read_rigid_surface(block)
        return
    parts: list[Ints] = []
    for line in block.data:
        fields = line.fields
        face = fields[1].upper() if len(fields) == 2 else ""
        if face not in ("S1", "S2", "S3", "S4", "S5", "S6"):
            raise InputError(line.where, line.text, "element set, S1 to S6")
        elements = mesh.elements_of(fields[0], line)
        parts.append(mesh.connectivity[elements][:, FACES[int(face[1]) - 1]])
    if not parts or not sum(len(part) for part in parts):
        raise InputError(block.where, f"surface {name} without faces", "at least one face")
    mesh.faces[name] = np.ascontiguousarray(np.concatenate(parts))
