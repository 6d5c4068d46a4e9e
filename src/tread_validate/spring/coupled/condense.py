"""The stiffness of a block as its contact face feels it: all nodes inside eliminated, layer by layer.

The elastic problem is solved once, for Young's modulus 1 Pa. With a constant Poisson's ratio every modulus relaxes
alike, so the viscoelastic block is this matrix times one scalar relaxation (correspondence principle).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse import coo_array, csr_array, diags_array

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
    diagonal, towards_mount = _layers(body, poissons_ratio)
    last = len(diagonal) - 1
    # the mount's layer moves as its knots say: its motion loads the layer below it
    load = np.asarray(-(towards_mount[last] @ body.mount_shapes()))
    matrix = diagonal[last].toarray()
    for k in range(last, 0, -1):
        factor = cho_factor(matrix, lower=True, overwrite_a=True, check_finite=False)
        coupling = towards_mount[k - 1]  # rows of layer k - 1, columns of layer k
        right = np.hstack([coupling.T.toarray(), load])
        solved = cho_solve(factor, right, overwrite_b=True, check_finite=False)
        size = coupling.shape[0]
        matrix = diagonal[k - 1].toarray() - coupling @ solved[:, :size]
        load = -(coupling @ solved[:, size:])
    matrix = 0.5 * (matrix + matrix.T)
    return FaceStiffness(matrix, cho_solve(cho_factor(matrix), load))


def _layers(body: Body, poissons_ratio: float) -> tuple[list[csr_array], list[csr_array]]:
    """Return the blocks K[k, k] and K[k, k + 1] of the node layers below the mount, k = 0 on the face."""
    whole = assemble(body, poissons_ratio)
    step = 3 * body.nodes_per_layer
    diagonal, above = [], []
    for k in range(body.layers):
        own, next_ = slice(k * step, (k + 1) * step), slice((k + 1) * step, (k + 2) * step)
        diagonal.append(csr_array(whole[own, own]))
        above.append(csr_array(whole[own, next_]))
    return diagonal, above


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
