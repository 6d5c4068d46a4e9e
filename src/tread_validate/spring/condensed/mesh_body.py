"""A block given as a mesh file, as a body: its own hexahedra, bent on to the mount as every block is."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...errors import InputError
from ...geometry.mesh_file import HexMesh, read_hex_mesh
from ...study import Block, Case
from ...units import MM
from .body import Array, Body, FreeShape, Integers
from .element import shape_values

MOST_ELEMENTS, MOST_FACE_NODES = 12_000, 2_000
"""Beyond these the dense face and the mesh of half the size that corrects it no longer fit in a few gigabytes."""
TO_CORNERS = np.array([0, 4, 3, 7, 1, 5, 2, 6])
"""Place, in a file's element, of each of the eight corners in the order of `element.CORNERS`."""


@dataclass(frozen=True)
class MeshFile:
    """The mesh file of a block, as what is kept of it is named.

    Attributes
    ----------
    root : Path
        Folder that the block's file name refers to.
    sha256 : str
        Of the file.
    """

    root: Path
    sha256: str


def mesh_file_of(case: Case) -> MeshFile | None:
    """Return the mesh file of a case's block; None for a block given by its dimensions."""
    if case.block.mesh is None:
        return None
    path = case.root / case.block.mesh
    try:
        return MeshFile(case.root, hashlib.sha256(path.read_bytes()).hexdigest())
    except OSError:
        raise InputError(case.block.mesh, "no such file", "a mesh file below the study's folder") from None


def hexahedra(block: Block, file: MeshFile) -> HexMesh:
    """Read the file; `InputError` for one that is no block or too fine for a dense face."""
    mesh = read_hex_mesh(block, file.root)
    face = int(np.count_nonzero(mesh.u == 0.0))
    if mesh.elements.shape[0] > MOST_ELEMENTS or face > MOST_FACE_NODES:
        found = f"{mesh.elements.shape[0]} elements, {face} nodes on the face"
        raise InputError(
            str(block.mesh), found, f"at most {MOST_ELEMENTS} and {MOST_FACE_NODES} for the model condensed"
        )
    return mesh


def body_of_mesh(block: Block, shape: FreeShape, mesh: HexMesh) -> Body:
    """Return the body: face nodes first, in order along the block, then the inside, then the mount."""
    length, height = block.length_mm * MM, block.height_mm * MM
    place = 0.5 * length + mesh.points[:, 0] * MM
    across = mesh.points[:, 2] * MM
    f = mesh.u[:, None]
    rank = np.where(mesh.u == 0.0, 0, np.where(mesh.u == 1.0, 2, 1))
    order = np.lexsort((across, np.round(place, 12), rank))
    number = np.argsort(order)
    nodes = np.column_stack([(1.0 - f) * shape.face(place, height) + f * shape.mount(place, height), across])
    quads = mesh.elements[mesh.face_elements][:, :4]
    flat = np.column_stack([place, across])[quads]
    one, other = flat[:, 2] - flat[:, 0], flat[:, 3] - flat[:, 1]
    area = np.zeros(place.size)
    np.add.at(area, quads.ravel(), np.repeat(0.125 * np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]), 4))
    along, mount_along = (np.sort(place[mesh.u == u]) for u in (0.0, 1.0))
    ends = min(along[0], mount_along[0]), max(along[-1], mount_along[-1])
    size = float(np.mean(np.ptp(flat[:, :, 0], axis=1)))
    knots = np.linspace(*ends, max(3, round((ends[1] - ends[0]) / size) + 1))
    elements = number[mesh.elements][:, TO_CORNERS]
    return Body(
        nodes[order], elements, place[order][: along.size], area[order][: along.size], knots, 0, False,
        place[order][-mount_along.size :],
    )  # fmt: skip


def halved(mesh: HexMesh) -> HexMesh:
    """Return the mesh with every hexahedron cut into eight."""
    points = np.column_stack([mesh.points, mesh.u])
    lattice = np.array([[i, j, k] for i in (-1.0, 0.0, 1.0) for j in (-1.0, 0.0, 1.0) for k in (-1.0, 0.0, 1.0)])
    values = np.array([shape_values(at) for at in lattice])  # (27, 8)
    corners = mesh.elements[:, TO_CORNERS]
    # a point of the lattice is known by the corners that it lies between: neighbours share it
    key = np.full((*corners.shape[:1], 27, 8), -1, dtype=np.int64)
    for k, row in enumerate(values):
        own = np.sort(corners[:, row > 0.0], axis=1)
        key[:, k, : own.shape[1]] = own
    _, first, inverse = np.unique(key.reshape(-1, 8), axis=0, return_index=True, return_inverse=True)
    every = np.einsum("kc,mcd->mkd", values, points[corners]).reshape(-1, 4)
    found = every[first]
    found[np.abs(found[:, 3]) < 1e-12, 3] = 0.0
    found[np.abs(found[:, 3] - 1.0) < 1e-12, 3] = 1.0
    grid = inverse.reshape(-1, 3, 3, 3)
    back = np.argsort(TO_CORNERS)
    parts = [
        np.stack([grid[:, i + a, j + b, k + c] for a in (0, 1) for b in (0, 1) for c in (0, 1)], axis=1)[:, back]
        for i in (0, 1) for j in (0, 1) for k in (0, 1)
    ]  # fmt: skip
    elements: Integers = np.concatenate(parts)
    return HexMesh(np.ascontiguousarray(found[:, :3]), np.ascontiguousarray(found[:, 3]), elements)


def face_grid(body: Body, spacing: float) -> tuple[Integers, Array, int]:
    """Return the four nodes around each face node in a rectangular grid over the face, their weights, and their count.

    Nodes of the grid that carry nothing are left out.
    """
    cells, weights, counts = [], [], []
    for values in (body.face[:, 2], body.along):
        count = max(2, round(float(np.ptp(values)) / spacing) + 1)
        at = (values - values.min()) / float(np.ptp(values)) * (count - 1)
        cell = np.clip(at.astype(np.int64), 0, count - 2)
        cells.append(cell)
        weights.append(at - cell)
        counts.append(count)
    (i, j), (v, w) = cells, weights
    near = np.stack([(i + a) * counts[1] + j + b for a in (0, 1) for b in (0, 1)], axis=1)
    share = np.stack([(v if a else 1.0 - v) * (w if b else 1.0 - w) for a in (0, 1) for b in (0, 1)], axis=1)
    share[share < 1e-12] = 0.0
    used = np.unique(near[share > 0.0])
    near = np.clip(np.searchsorted(used, near), 0, used.size - 1)
    return near, share, int(used.size)


def cells_of(body: Body, spacing: float) -> Integers:
    """Return the cell of a rectangular grid in which each element's middle lies, (m,), from 0 without gaps."""
    middle = body.nodes[body.elements].mean(axis=1)
    parts = np.maximum(np.round(np.ptp(body.nodes, axis=0) / spacing), 2).astype(np.int64)
    least = body.nodes.min(axis=0)
    cell = np.clip(((middle - least) / np.ptp(body.nodes, axis=0) * parts).astype(np.int64), 0, parts - 1)
    flat = (cell[:, 0] * parts[1] + cell[:, 1]) * parts[2] + cell[:, 2]
    return np.unique(flat, return_inverse=True)[1].ravel()
