"""Even and odd motions of a symmetric body, which do not load each other.

A rectangle looks the same in the mirror x -> -x, a parallelogram turned by half a turn about y. Two problems of half
the size take a quarter of the work, and half the memory.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .body import Body
from .inputs import Fold, Integers, Singles

Array = NDArray[np.float64]


def folds(body: Body) -> tuple[Fold, Fold] | None:
    """Return the even and the odd motions of a layer; None where the body has no such symmetry (sipes)."""
    partner = partners(body)
    if partner is None:
        return None
    sign = np.array([-1.0, 1.0, 1.0 if body.half else -1.0])
    node = np.flatnonzero(np.arange(partner.size) <= partner)
    left, right = ((3 * each[:, None] + np.arange(3)).ravel() for each in (node, partner[node]))
    own = np.where(left == right, 0.5, np.sqrt(0.5))
    even, odd = (own * np.tile(parity * sign, node.size) for parity in (1.0, -1.0))
    # a node that is its own image moves in one of the two only
    keep = [(left != right) | (other > 0.0) for other in (even, odd)]
    first, second = (Fold(left[k], right[k], own[k], other[k]) for k, other in zip(keep, (even, odd), strict=True))
    return first, second


def image_of(even: Fold, odd: Fold) -> tuple[Integers, Singles]:
    """Return where the symmetry takes each degree of freedom of a layer, (3 n,), and with which sign."""
    size = even.left.size + odd.left.size
    place, sign = np.arange(size), np.ones(size, dtype=np.float32)
    place[even.left], place[even.right] = even.right, even.left
    sign[even.left] = sign[even.right] = np.sign(even.other)
    sign[odd.left[odd.left == odd.right]] = -1.0
    return place, sign


def partners(body: Body) -> Integers | None:
    """Return the mirror image of each node of a layer; None where the body is not symmetric."""
    if body.layers == 0:  # a mesh file: no layers, and symmetry by chance alone
        return None
    turn = np.array([-1.0, 1.0, 1.0 if body.half else -1.0])
    face = np.round(body.nodes[: body.nodes_per_layer] / 1e-9)
    order, mirrored = np.lexsort(face.T), np.lexsort((face * turn).T)
    partner = np.empty(face.shape[0], dtype=np.int64)
    partner[order] = mirrored
    whole = _whole(body, partner)
    same = np.allclose(body.nodes[whole], body.nodes * turn, rtol=0.0, atol=2e-9)
    same = same and np.array_equal(_sorted(body.elements), _sorted(whole[body.elements]))
    return partner if same else None


def element_partners(body: Body) -> Integers:
    """Return the mirror image of each element of a symmetric body."""
    partner = partners(body)
    assert partner is not None
    mirrored = np.sort(_whole(body, partner)[body.elements], axis=1)
    image = np.empty(body.elements.shape[0], dtype=np.int64)
    image[np.lexsort(mirrored.T)] = np.lexsort(np.sort(body.elements, axis=1).T)
    return image


def _whole(body: Body, partner: Integers) -> Integers:
    """Return the mirror image of every node of a body."""
    return np.asarray((np.arange(body.layers + 1)[:, None] * partner.size + partner).ravel(), dtype=np.int64)


def whole_fold(size: int) -> Fold:
    """Return the fold of a layer of `size` degrees of freedom without symmetry: each moves by itself."""
    each, half = np.arange(size), np.full(size, 0.5)
    return Fold(each, each, half, half)


def gathered(vectors: Array, fold: Fold) -> Array:
    """Return the part (k, m) of vectors (3 n, m) that belongs to a fold's motions."""
    return np.asarray(fold.own[:, None] * vectors[fold.left] + fold.other[:, None] * vectors[fold.right])


def spread(part: Array, fold: Fold, matrix: Array) -> None:
    """Add to a symmetric matrix (3 n, 3 n) its part (k, k) that belongs to a fold's motions."""
    a, b = part * fold.own, part * fold.other
    for rows, left in ((fold.left, fold.own), (fold.right, fold.other)):
        matrix[np.ix_(rows, fold.left)] += left[:, None] * a
        matrix[np.ix_(rows, fold.right)] += left[:, None] * b


def folded(matrix: Array, fold: Fold) -> Array:
    """Return the part (k, k) of a symmetric matrix (3 n, 3 n) that belongs to a fold's motions."""
    half = fold.own[:, None] * matrix[fold.left] + fold.other[:, None] * matrix[fold.right]
    return np.asarray(half[:, fold.left] * fold.own + half[:, fold.right] * fold.other)


def _sorted(bricks: NDArray[np.int64]) -> NDArray[np.int64]:
    rows = np.sort(bricks, axis=1)
    return rows[np.lexsort(rows.T)]
