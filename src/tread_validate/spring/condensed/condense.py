"""The stiffness of a block as its contact face feels it: all nodes inside eliminated, layer by layer.

The elastic problem is solved once, for Young's modulus 1 Pa. With a constant Poisson's ratio every modulus relaxes
alike, so the viscoelastic block is this matrix times one scalar relaxation (correspondence principle).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve, cholesky
from scipy.linalg.blas import dsyrk, dtrsm
from scipy.sparse import coo_array, csr_array, diags_array, eye_array, kron

from ...errors import InputError
from .body import Body
from .element import IncompatibleField

Array = NDArray[np.float64]


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
    """

    stiffness: Array
    follow: Array


def condense(body: Body, poissons_ratio: float) -> FaceStiffness:
    """Eliminate the inside of `body` from the mount towards the face (block Cholesky of a block-tridiagonal matrix).

    Raises `InputError` for a Poisson's ratio outside 0..0.5.
    """
    if not 0.0 <= poissons_ratio < 0.5:
        raise InputError("Poisson's ratio", poissons_ratio, "0 or more and less than 0.5")
    whole = assemble(body, poissons_ratio)
    size, below = 3 * body.nodes_per_layer, 3 * body.nodes_per_layer * body.layers
    # the mount's layer moves as its knots say: its motion loads the layer below it
    load = np.asarray(-(whole[below - size : below, below:] @ body.mount_shapes()))
    matrix, pushed = np.zeros((size, size)), np.zeros(load.shape)
    for basis in parities(body):
        bases = kron(eye_array(body.layers), basis, format="csr")
        diagonal, towards_mount = _layers(csr_array(bases.T @ whole[:below, :below] @ bases), body.layers)
        part, moved = _eliminate(diagonal, towards_mount, np.asarray(basis.T @ load))
        matrix += basis @ (basis @ part).T
        pushed += basis @ moved
    matrix = 0.5 * (matrix + matrix.T)
    return FaceStiffness(matrix, cho_solve(cho_factor(matrix), pushed))


def _eliminate(diagonal: list[Array], towards_mount: list[Array], load: Array) -> tuple[Array, Array]:
    """Return what is left on the first layer of a block-tridiagonal matrix and of a load on its last layer."""
    matrix = diagonal[-1]
    for inner, coupling in zip(diagonal[-2::-1], towards_mount[::-1], strict=True):
        factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
        half = dtrsm(1.0, factor, coupling.T, lower=1)
        load = -half.T @ dtrsm(1.0, factor, load, lower=1)
        # the lower triangle alone is kept
        matrix = dsyrk(-1.0, half, beta=1.0, c=np.asfortranarray(inner), trans=1, lower=1, overwrite_c=1)
    return np.asarray(np.tril(matrix) + np.tril(matrix, -1).T), load


def parities(body: Body) -> list[csr_array]:
    """Return orthonormal bases (3 n, k) of motions of a layer that the body's symmetry keeps apart.

    A rectangle looks the same in the mirror x -> -x, a parallelogram turned by half a turn about y; even and odd
    motions then do not load each other, and two problems of half the size take a quarter of the work. One basis, the
    identity, where the body has no such symmetry (sipes).
    """
    n = body.nodes_per_layer
    identity = csr_array(eye_array(3 * n))
    partner = _partners(body)
    if partner is None:
        return [identity]
    sign = np.array([-1.0, 1.0, 1.0 if body.half else -1.0])
    bases = []
    for parity in (1.0, -1.0):
        rows, columns, values, count = [], [], [], 0
        for i in range(n):
            j = int(partner[i])
            for c in range(3):
                factor = parity * sign[c]
                if j < i or (j == i and factor < 0.0):
                    continue
                share = 1.0 if j == i else np.sqrt(0.5)
                rows += [3 * i + c] if j == i else [3 * i + c, 3 * j + c]
                columns += [count] if j == i else [count, count]
                values += [share] if j == i else [share, factor * share]
                count += 1
        bases.append(csr_array(coo_array((values, (rows, columns)), shape=(3 * n, count))))
    return bases


def _partners(body: Body) -> NDArray[np.int64] | None:
    """Return the mirror image of each node of a layer; None where the body is not symmetric."""
    turn = np.array([-1.0, 1.0, 1.0 if body.half else -1.0])
    face = np.round(body.nodes[: body.nodes_per_layer] / 1e-9)
    order, mirrored = np.lexsort(face.T), np.lexsort((face * turn).T)
    partner = np.empty(face.shape[0], dtype=np.int64)
    partner[order] = mirrored
    whole = (np.arange(body.layers + 1)[:, None] * face.shape[0] + partner).ravel()
    same = np.allclose(body.nodes[whole], body.nodes * turn, rtol=0.0, atol=2e-9)
    same = same and np.array_equal(_sorted(body.elements), _sorted(whole[body.elements]))
    return partner if same else None


def _sorted(bricks: NDArray[np.int64]) -> NDArray[np.int64]:
    rows = np.sort(bricks, axis=1)
    return rows[np.lexsort(rows.T)]


def _layers(whole: csr_array, layers: int) -> tuple[list[Array], list[Array]]:
    """Return the blocks K[k, k] and K[k, k + 1] of the node layers below the mount, k = 0 on the face."""
    step = whole.shape[0] // layers
    cuts = [slice(k * step, (k + 1) * step) for k in range(layers)]
    diagonal = [whole[own, own].toarray() for own in cuts]
    return diagonal, [whole[own, above].toarray() for own, above in pairwise(cuts)]


def assemble(body: Body, poissons_ratio: float) -> csr_array:
    """Return the stiffness of the whole body in m, per Pa of Young's modulus, with a support on the plane of symmetry.

    Supported degrees of freedom have a 1 on the diagonal and nothing else.
    """
    element = IncompatibleField(body.nodes[body.elements], poissons_ratio).stiffness()
    dofs = (3 * body.elements[:, :, None] + np.arange(3)).reshape(body.elements.shape[0], 24)
    size = 3 * body.nodes.shape[0]
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    whole = csr_array(coo_array((element.ravel(), (rows, columns)), shape=(size, size)))
    held = np.zeros(size)
    held[3 * body.on_symmetry_plane + 2] = 1.0
    held[(3 * body.unused[:, None] + np.arange(3)).ravel()] = 1.0
    free, fixed = diags_array(1.0 - held), diags_array(held)
    return csr_array(free @ whole @ free + fixed)
