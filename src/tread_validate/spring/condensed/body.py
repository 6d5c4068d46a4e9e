"""The block as a structured body in its own frame.

The frame has its origin on the mount above the middle of the block; x points in the direction of travel, y away from
the road, z across. Nodes come in layers from the face (layer 0) to the mount.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...study import Block
from ...units import DEG, MM

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


@dataclass(frozen=True)
class BodySettings:
    """How finely a body is divided.

    Attributes
    ----------
    face_size : float, m
        Edge of an element along the block.
    layers : int
        Elements over the height.
    refinement : float
        Height of the layer at the mount over that of the layer at the face.
    across : int
        Elements over the half width; 0 makes them as wide as they are long.
    grading : float
        1 spaces the nodes across evenly; more crowds them towards the sides, as 1 - (1 - x)^grading.
    """

    face_size: float = 1.0 * MM
    layers: int = 12
    refinement: float = 1.5
    across: int = 0
    grading: float = 1.0


ON_WHEEL = 1.25
"""How much denser along the block a face on a wheel is: the contact is a part of it, and the negative peak of T is
made at its edge. At 8, 10, 12, 16 a height a parallelogram of 25 x 20 x 8 mm has -9.48, -9.10, -9.00, -9.04 N."""


def fitted(block: Block, density: float = 8.0, layers: int = 12, on_wheel: bool = False) -> BodySettings:
    """Return the division that follows from a block's proportions, so that scaling the block changes nothing.

    Parameters
    ----------
    density : float
        Elements along the block per height of the block, at least two per density over the whole length.
    layers : int
    on_wheel : bool
        The mount is a wheel: `ON_WHEEL` times as many along the block; a parallelogram has fewer across for it.
    """
    length, half, height = block.length_mm * MM, 0.5 * block.width_mm * MM, block.height_mm * MM
    size = min(height / density, 0.5 * length / density) / (ON_WHEEL if on_wheel else 1.0)
    rectangle = block.shape == "rectangle"
    across = (0.5 if rectangle or on_wheel else 0.8) * half / height * density
    return BodySettings(size, layers, 1.5, max(math.ceil(across - 1e-9), 4), 1.5 if rectangle else 1.3)


@dataclass(frozen=True)
class Body:
    """Bricks between a face and a mount; a rectangle is halved by its plane of symmetry z = 0.

    Attributes
    ----------
    nodes : (layers + 1) * n rows of (x, y, z), m
        Stress-free positions in the block's frame, layer by layer, the face first.
    elements : (m, 8) array of int
        Corner nodes in the order of `element.CORNERS` with axes (towards the mount, z, x).
    along : (n,) array, m
        Place of the n nodes of a layer along the face, relative to the middle, positive in the direction of travel.
    area : (n,) array, m2
        Area of the face that each node stands for (of the half block where `half`).
    knots : (k,) array, m
        Places along the block at which the motion of the mount is given.
    half : bool
        Whether only z >= 0 is there.
    mount_along : (n,) array, m
        `along` at the mount: farther out than at the face where the walls have a draft.
    """

    nodes: Array
    elements: Integers
    along: Array
    area: Array
    knots: Array
    layers: int
    half: bool
    mount_along: Array

    @property
    def nodes_per_layer(self) -> int:
        """Number of nodes n in each layer."""
        return self.along.size

    @property
    def face(self) -> Array:
        """Stress-free positions of the face's nodes, (n, 3), m."""
        return self.nodes[: self.nodes_per_layer]

    @cached_property
    def on_symmetry_plane(self) -> Integers:
        """Nodes with z = 0 of a halved body."""
        return np.flatnonzero(np.abs(self.nodes[:, 2]) < 1e-12) if self.half else np.zeros(0, dtype=np.int64)

    @cached_property
    def unused(self) -> Integers:
        """Nodes that belong to no brick (a sipe at the very end of a block leaves some)."""
        return np.setdiff1d(np.arange(self.nodes.shape[0]), self.elements)

    def mount_shapes(self) -> Array:
        """Return the (3 n, 2 k) displacement of the mount's nodes for unit displacement of each knot."""
        n, k = self.mount_along.size, self.knots.size
        cell = np.clip(np.searchsorted(self.knots, self.mount_along, side="right") - 1, 0, k - 2)
        weight = (self.mount_along - self.knots[cell]) / (self.knots[cell + 1] - self.knots[cell])
        shapes = np.zeros((n, 3, 2, k))
        for component in (0, 1):
            shapes[np.arange(n), component, component, cell] = 1.0 - weight
            shapes[np.arange(n), component, component, cell + 1] = weight
        return shapes.reshape(3 * n, 2 * k)


@dataclass(frozen=True)
class FreeShape:
    """Stress-free shape in the rolling direction.

    Attributes
    ----------
    mount_curvature : float, 1/m
        Of the mount, about an axle above the block; 0 is flat.
    flat_face : bool
        Face flat under a curved mount; otherwise it is parallel to the mount.
    mount_ratio : float
        Arc of the mount per arc on which columns are counted (below 1 on a wheel's ring).
    """

    mount_curvature: float = 0.0
    flat_face: bool = False
    mount_ratio: float = 1.0

    def mount_arc(self, along: Array, height: float) -> Array:
        """Return the arc along the mount (m) of the columns at `along` (m); columns stand square on the mount."""
        if self.flat_face and self.mount_curvature > 0.0:
            surface = 1.0 / self.mount_curvature + height
            return np.asarray(np.arctan(along / surface) / self.mount_curvature)
        return along * self.mount_ratio

    def mount(self, along: Array, height: float) -> Array:
        """Return (x, y) of the mount at the columns `along` (m), origin above the middle of the block, (n, 2), m."""
        return _bent(self.mount_arc(along, height), self.mount_curvature)

    def face(self, along: Array, height: float) -> Array:
        """Return (x, y) of the face at the columns `along` (m), (n, 2), m."""
        if self.flat_face or self.mount_curvature == 0.0:
            return np.column_stack([along, np.full(along.size, -height)])
        radius = 1.0 / self.mount_curvature + height
        face = _bent(self.mount_arc(along, height) * self.mount_curvature * radius, 1.0 / radius)
        return np.column_stack([face[:, 0], face[:, 1] - height])


def make_body(block: Block, shape: FreeShape, settings: BodySettings) -> Body:
    """Divide `block` into bricks; a layer ends at the bottom of every sipe.

    Raises `InputError` for a body too coarse to have an inside, and for a block that is a mesh file: this model makes
    its own mesh in layers.
    """
    if block.mesh is not None:
        raise InputError(
            "block", f"mesh file {block.mesh}", "a block given by its dimensions: this model meshes its own"
        )
    size = settings.face_size
    length, width, height = block.length_mm * MM, block.width_mm * MM, block.height_mm * MM
    half = block.shape == "rectangle"
    if settings.layers < 2 or length / size < 2.5 or (not settings.across and width / size < 2.5):
        raise InputError("face size", f"{size / MM:g} mm, {settings.layers} layers", "a mesh with nodes inside")
    distance, opened = _columns(block, size)
    across = _across(width, half, settings)
    level = _levels(block, settings)

    # s grows against travel; the middle of the block is at x = 0
    z, s = (a.ravel() for a in np.meshgrid(across, distance, indexing="ij"))
    along = 0.5 * length - s - z * np.tan(block.skew_deg * DEG)
    order = np.lexsort((z, np.round(along, 12)))  # from the trailing end on, so that contact is a run of nodes
    places, layers = [], []
    for f in level:
        grown = f * height * np.tan(block.draft_deg * DEG)
        wide = z * (1.0 + 2.0 * grown / width)
        place = (0.5 * length - _outward(s, distance, opened, grown) - wide * np.tan(block.skew_deg * DEG))[order]
        face, mount = shape.face(place, height), shape.mount(place, height)
        places.append(place)
        layers.append(np.column_stack([(1.0 - f) * face + f * mount, wide[order]]))
    along, mount_along = places[0], places[-1]
    count, numbers = along.size, np.argsort(order)
    elements = [
        _bricks(numbers[_quads(across, distance, opened < 0.5 * (level[k] + level[k + 1]))[0]] + k * count, count)
        for k in range(settings.layers)
    ]
    quads, quad_area = _quads(across, distance, opened == 0.0)
    area = np.zeros(count)
    np.add.at(area, numbers[quads].ravel(), np.repeat(0.25 * quad_area, 4))
    ends = min(along.min(), mount_along.min()), max(along.max(), mount_along.max())
    knots = np.linspace(*ends, max(3, round((ends[1] - ends[0]) / size) + 1))
    return Body(
        np.concatenate(layers), np.concatenate(elements), along, area, knots, settings.layers, half, mount_along
    )


def _levels(block: Block, settings: BodySettings) -> Array:
    """Return the height fractions of the layers' ends; the one nearest to the depth of a sipe is moved there."""
    ratio = settings.refinement ** (1.0 / (settings.layers - 1))
    level = np.concatenate([[0.0], np.cumsum(ratio ** np.arange(settings.layers))])
    level /= level[-1]
    for depth in sorted({sipe.depth_mm for sipe in block.sipes if sipe.depth_mm is not None}):
        nearest = 1 + int(np.argmin(np.abs(level[1:-1] - depth / block.height_mm)))
        level[nearest] = depth / block.height_mm
    if np.any(np.diff(level) <= 0.0):
        raise InputError("layers", settings.layers, "enough layers to end one at the depth of every sipe")
    return np.asarray(level, dtype=np.float64)


def _outward(s: Array, distance: Array, opened: Array, grown: float) -> Array:
    """Return `s` with the rubber at either end stretched outward by `grown` (m): half the block without sipes."""
    if grown == 0.0:
        return s
    gaps = np.flatnonzero(opened > 0.0)
    low = distance[gaps[0]] if gaps.size else 0.5 * distance[-1]
    high = distance[gaps[-1] + 1] if gaps.size else 0.5 * distance[-1]
    lower = np.clip((low - s) / max(low, 1e-12), 0.0, None)
    upper = np.clip((s - high) / max(distance[-1] - high, 1e-12), 0.0, None)
    return np.asarray(s + grown * (upper - lower), dtype=np.float64)


def _across(width: float, half: bool, settings: BodySettings) -> Array:
    """Return the places of the nodes across the block, m."""
    parts = settings.across or max(2, round(0.5 * width / settings.face_size))
    if not half and not settings.across:
        parts = max(4, round(width / settings.face_size))
        return np.linspace(-0.5 * width, 0.5 * width, parts + 1)
    place = np.linspace(0.0, 1.0, parts + 1)
    place = 0.5 * width * (1.0 - (1.0 - place) ** settings.grading)
    return place if half else np.concatenate([-place[:0:-1], place])


def _columns(block: Block, size: float) -> tuple[Array, Array]:
    """Return the distances of the node columns from the leading end, and up to which height fraction they are open.

    One value a space between columns: 0 rubber, 1 a sipe through the whole height.
    """
    edges, depths = [0.0], []
    for sipe in block.sipes:
        edges += [sipe.position_mm * MM, (sipe.position_mm + sipe.width_mm) * MM]
        depths += [0.0, 1.0 if sipe.depth_mm is None else sipe.depth_mm / block.height_mm]
    edges.append(block.length_mm * MM)
    depths.append(0.0)
    distance, opened = [0.0], []
    for begin, end, depth in zip(edges[:-1], edges[1:], depths, strict=True):
        if end - begin < 1e-9:
            continue
        parts = 1 if depth > 0.0 else max(1, round((end - begin) / size))
        distance += list(begin + (end - begin) * np.arange(1, parts + 1) / parts)
        opened += [depth] * parts
    return np.array(distance), np.array(opened)


def _quads(across: Array, distance: Array, rubber: NDArray[np.bool_]) -> tuple[Integers, Array]:
    """Return the face's quadrilaterals (corners z-, z+ by leading end first) and their areas, sipes left out."""
    grid = np.arange(across.size * distance.size).reshape(across.size, distance.size)
    corners = np.stack([grid[:-1, 1:], grid[:-1, :-1], grid[1:, 1:], grid[1:, :-1]], axis=-1)
    area = np.diff(across)[:, None] * np.diff(distance)
    return corners[:, rubber].reshape(-1, 4), area[:, rubber].ravel()


def _bricks(quads: Integers, count: int) -> Integers:
    """Stack bricks on face quadrilaterals: natural axes are (towards the mount, z, x), x running fastest."""
    return np.hstack([quads, quads + count])


def _bent(arc: Array, curvature: float) -> Array:
    """Return (x, y) of points at arc lengths from the lowest point of a circle with its centre above, (n, 2)."""
    angle = arc * curvature
    return np.column_stack([arc * np.sinc(angle / np.pi), 0.5 * arc * angle * np.sinc(0.5 * angle / np.pi) ** 2])
