"""A block given as a mesh file: hexahedra, checked and put in the block's own coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, one_line
from ..files import read_text
from ..units import IN_MM, MM
from .tread_block import Block

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

MOST_ELEMENTS = 2_000_000

SIZE_TOLERANCE = 1e-3  # of the block's length, width and height
ON_PLANE = 1e-6  # of the height: nodes this close to the face or the mount lie in it
VOLUMES = {"hexahedron"}
IGNORED = {"vertex", "line", "quad", "triangle"}
"""Points, edges and faces that mesh generators write beside the volumes."""
CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], dtype=float
)
TURNED = np.array([
    [0, 1, 2, 3, 4, 5, 6, 7], [4, 7, 6, 5, 0, 3, 2, 1], [0, 4, 5, 1, 3, 7, 6, 2],
    [1, 5, 6, 2, 0, 4, 7, 3], [2, 6, 7, 3, 1, 5, 4, 0], [3, 7, 4, 0, 2, 6, 5, 1],
])  # fmt: skip
"""Corner orders of a hexahedron that put its face S1 .. S6 first, without turning it inside out."""


@dataclass(frozen=True)
class HexMesh:
    """A block of hexahedra.

    Attributes
    ----------
    points : (n, 3) array, mm
        x in the direction of travel, 0 at the foremost node of the face; y away from the road, 0 on the face; z across,
        0 in the middle.
    u : (n,) array
        Height fraction: exactly 0 on the face, exactly 1 at the mount.
    elements : (m, 8) array of int
        Node indices from 0, of positive Jacobian; the first four are the element's face on the road, where it has one.
    """

    points: FloatArray
    u: FloatArray
    elements: IntArray

    @property
    def face_elements(self) -> IntArray:
        """Elements whose first four nodes lie on the face."""
        return np.flatnonzero(np.all(self.u[self.elements[:, :4]] == 0.0, axis=1))


def read_hex_mesh(block: Block, root: Path) -> HexMesh:
    """Read the mesh file of a block: x in the direction of travel, y away from the road, z across.

    The contact face is what lies at the lowest y, the mount what lies at the highest.

    Raises
    ------
    InputError
        A file that meshio cannot read, cells that are no hexahedra, a size that is not the block's (a wrong unit
        shows here), elements turned inside out, no face or no mount.
    """
    assert block.mesh is not None
    where = str(block.mesh)
    points, elements = _read(root / block.mesh, where)
    points *= IN_MM if block.mesh_unit == "m" else 1.0
    used, renumbered = np.unique(elements, return_inverse=True)
    points, elements = points[used], renumbered.reshape(-1, 8).astype(np.int64)
    _check_size(points, block, where)
    least, height = float(points[:, 1].min()), float(np.ptp(points[:, 1]))
    u = (points[:, 1] - least) / height
    u[np.abs(u) < ON_PLANE] = 0.0
    u[np.abs(u - 1.0) < ON_PLANE] = 1.0
    elements = _facing_road(_upright(points, elements, where), u)
    lead = points[u == 0.0, 0].max()
    middle = 0.5 * (points[:, 2].min() + points[:, 2].max())
    mesh = HexMesh(points - np.array([lead, least, middle]), u, elements)
    if not mesh.face_elements.size or np.count_nonzero(u == 1.0) < 4:
        missing = "contact face at the lowest y" if not mesh.face_elements.size else "mount at the highest y"
        raise InputError(where, f"no {missing}", "faces of elements in the planes of the lowest and the highest y")
    return mesh


def _read(path: Path, where: str) -> tuple[FloatArray, IntArray]:
    """Return the points (n, 3) and the hexahedra (m, 8) of a file."""
    import meshio

    if not path.is_file():
        raise InputError(where, "no such file", "a mesh file below the study's folder")
    if path.suffix == ".inp":
        read_text(path)
    try:
        mesh: Any = meshio.read(path)
    except SystemExit:  # meshio's way of saying that it knows no such format
        raise InputError(where, f"format {path.suffix or '(none)'}", "a format that meshio reads") from None
    except Exception as error:  # each of its readers raises kinds of its own for a damaged file
        raise InputError(where, one_line(str(error) or type(error).__name__, 80), "a mesh that meshio reads") from None
    other = sorted({block.type for block in mesh.cells} - VOLUMES - IGNORED)
    if other:
        raise InputError(where, f"cells of type {', '.join(other)}", "hexahedra of eight nodes")
    parts = [np.asarray(block.data, dtype=np.int64) for block in mesh.cells if block.type in VOLUMES]
    if not parts or not sum(part.shape[0] for part in parts):
        raise InputError(where, "no hexahedra", "hexahedra of eight nodes")
    elements = np.concatenate(parts)
    points = np.asarray(mesh.points, dtype=np.float64)
    if elements.shape[0] > MOST_ELEMENTS:
        raise InputError(where, f"{elements.shape[0]} elements", f"at most {MOST_ELEMENTS}")
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all():
        raise InputError(where, f"points of shape {points.shape}", "three finite coordinates a point")
    if elements.min() < 0 or elements.max() >= points.shape[0]:
        raise InputError(where, f"node {elements.max()} of {points.shape[0]}", "nodes that the file has")
    return points.copy(), elements


def _check_size(points: FloatArray, block: Block, where: str) -> None:
    for axis, (name, given) in enumerate(
        (("length_mm", block.length_mm), ("height_mm", block.height_mm), ("width_mm", block.width_mm))
    ):
        size = float(np.ptp(points[:, axis]))
        if abs(size - given) <= SIZE_TOLERANCE * given:
            continue
        hint = ""
        if 0.9 < IN_MM * size / given < 1.1:
            hint = "; is the file in metres (mesh_unit: m)?"
        elif 0.9 < MM * size / given < 1.1:
            hint = "; is the file in mm (mesh_unit: mm)?"
        raise InputError(where, f"{size:g} mm along {'xyz'[axis]}", f"the block's {name}, {given:g}{hint}")


def _upright(points: FloatArray, elements: IntArray, where: str) -> IntArray:
    """Return elements of positive Jacobian; a file that numbers all of them the other way round is turned."""
    least, most = _jacobians(points[elements])
    if np.all(most < 0.0):
        elements = elements[:, [4, 5, 6, 7, 0, 1, 2, 3]]
        least = -most
    bad = np.flatnonzero(least <= 0.0)
    if bad.size:
        more = f" (and {bad.size - 1} more)" if bad.size > 1 else ""
        raise InputError(where, f"element {bad[0]}{more} folded or inside out", "a positive Jacobian in every corner")
    return elements


def _jacobians(corners: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the least and the largest Jacobian determinant over the corners of (m, 8, 3) hexahedra."""
    least, most = np.full(corners.shape[0], np.inf), np.full(corners.shape[0], -np.inf)
    for at in CORNERS:
        factor = 1.0 + CORNERS * at
        gradient = 0.125 * np.stack(
            [
                CORNERS[:, 0] * factor[:, 1] * factor[:, 2],
                CORNERS[:, 1] * factor[:, 0] * factor[:, 2],
                CORNERS[:, 2] * factor[:, 0] * factor[:, 1],
            ]
        )
        determinant = np.linalg.det(gradient @ corners)
        least, most = np.minimum(least, determinant), np.maximum(most, determinant)
    return least, most


def _facing_road(elements: IntArray, u: FloatArray) -> IntArray:
    """Renumber the corners of elements on the face so that their face S1 lies on it."""
    turned = elements.copy()
    for order in TURNED[1:]:
        on_face = np.all(u[elements[:, order[:4]]] == 0.0, axis=1)
        turned[on_face] = elements[on_face][:, order]
    return turned
