"""The arrays of `second_order`: a coarser division of a block, solved once for unit motions of face and mount."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from ...study import Block
from ...units import MM
from .body import Body, BodySettings, FreeShape, make_body
from .condense import assemble
from .element import IncompatibleField, lame_constants
from .inputs import NO_FOLD, Fold, SecondOrder
from .kept import Arrays
from .symmetry import element_partners, folds, whole_fold
from .symmetry import gathered as folded_rows

Array = NDArray[np.float64]

PER_HEIGHT, LAYERS, SIPED_LAYERS = 4.0, 4, 6
"""Elements along the block per height, and over the height. A block of 25 x 20 x 8 mm pressed by 0.1 mm stiffens by
2.09 %; a full nonlinear solve says 1.95 % (8 elements a height, falling)."""


def second_order_arrays(block: Block, shape: FreeShape, body: Body, poissons_ratio: float) -> Arrays:
    """Return what `second_order` takes, and ``bend``: gradients per unit displacement of each knot of the mount."""
    coarse = make_body(block, shape, division(block))
    motions, mount = face_motions(coarse, poissons_ratio), mount_motions(coarse, poissons_ratio)
    field = IncompatibleField(coarse.nodes[coarse.elements], poissons_ratio)
    # one point an element: a quarter of the work of eight, for 1 % of T's part
    shapes, volume = field.shape_gradients(np.zeros(3))
    stretch, bend = (gradients(coarse, shapes[:, :8], motion) for motion in (motions, mount))
    stiffness = motions.T @ (assemble(coarse, poissons_ratio) @ motions)
    loads = (stretch.reshape(9, volume.size, -1) * (8.0 * volume)[:, None]).reshape(stretch.shape)
    held = 3 * coarse.on_symmetry_plane[coarse.on_symmetry_plane < coarse.nodes_per_layer] + 2
    loads[:, held] = 0.0
    near, share = neighbours(coarse, body)
    return {
        "gather": gathered(near, share, body.area, coarse.nodes_per_layer).T.astype(np.float32, order="C"),
        **parted(coarse, stretch, -np.linalg.solve(stiffness, loads.T).T, bend @ _knots(coarse.knots, body.knots)),
        "near": near,
        "share": share,
    }


def parted(coarse: Body | None, stretch: Array, spread: Array, bend: Array) -> Arrays:
    """Return the arrays of the even and odd motions of a coarse body, which take half the memory.

    `stretch` (9 e, 3 c) are gradients for unit displacements of its face, `spread` (9 e, 3 c) its face's displacements
    for unit stresses, `bend` (9 e, 2 k) the gradients of the mount's motions. Without a body, or where it is not
    symmetric, all motions are even and no element has an image.
    """
    both = None if coarse is None else folds(coarse)
    if coarse is None or both is None:
        even, odd = whole_fold(stretch.shape[1]), NO_FOLD
        one = image = np.arange(stretch.shape[0] // 9)
        flip = np.zeros(0)
    else:
        even, odd = both
        turn = np.array([-1.0, 1.0, 1.0 if coarse.half else -1.0])
        flip = (turn[:, None] * turn).ravel()
        image = element_partners(coarse)
        one = np.flatnonzero(np.arange(image.size) <= image)
        image = image[one]
    each = [matrix.reshape(9, -1, matrix.shape[1])[:, one].reshape(9 * one.size, -1) for matrix in (stretch, spread)]
    # the stress of an element that is its own image is met twice
    share = np.tile(np.where(one == image, 0.5, 1.0), 9) if flip.size else np.ones(9 * one.size)
    order = np.concatenate([one, image]) if flip.size else one
    return {
        **shorts("gradient", *(folded_rows(each[0].T, fold) for fold in (even, odd))),
        **shorts("spread", *((folded_rows(each[1].T, fold) * share).T for fold in (even, odd))),
        **{
            f"{name}_{part}": getattr(fold, part)
            for name, fold in (("even", even), ("odd", odd))
            for part in fold._fields
        },
        "flip": flip.astype(np.float32),
        "bend": bend.reshape(9, -1, bend.shape[1])[:, order].reshape(9 * order.size, -1).astype(np.float32),
    }


def second_order_of(arrays: Arrays, body: Body, poissons_ratio: float) -> SecondOrder:
    """Return the arrays as the kernels take them."""
    even, odd = (Fold(*(arrays[f"{name}_{part}"] for part in Fold._fields)) for name in ("even", "odd"))
    lame, shear = lame_constants(1.0, poissons_ratio)
    return SecondOrder(
        np.ascontiguousarray(body.face), arrays["gather"], even, odd, arrays["gradient_even"], arrays["gradient_odd"],
        arrays["spread_even"], arrays["spread_odd"], arrays["flip"], arrays["near"], arrays["share"], lame, shear,
        float(arrays["gradient_unit"][0]), float(arrays["spread_unit"][0]),
    )  # fmt: skip


def division(block: Block) -> BodySettings:
    """Return the coarser division of a block."""
    height, half = block.height_mm * MM, 0.5 * block.width_mm * MM
    size = min(height / PER_HEIGHT, block.length_mm * MM / (2.0 * PER_HEIGHT))
    across = max(2, round(0.4 * PER_HEIGHT * half / height))
    return BodySettings(size, SIPED_LAYERS if block.sipes else LAYERS, 1.5, across, 1.5)


def face_motions(body: Body, poissons_ratio: float) -> Array:
    """Return the displacements of all nodes (3 all, 3 n) for unit displacement of each of the face's, mount held."""
    size = 3 * body.nodes_per_layer
    motions = _solved(body, poissons_ratio, np.eye(size), slice(0, size))
    motions[3 * body.on_symmetry_plane + 2] = 0.0
    # a support carries itself, so that the stiffness stays regular
    held = 3 * body.on_symmetry_plane[body.on_symmetry_plane < body.nodes_per_layer] + 2
    motions[held, held] = 1.0
    return motions


def mount_motions(body: Body, poissons_ratio: float) -> Array:
    """Return the displacements of all nodes (3 all, 2 k) for unit displacement of each knot of the mount, face held."""
    return _solved(body, poissons_ratio, body.mount_shapes(), slice(3 * body.nodes_per_layer * body.layers, None))


def gradients(body: Body, shapes: Array, motions: Array) -> Array:
    """Return displacement gradients (9 m, k) at a point of the m elements, component by component, of k motions."""
    nodal = motions.reshape(-1, 3, motions.shape[1])[body.elements]
    found = np.einsum("maik,maj->ijmk", nodal, shapes, optimize=True)
    return np.asarray(found.reshape(-1, motions.shape[1]), dtype=np.float64)


def neighbours(coarse: Body, fine: Body) -> tuple[NDArray[np.int64], Array]:
    """Return the four nodes of a coarse face around each node of a fine one, and their bilinear weights, (n, 4)."""
    columns, lines = _lines(coarse)
    _, along = _lines(fine)
    near, share = np.zeros((fine.along.size, 4), dtype=np.int64), np.zeros((fine.along.size, 4))
    for z, members in along.items():
        k, w = _cell(columns, z)
        for i in members:
            place = fine.along[i] - _middle(fine, members)
            for part, line, weight in ((0, lines[columns[k]], 1.0 - w), (2, lines[columns[k + 1]], w)):
                j, v = _cell(coarse.along[line] - _middle(coarse, line), place)
                near[i, part : part + 2] = line[j : j + 2]
                share[i, part : part + 2] = weight * (1.0 - v), weight * v
    return near, share


def gathered(near: NDArray[np.int64], share: Array, area: Array, count: int) -> Array:
    """Return the (count, n) matrix that fits the coarse nodes to values on the fine face by least squares."""
    spread = np.zeros((area.size, count))
    np.add.at(spread, (np.arange(area.size)[:, None], near), share)
    root = np.sqrt(area)
    return np.asarray(np.linalg.pinv(root[:, None] * spread) * root)


def shorts(name: str, even: Array, odd: Array) -> Arrays:
    """Return two matrices as 16-bit numbers, and their unit."""
    unit = max(float(np.abs(part).max(initial=0.0)) for part in (even, odd)) / 32767.0
    found = {
        f"{name}_{which}": np.round(part / unit).astype(np.int16, order="C")
        for which, part in (("even", even), ("odd", odd))
    }
    return {**found, f"{name}_unit": np.array([unit])}


def _solved(body: Body, poissons_ratio: float, given: Array, where: slice) -> Array:
    """Return the displacements of all nodes where those of some are given, others at rest, the inside free."""
    matrix, n = assemble(body, poissons_ratio), body.nodes_per_layer
    inside = slice(3 * n, 3 * n * body.layers)
    motions = np.zeros((matrix.shape[0], given.shape[1]))
    motions[where] = given
    factor = splu(matrix[inside, inside].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    motions[inside] = factor.solve(-np.asarray(matrix[inside, where] @ given))
    return motions


def _knots(coarse: Array, fine: Array) -> Array:
    """Return the matrix that takes displacements (x, then y) of fine knots to those of coarse ones, linearly."""
    one = np.array([np.interp(coarse, fine, unit) for unit in np.eye(fine.size)]).T
    return np.kron(np.eye(2), one)


def _lines(body: Body) -> tuple[Array, dict[float, NDArray[np.int64]]]:
    """Return the places across a face and the nodes of each line along it, in order."""
    across = np.round(body.face[:, 2], 9)
    places = np.unique(across)
    lines = {}
    for z in places:
        members = np.flatnonzero(across == z)
        lines[float(z)] = members[np.argsort(body.along[members])]
    return places, lines


def _middle(body: Body, line: NDArray[np.int64]) -> float:
    return 0.5 * float(body.along[line[0]] + body.along[line[-1]])


def _cell(places: Array, place: float) -> tuple[int, float]:
    """Return the interval of ascending `places` that holds `place`, and how far along it."""
    k = int(np.clip(np.searchsorted(places, place, side="right") - 1, 0, places.size - 2))
    return k, float(np.clip((place - places[k]) / (places[k + 1] - places[k]), 0.0, 1.0))
