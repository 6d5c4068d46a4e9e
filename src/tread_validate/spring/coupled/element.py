"""Stiffness of eight-node bricks with incompatible modes, for any isotropic linear elastic solid.

Trilinear bricks alone are several per cent too stiff in a block bonded at its mount, with or without reduced
integration of the volume; the nine internal modes of Wilson and Taylor cure that. Modes after R.L. Taylor,
P.J. Beresford, E.L. Wilson, Int. J. Numer. Meth. Eng. 10 (1976) 1211-1219, doi:10.1002/nme.1620100602: their gradients
use the Jacobian at the centre, so that the patch test holds for any shape.
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CORNERS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
"""Natural coordinates of the eight nodes, (8, 3): the last one runs fastest."""

GAUSS = CORNERS / np.sqrt(3.0)


class IncompatibleField:
    """Shape functions and internal modes of m bricks.

    Parameters
    ----------
    nodes : (m, 8, 3) array, m
        Positions of the nodes in the order of `CORNERS`; every Jacobian must be positive.
    poissons_ratio : float, 0..0.5 exclusive
    """

    def __init__(self, nodes: Array, poissons_ratio: float) -> None:
        lame, shear = lame_constants(1.0, poissons_ratio)
        centre = _jacobian(nodes, np.zeros(3))
        self._nodes = nodes
        self._centre_inverse, self._centre_det = np.linalg.inv(centre), np.linalg.det(centre)
        blocks = np.zeros((nodes.shape[0], 33, 33))
        for point in GAUSS:
            gradients, det = self.shape_gradients(point)
            blocks += _isotropic(gradients, lame, shear) * det[:, None, None]
        self._outer, self._cross = blocks[:, :24, :24], blocks[:, :24, 24:]
        self._inner = blocks[:, 24:, 24:]
        self._inner_solved = np.linalg.solve(self._inner, np.swapaxes(self._cross, 1, 2))

    def stiffness(self) -> Array:
        """Return the (m, 24, 24) stiffness in m, per Pa of Young's modulus; degrees of freedom (node, component)."""
        return np.asarray(self._outer - self._cross @ self._inner_solved, dtype=np.float64)

    def amplitudes(self, displacement: Array) -> Array:
        """Return the amplitudes of the internal modes, (m, 3, 3), that go with nodal displacements (m, 8, 3)."""
        flat = displacement.reshape(-1, 24, 1)
        return np.asarray(-(self._inner_solved @ flat).reshape(-1, 3, 3), dtype=np.float64)

    def gradient(self, displacement: Array, amplitudes: Array, point: Array) -> tuple[Array, Array]:
        """Return the displacement gradient du_i/dx_j (m, 3, 3) at a Gauss point, and its volume (m,) in m3."""
        gradients, det = self.shape_gradients(point)
        both = np.concatenate([displacement, amplitudes], axis=1)
        return np.asarray(np.einsum("mni,mnj->mij", both, gradients), dtype=np.float64), det

    def relax_modes(self, residual: Array) -> Array:
        """Return the change of the internal modes, (m, 3, 3), that a residual (m, 3, 3) on them asks for."""
        solved = np.linalg.solve(self._inner, residual.reshape(-1, 9, 1))
        return np.asarray(solved.reshape(-1, 3, 3), dtype=np.float64)

    def shape_gradients(self, point: Array) -> tuple[Array, Array]:
        """Return the gradients of the 8 shape functions and 3 modes (m, 11, 3), 1/m, and the volumes (m,), m3."""
        jacobian = _jacobian(self._nodes, point)
        det = np.linalg.det(jacobian)
        shapes = np.einsum("ni,mij->mnj", shape_derivatives(point), np.linalg.inv(jacobian))
        bubbles = np.einsum("ni,mij->mnj", np.diag(-2.0 * point), self._centre_inverse)
        return np.concatenate([shapes, bubbles * (self._centre_det / det)[:, None, None]], axis=1), det


def lame_constants(youngs_modulus: float, poissons_ratio: float) -> tuple[float, float]:
    """Return (lambda, G) in the unit of `youngs_modulus`."""
    shear = youngs_modulus / (2.0 * (1.0 + poissons_ratio))
    return 2.0 * shear * poissons_ratio / (1.0 - 2.0 * poissons_ratio), shear


def shape_derivatives(point: Array) -> Array:
    """Return the derivatives of the eight trilinear shape functions at a natural point, (8, 3)."""
    factors = 1.0 + CORNERS * point
    return np.column_stack([CORNERS[:, i] * factors[:, i - 1] * factors[:, i - 2] for i in range(3)]) / 8.0


def _jacobian(nodes: Array, point: Array) -> Array:
    return np.asarray(np.einsum("mna,ni->mai", nodes, shape_derivatives(point)), dtype=np.float64)


def _isotropic(gradients: Array, lame: float, shear: float) -> Array:
    """Return the (m, 3n, 3n) integrand lambda div div + 2 G eps:eps of n shape functions with `gradients` (m, n, 3)."""
    m, n, _ = gradients.shape
    outer = np.einsum("mai,mbj->maibj", gradients, gradients)
    result = lame * outer + shear * np.swapaxes(outer, 2, 4)
    laplace = shear * np.einsum("mai,mbi->mab", gradients, gradients)
    for i in range(3):
        result[:, :, i, :, i] += laplace
    return np.asarray(result.reshape(m, 3 * n, 3 * n))
