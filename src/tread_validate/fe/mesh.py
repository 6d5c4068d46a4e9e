"""Nodes, elements, sets and surfaces of a deck as index arrays."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import Block, DataLine
from .rigid_surface import RigidSurface, read_rigid_surface

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]

# Faces of a hexahedron in the language's order; the right-hand normal of each points into the element.
FACES = np.array([[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]])


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
    """

    node_labels: Ints
    coordinates: Floats
    element_labels: Ints
    connectivity: Ints
    node_sets: dict[str, Ints] = field(default_factory=dict)
    element_sets: dict[str, Ints] = field(default_factory=dict)
    faces: dict[str, Ints] = field(default_factory=dict)
    rigid_surfaces: dict[str, RigidSurface] = field(default_factory=dict)

    def nodes_of(self, text: str, line: DataLine | Block) -> Ints:
        """Return node indices of a set name or a node label."""
        return _members(text, self.node_sets, self.node_labels, line.where, "node")

    def elements_of(self, text: str, line: DataLine | Block) -> Ints:
        """Return element indices of a set name or an element label."""
        return _members(text, self.element_sets, self.element_labels, line.where, "element")


def read_mesh(blocks: list[Block]) -> Mesh:
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
        raise InputError(blocks[0].file if blocks else "deck", f"no {missing}", "a mesh of C3D8R elements")
    labels, coordinates = _nodes(node_blocks)
    element_labels, connectivity = _elements(element_blocks, labels)
    mesh = Mesh(labels, coordinates, element_labels, connectivity)
    start = 0
    for block in node_blocks:
        if block.parameters.get("NSET"):
            own = np.array([line.integer_at(0, "a node label") for line in block.data], dtype=np.int64)
            _extend(mesh.node_sets, block.value("NSET"), _index(own, labels, block.where, "node"))
    for block in element_blocks:
        count = len(_joined(block))
        if block.parameters.get("ELSET"):
            own = np.array([int(row[0][0]) for row in _joined(block)], dtype=np.int64)
            _extend(mesh.element_sets, block.value("ELSET"), _index(own, element_labels, block.where, "element"))
        start += count
    for block in blocks:
        if block.keyword == "NSET":
            _extend(mesh.node_sets, block.value("NSET"), _set(block, mesh.node_sets, labels, "node"))
        elif block.keyword == "ELSET":
            _extend(mesh.element_sets, block.value("ELSET"), _set(block, mesh.element_sets, element_labels, "element"))
        elif block.keyword == "SURFACE":
            _surface(block, mesh)
    return mesh


def _nodes(blocks: list[Block]) -> tuple[Ints, Floats]:
    labels: list[int] = []
    rows: list[tuple[float, float, float]] = []
    for block in blocks:
        for line in block.data:
            labels.append(line.integer_at(0, "a node label"))
            x, y, z = (line.number_at(i, "a coordinate", 0.0) for i in (1, 2, 3))
            rows.append((x, y, z))
            if len(line.fields) > 4:
                raise InputError(line.where, f"{len(line.fields)} fields", "label, x, y, z")
    array = np.array(labels, dtype=np.int64)
    order = np.argsort(array, kind="stable")
    array = array[order]
    twice = np.flatnonzero(np.diff(array) == 0)
    if twice.size:
        raise InputError(blocks[0].where, f"node {array[twice[0]]} twice", "each node once")
    return array, np.array(rows, dtype=np.float64)[order]


def _joined(block: Block) -> list[tuple[tuple[str, ...], str]]:
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


def _elements(blocks: list[Block], labels: Ints) -> tuple[Ints, Ints]:
    table: list[list[int]] = []
    for block in blocks:
        for fields, where in _joined(block):
            if len(fields) != 9:
                raise InputError(where, f"{len(fields)} fields", "an element label and 8 nodes")
            try:
                table.append([int(text) for text in fields])
            except ValueError:
                raise InputError(where, ", ".join(fields), "9 integers") from None
    if not table:
        raise InputError(blocks[0].where, "no element", "at least one C3D8R")
    array = np.array(table, dtype=np.int64)
    array = array[np.argsort(array[:, 0], kind="stable")]
    twice = np.flatnonzero(np.diff(array[:, 0]) == 0)
    if twice.size:
        raise InputError(blocks[0].where, f"element {array[twice[0], 0]} twice", "each element once")
    return array[:, 0], _index(array[:, 1:].ravel(), labels, blocks[0].where, "node").reshape(-1, 8)


def _index(wanted: Ints, labels: Ints, where: str, what: str) -> Ints:
    """Return positions of `wanted` labels in the sorted `labels`."""
    at = np.searchsorted(labels, wanted)
    at = np.minimum(at, labels.size - 1)
    bad = np.flatnonzero(labels[at] != wanted)
    if bad.size:
        raise InputError(where, f"{what} {wanted[bad[0]]}", f"a {what} that exists")
    return np.asarray(at, dtype=np.int64)


def _members(text: str, sets: dict[str, Ints], labels: Ints, where: str, what: str) -> Ints:
    name = text.strip('"') if text.startswith('"') else text.upper()
    if name in sets:
        return sets[name]
    try:
        label = int(text)
    except ValueError:
        raise InputError(where, f"{what} set {text}", f"a {what} set or label that exists") from None
    return _index(np.array([label], dtype=np.int64), labels, where, what)


def _set(block: Block, sets: dict[str, Ints], labels: Ints, what: str) -> Ints:
    parts: list[Ints] = []
    for line in block.data:
        if "GENERATE" in block.parameters:
            first = line.integer_at(0, "first label")
            last = line.integer_at(1, "last label", first)
            step = line.integer_at(2, "increment", 1)
            if step < 1 or last < first or (last - first) % step:
                raise InputError(line.where, line.text, "first, last, increment with last = first + k increment")
            if (last - first) // step >= labels.size:
                raise InputError(line.where, line.text[:40], f"at most {labels.size} labels, as many as there are")
            parts.append(_index(np.arange(first, last + 1, step, dtype=np.int64), labels, line.where, what))
        else:
            parts += [_members(text, sets, labels, line.where, what) for text in line.fields if text]
    return np.concatenate(parts) if parts else np.zeros(0, dtype=np.int64)


def _extend(sets: dict[str, Ints], name: str, members: Ints) -> None:
    old = sets.get(name, np.zeros(0, dtype=np.int64))
    sets[name] = np.unique(np.concatenate([old, members]))


def _surface(block: Block, mesh: Mesh) -> None:
    name = block.value("NAME")
    if name in mesh.faces or name in mesh.rigid_surfaces:
        raise InputError(block.where, f"surface {name} twice", "each surface once")
    if block.parameters.get("TYPE") == "CYLINDER":
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
