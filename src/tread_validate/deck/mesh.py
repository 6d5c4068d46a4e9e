"""The structured hexahedral mesh of a block, in coordinates that belong to the block alone.

A node is named by its distance `s` behind the leading corner (along the contact face), its height fraction `u`
(0 on the contact face, 1 at the mount) and its place `z` across the block. Where these lie in space is the business
of `placement`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..study import Block, DeckSettings

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

MOST_ELEMENTS = 2_000_000


@dataclass(frozen=True)
class BlockMesh:
    """Eight-node hexahedra that fill the block; sipes are gaps without elements.

    Attributes
    ----------
    s : (n,) array, mm
        Distance behind the first corner to touch, measured along the contact face; 0 .. length + skew.
    u : (n,) array
        Height fraction: 0 on the contact face, 1 at the mount.
    z : (n,) array, mm
        Place across the block, -width/2 .. width/2.
    elements : (m, 8) array of int
        Node indices from 0; the first four are the element's face towards the road, counter-clockwise seen from
        inside the element.
    face_nodes, mount_nodes : arrays of int
        Node indices on the contact face and at the mount.
    face_elements : array of int
        Elements whose face 1 lies on the contact face.
    """

    s: FloatArray
    u: FloatArray
    z: FloatArray
    elements: IntArray
    face_nodes: IntArray
    mount_nodes: IntArray
    face_elements: IntArray

    @property
    def span(self) -> float:
        """Extent of the face in the rolling direction, mm."""
        return float(self.s.max())


@lru_cache(maxsize=32)
def block_mesh(block: Block, settings: DeckSettings) -> BlockMesh:
    """Mesh `block` with elements of `settings.element_size_mm`, graded towards the contact face.

    Each stretch of rubber between sipes gets a whole number of columns of its own. Cached: the cases of a study
    share a few meshes. Raises `InputError` for more than two million elements.
    """
    size = settings.element_size_mm
    rows = sum(_parts(end - begin, size) for begin, end in rubber_stretches(block))
    count = rows * _parts(block.width_mm, size) * settings.layers
    if count > MOST_ELEMENTS:
        raise InputError("deck.element_size_mm", f"{size:g} ({count} elements)", f"at most {MOST_ELEMENTS} elements")
    heights = layer_fractions(settings.layers, settings.refinement)
    across = np.linspace(-0.5, 0.5, _parts(block.width_mm, settings.element_size_mm) + 1) * block.width_mm
    node_parts: list[tuple[FloatArray, FloatArray, FloatArray]] = []
    element_parts: list[IntArray] = []
    first = 0
    for begin, end in rubber_stretches(block):
        along = np.linspace(begin, end, _parts(end - begin, settings.element_size_mm) + 1)
        shape = (heights.size, along.size, across.size)
        u, s, z = (array.ravel() for array in np.meshgrid(heights, along, across, indexing="ij"))
        node_parts.append((s + skew_offset(block, z), u, z))
        element_parts.append(_bricks(shape) + first)
        first += s.size
    s, u, z = (np.concatenate([part[i] for part in node_parts]) for i in range(3))
    elements = np.concatenate(element_parts)
    on_face = np.flatnonzero(u == 0.0)
    return BlockMesh(
        s=s,
        u=u,
        z=z,
        elements=elements,
        face_nodes=on_face,
        mount_nodes=np.flatnonzero(u == 1.0),
        face_elements=np.flatnonzero(np.all(u[elements[:, :4]] == 0.0, axis=1)),
    )


def layer_fractions(layers: int, refinement: float) -> FloatArray:
    """Return the (layers + 1,) height fractions of the node layers, 0 on the face to 1 at the mount.

    Layer heights form a geometric series; the one at the mount is `refinement` times the one on the face.
    """
    ratio = refinement ** (1.0 / (layers - 1))
    fractions = np.concatenate([[0.0], np.cumsum(ratio ** np.arange(layers))])
    fractions /= fractions[-1]
    fractions[-1] = 1.0
    return fractions


def rubber_stretches(block: Block) -> list[tuple[float, float]]:
    """Return the stretches of rubber along the block, mm from the leading edge, that the sipes leave."""
    edges = [0.0]
    for sipe in block.sipes:
        edges += [sipe.position_mm, sipe.position_mm + sipe.width_mm]
    edges.append(block.length_mm)
    return [(begin, end) for begin, end in zip(edges[::2], edges[1::2], strict=True) if end - begin > 1e-9]


def skew_offset(block: Block, z: FloatArray) -> FloatArray:
    """Return how far a parallelogram's edge lies behind its first corner at `z` (mm); 0 for a rectangle."""
    slope = math.tan(math.radians(block.skew_deg))
    return 0.5 * block.width_mm * abs(slope) + z * slope


def _parts(length: float, size: float) -> int:
    return max(1, round(length / size))


def _bricks(shape: tuple[int, int, int]) -> IntArray:
    """Number the hexahedra of a (layer, along, across) grid of nodes.

    `s` grows against travel, so that going across (z) and then along (s) turns clockwise seen from above; the order
    z, then back along -s gives a positive Jacobian with the face towards the road first.
    """
    grid = np.arange(math.prod(shape), dtype=np.int64).reshape(shape)
    low, high = grid[:-1], grid[1:]
    corners = []
    for layer in (low, high):
        corners += [layer[:, 1:, :-1], layer[:, 1:, 1:], layer[:, :-1, 1:], layer[:, :-1, :-1]]
    return np.stack(corners, axis=-1).reshape(-1, 8)
