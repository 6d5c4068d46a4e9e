"""The stiffness of a block as its contact face feels it: all nodes inside eliminated, layer by layer.

The elastic problem is solved once, for Young's modulus 1 Pa. With a constant Poisson's ratio every modulus relaxes
alike, so the viscoelastic block is this matrix times one scalar relaxation (correspondence principle).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cholesky
from scipy.linalg.blas import dtrsm
from scipy.sparse import coo_array, csr_array, diags_array

from ...errors import InputError
from .body import Body
from .element import IncompatibleField
from .inputs import Fold
from .symmetry import element_partners, folds, gathered, spread, whole_fold

Array = NDArray[np.float64]

PARTS = 5
"""Blocks of an elimination along the block."""


@dataclass(frozen=True)
class FaceStiffness:
    """Force on the contact face = stiffness @ (face displacement - follow @ mount displacement), times E.

    Attributes
    ----------
    stiffness : (3 n, 3 n) array, N/m per Pa
        Symmetric, positive definite; degrees of freedom (node, component), components x, y, z of the block's frame.
        On the plane of symmetry the z row and column are those of a support (identity).
    follow : (3 n, 2 k) array
        Displacement of the unloaded face for unit displacement (x, then y) of each of the k knots of the mount.
    compliance : (3 n, 3 n) array, Pa m/N
        Inverse of the stiffness.
    """

    stiffness: Array
    follow: Array
    compliance: Array


def condense(body: Body, poissons_ratio: float) -> FaceStiffness:
    """Eliminate the inside of `body` from the mount towards the face (block Cholesky of a block-tridiagonal matrix).

    Raises `InputError` for a Poisson's ratio outside 0..0.5.
    """
    if not 0.0 <= poissons_ratio < 0.5:
        raise InputError("Poisson's ratio", poissons_ratio, "0 or more and less than 0.5")
    both, some, size = folds(body), body.elements, 3 * body.nodes_per_layer
    weight = np.ones(some.shape[0])
    if both is not None:  # an element and its image do the same in an even or odd motion
        image = element_partners(body)
        one = np.flatnonzero(np.arange(image.size) <= image)
        some, weight = some[one], np.where(image[one] == one, 1.0, 2.0)
    element = IncompatibleField(body.nodes[some], poissons_ratio).stiffness() * weight[:, None, None]
    load = _mount_load(body, poissons_ratio)
    matrix, compliance, follow = np.zeros((size, size)), np.zeros((size, size)), np.zeros(load.shape)
    for fold in both or (whole_fold(size),):
        diagonal, towards_mount, reach = _layers(body, some, element, fold)
        part, pushed = _eliminate(diagonal, towards_mount, reach, gathered(load, fold))
        spread(part, fold, matrix)
        answer = inverse(part)
        spread(answer, fold, compliance)
        moved = answer @ pushed
        follow[fold.left] += fold.own[:, None] * moved
        follow[fold.right] += fold.other[:, None] * moved
    return FaceStiffness(matrix, follow, compliance)


def _eliminate(diagonal: list[Array], towards_mount: list[Array], reach: int, load: Array) -> tuple[Array, Array]:
    """Return what is left on the first layer of a block-tridiagonal matrix and of a load on its last layer.

    Nodes are in order along the block and couple with those within `reach` only, so that factor^-1 coupling^T is zero
    above a band: block by block, more than half of the work falls away. Overwrites `diagonal`.
    """
    size = load.shape[0]
    width = max(-(-size // PARTS), reach)
    cuts = [(k, min(k + width, size)) for k in range(0, size, width)]
    matrix, half, rest = diagonal[-1].T, np.zeros((size, size)), np.empty(load.shape)
    for inner, coupling in zip(diagonal[-2::-1], towards_mount[::-1], strict=True):
        factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
        for begin, end in cuts:
            right = min(end + width, size)
            found = coupling[:right, begin:end].T - factor[begin:end, :begin] @ half[:begin, :right]
            half[begin:end, :right] = dtrsm(1.0, factor[begin:end, begin:end], found, lower=1)
            rest[begin:end] = load[begin:end] - factor[begin:end, :begin] @ rest[:begin]
            rest[begin:end] = dtrsm(1.0, factor[begin:end, begin:end], rest[begin:end], lower=1)
        matrix, load = inner.T, -half.T @ rest
        for begin, end in cuts:  # the lower triangle alone is kept
            first = max(begin - width, 0)
            matrix[begin:end, :end] -= half[first:, begin:end].T @ half[first:, :end]
    return np.asarray(np.tril(matrix) + np.tril(matrix, -1).T), load


def _mount_load(body: Body, poissons_ratio: float) -> Array:
    """Return the load (3 n, 2 k) on the layer below the mount when each knot of the mount moves by 1."""
    last = np.all(body.elements[:, 4:] >= body.nodes_per_layer * body.layers, axis=1)
    element = IncompatibleField(body.nodes[body.elements[last]], poissons_ratio).stiffness()
    inner, outer = (dofs_of(body.elements[last, part]) for part in (slice(0, 4), slice(4, 8)))
    shapes = body.mount_shapes()[outer - 3 * body.nodes_per_layer * body.layers]
    load = np.zeros((3 * body.nodes_per_layer, shapes.shape[2]))
    np.add.at(load, inner - 3 * body.nodes_per_layer * (body.layers - 1), -(element[:, :12, 12:] @ shapes))
    load[held_dofs(body)[-2 * load.shape[0] : -load.shape[0]]] = 0.0
    return load


def _layers(body: Body, some: NDArray[np.int64], element: Array, fold: Fold) -> tuple[list[Array], list[Array], int]:
    """Return the blocks K[k, k] and K[k, k + 1] of the node layers below the mount, k = 0 on the face, for a fold,
    and how far apart two numbers are at most that couple; `element` are the stiffnesses of the bricks `some` (m, 8).

    Supported degrees of freedom have a 1 on the diagonal and nothing else.
    """
    size, layers, n = fold.left.size, body.layers, 3 * body.nodes_per_layer
    place, share = np.zeros(n, dtype=np.int64), np.zeros(n)
    order = np.arange(size)
    place[fold.left], place[fold.right] = order, order
    np.add.at(share, fold.left, fold.own)
    np.add.at(share, fold.right, fold.other)
    held = held_dofs(body).reshape(layers + 1, n)
    dofs = dofs_of(some)
    at, layer = place[dofs % n], some[:, 0] // body.nodes_per_layer
    weight = np.where(held.ravel()[dofs], 0.0, share[dofs % n])
    scaled = element * weight[:, :, None] * weight[:, None, :]
    rows, near, far = at * size, slice(0, 12), slice(12, 24)

    def block(*parts: tuple[NDArray[np.bool_], slice, slice]) -> Array:
        """Add up parts (bricks, rows, columns) of the bricks' matrices."""
        where = [(rows[mine, a, None] + at[mine, None, b]).ravel() for mine, a, b in parts]
        values = [scaled[mine, a, b].ravel() for mine, a, b in parts]
        found = np.bincount(np.concatenate(where), np.concatenate(values), size * size)
        return np.asarray(found.reshape(size, size), dtype=np.float64)

    diagonal, towards_mount = [], []
    for k in range(layers):
        mine, above = layer == k, layer == k - 1
        own = block((mine, near, near), (above, far, far))
        fixed = np.flatnonzero(held[k][fold.left])
        own[fixed, fixed] = 1.0
        diagonal.append(own)
        if k + 1 < layers:
            towards_mount.append(block((mine, near, far)))
    return diagonal, towards_mount, int(np.max(at.max(axis=1) - at.min(axis=1)))


def inverse(matrix: Array) -> Array:
    """Return the inverse of a symmetric positive definite matrix."""
    from scipy.linalg.lapack import dpotrf, dpotri

    factor, fault = dpotrf(matrix, lower=1)
    assert fault == 0
    lower, fault = dpotri(factor, lower=1, overwrite_c=1)
    assert fault == 0
    upper = np.triu(lower.T, 1)  # above the diagonal LAPACK left what it had found there
    return np.asarray(np.tril(lower) + upper)


def dofs_of(nodes: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the degrees of freedom (m, 3 a) of the nodes (m, a)."""
    return (3 * nodes[:, :, None] + np.arange(3)).reshape(nodes.shape[0], -1)


def held_dofs(body: Body) -> NDArray[np.bool_]:
    """Return which degrees of freedom carry a support: on the plane of symmetry, and of nodes without a brick."""
    held = np.zeros(3 * body.nodes.shape[0], dtype=bool)
    held[3 * body.on_symmetry_plane + 2] = True
    held[(3 * body.unused[:, None] + np.arange(3)).ravel()] = True
    return held


def assemble(body: Body, poissons_ratio: float, some: slice = slice(None)) -> csr_array:
    """Return the stiffness of the whole body in m, per Pa of Young's modulus, with a support on the plane of symmetry.

    `some` are the elements that count. Supported degrees of freedom have a 1 on the diagonal and nothing else.
    """
    element = IncompatibleField(body.nodes[body.elements[some]], poissons_ratio).stiffness()
    dofs = dofs_of(body.elements[some])
    size = 3 * body.nodes.shape[0]
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    whole = csr_array(coo_array((element.ravel(), (rows, columns)), shape=(size, size)))
    held = held_dofs(body).astype(np.float64)
    free, fixed = diags_array(1.0 - held), diags_array(held)
    return csr_array(free @ whole @ free + fixed)
