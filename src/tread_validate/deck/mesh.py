"""The structured hexahedral mesh of a block, or the one of its mesh file."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..geometry.mesh_file import MOST_ELEMENTS, read_hex_mesh
from ..study import Block, DeckSettings
from .block_mesh import BlockMesh, FloatArray, IntArray, finished


@lru_cache(maxsize=32)
def block_mesh(block: Block, settings: DeckSettings, root: Path | None = None) -> BlockMesh:
    """Mesh `block` with elements of `settings.element_size_mm`, longer or shorter in the direction of travel by
    `settings.element_length_ratio`, graded towards the contact face.

    Each stretch of rubber between sipes gets a whole number of columns of its own; a block with a mesh file of its own
    (relative to `root`) is what the file says. Cached: the cases of a study share a few meshes.

    Raises
    ------
    InputError
        More than two million elements, half of a block without a plane of symmetry, or a mesh file that is no block.
    """
    half = _is_halved(block, settings)
    if block.mesh is not None:
        own = read_hex_mesh(block, root if root is not None else Path())
        return finished(-own.points[:, 0], own.u, own.points[:, 2], own.elements)
    heights = _heights(block, settings)
    parts = _parts(block.width_mm, settings.element_size_mm)
    across = np.linspace(-0.5, 0.5, parts + 1) * block.width_mm
    if half:
        across = np.linspace(0.0, 0.5, (parts + 1) // 2 + 1) * block.width_mm
    if any(sipe.depth_mm is not None for sipe in block.sipes):
        mesh = _with_blind_sipes(block, settings, heights, across)
    else:
        mesh = _of_stretches(block, settings, heights, across)
    if block.draft_deg:
        mesh = _drafted(mesh, block)
    return replace(mesh, symmetry_nodes=np.flatnonzero(mesh.z == 0.0)) if half else mesh


def _is_halved(block: Block, settings: DeckSettings) -> bool:
    """Whether the mesh is that of z >= 0 alone; `InputError` where half is asked of a block without that plane."""
    if settings.symmetry == "full":
        return False
    symmetric = block.shape == "rectangle" and block.mesh is None
    if settings.symmetry == "half" and not symmetric:
        found = "a mesh file" if block.mesh is not None else f"a {block.shape}"
        raise InputError("deck.symmetry", f"half of {found}", "a rectangle, which z = 0 halves")
    return symmetric


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
    """Return the stretches of rubber along the face, mm from the leading edge, that the sipes leave."""
    edges = [0.0]
    for sipe in block.sipes:
        edges += [sipe.position_mm, sipe.position_mm + sipe.width_mm]
    edges.append(block.length_mm)
    return [(begin, end) for begin, end in zip(edges[::2], edges[1::2], strict=True) if end - begin > 1e-9]


def skew_offset(block: Block, z: FloatArray) -> FloatArray:
    """Return how far a parallelogram's edge lies behind its first corner at `z` (mm); 0 for a rectangle."""
    slope = math.tan(math.radians(block.skew_deg))
    return 0.5 * block.width_mm * abs(slope) + z * slope


def _heights(block: Block, settings: DeckSettings) -> FloatArray:
    """Return the height fractions of the node layers; a layer ends at the bottom of every sipe.

    The layer boundary nearest to a sipe's depth is moved there.
    """
    heights = layer_fractions(settings.layers, settings.refinement)
    for depth in sorted({sipe.depth_mm for sipe in block.sipes if sipe.depth_mm is not None}):
        fraction = depth / block.height_mm
        inside = np.arange(1, heights.size - 1)
        nearest = int(inside[np.argmin(np.abs(heights[inside] - fraction))])
        heights[nearest] = fraction
        if np.any(np.diff(heights) < 1e-3):
            raise InputError(
                "deck.layers", settings.layers, f"enough layers to end one at a sipe's depth of {depth:g} mm"
            )
    return heights


def _counted(columns: int, across: int, layers: int, settings: DeckSettings) -> None:
    count = columns * across * layers
    if count > MOST_ELEMENTS:
        size = settings.element_size_mm
        raise InputError("deck.element_size_mm", f"{size:g} ({count} elements)", f"at most {MOST_ELEMENTS} elements")


def _of_stretches(block: Block, settings: DeckSettings, heights: FloatArray, across: FloatArray) -> BlockMesh:
    """Mesh a block whose sipes, if any, go all the way through: one grid for each stretch of rubber."""
    size = settings.element_size_mm * settings.element_length_ratio
    stretches = rubber_stretches(block)
    columns = sum(_parts(end - begin, size) for begin, end in stretches)
    _counted(columns, across.size - 1, heights.size - 1, settings)
    node_parts: list[tuple[FloatArray, FloatArray, FloatArray]] = []
    element_parts: list[IntArray] = []
    first = 0
    for begin, end in stretches:
        along = np.linspace(begin, end, _parts(end - begin, size) + 1)
        u, s, z = (array.ravel() for array in np.meshgrid(heights, along, across, indexing="ij"))
        node_parts.append((s + skew_offset(block, z), u, z))
        element_parts.append(_bricks((heights.size, along.size, across.size)) + first)
        first += s.size
    s, u, z = (np.concatenate([part[i] for part in node_parts]) for i in range(3))
    return finished(s, u, z, np.concatenate(element_parts))


def _with_blind_sipes(block: Block, settings: DeckSettings, heights: FloatArray, across: FloatArray) -> BlockMesh:
    """Mesh a block some of whose sipes end below the mount: one grid, with the elements inside the sipes left out."""
    size = settings.element_size_mm * settings.element_length_ratio
    along, gap_depth = [0.0], []
    edges = [(0.0, 0.0)]  # where a stretch ends, and how deep it is open (height fraction)
    for sipe in block.sipes:
        depth = 1.0 if sipe.depth_mm is None else sipe.depth_mm / block.height_mm
        edges += [(sipe.position_mm, 0.0), (sipe.position_mm + sipe.width_mm, depth)]
    edges.append((block.length_mm, 0.0))
    for (begin, _), (end, depth) in pairwise(edges):
        if end - begin < 1e-9:
            continue
        parts = _parts(end - begin, size)
        along += np.linspace(begin, end, parts + 1)[1:].tolist()
        gap_depth += [depth] * parts
    _counted(len(gap_depth), across.size - 1, heights.size - 1, settings)
    u, s, z = (array.ravel() for array in np.meshgrid(heights, np.array(along), across, indexing="ij"))
    elements = _bricks((heights.size, len(along), across.size)).reshape(heights.size - 1, -1, across.size - 1, 8)
    middle = 0.5 * (heights[1:] + heights[:-1])
    kept = elements[middle[:, None] > np.array(gap_depth)[None, :]].reshape(-1, 8)
    used, renumbered = np.unique(kept, return_inverse=True)
    s, u, z = s[used], u[used], z[used]
    return finished(s + skew_offset(block, z), u, z, renumbered.reshape(-1, 8).astype(np.int64))


def _drafted(mesh: BlockMesh, block: Block) -> BlockMesh:
    """Lean the four outer walls outward from the face to the mount; sipes keep their walls.

    Along the block, the stretch of rubber at either end (half the block without sipes) widens; across it, everything.
    """
    grown = block.height_mm * math.tan(math.radians(block.draft_deg)) * mesh.u
    along = mesh.s - skew_offset(block, mesh.z)
    stretches = rubber_stretches(block)
    single = len(stretches) == 1 and not block.sipes
    low = 0.5 * block.length_mm if single else stretches[0][1]
    high = 0.5 * block.length_mm if single else stretches[-1][0]
    moved = along - np.clip((low - along) / low, 0.0, None) * grown
    moved += np.clip((along - high) / (block.length_mm - high), 0.0, None) * grown
    z = mesh.z * (1.0 + 2.0 * grown / block.width_mm)
    return replace(mesh, s=moved + skew_offset(block, z), z=z)


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
