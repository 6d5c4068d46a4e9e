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
TOGETHER = 128


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
        self._centre_inverse, self._centre_det = _inverse(centre)
        self.at_points = [self.shape_gradients(point) for point in GAUSS]
        # few elements at a time stay in the processor's cache
        parts = [
            _products(
                np.stack([gradients[k : k + TOGETHER] for gradients, _ in self.at_points], axis=1),
                np.stack([det[k : k + TOGETHER] for _, det in self.at_points], axis=1),
                lame,
                shear,
            )
            for k in range(0, nodes.shape[0], TOGETHER)
        ]
        self._inner_solved, self._inner, self._stiffness = (np.concatenate(each) for each in zip(*parts, strict=True))

    def stiffness(self) -> Array:
        """Return the (m, 24, 24) stiffness in m, per Pa of Young's modulus; degrees of freedom (node, component)."""
        return self._stiffness

    def amplitudes(self, displacement: Array) -> Array:
        """Return the amplitudes of the internal modes, (m, 3, 3), that go with nodal displacements (m, 8, 3)."""
        flat = displacement.reshape(-1, 24, 1)
        return np.asarray(-(self._inner_solved @ flat).reshape(-1, 3, 3), dtype=np.float64)

    def gradient(self, displacement: Array, amplitudes: Array, point: int) -> tuple[Array, Array]:
        """Return the displacement gradient du_i/dx_j (m, 3, 3) at one of the Gauss points, and its volume (m,), m3."""
        gradients, det = self.at_points[point]
        both = np.concatenate([displacement, amplitudes], axis=1)
        return np.asarray(np.swapaxes(both, 1, 2) @ gradients, dtype=np.float64), det

    def shape_gradients(self, point: Array) -> tuple[Array, Array]:
        """Return the gradients of the 8 shape functions and 3 modes (m, 11, 3), 1/m, and the volumes (m,), m3."""
        jacobian = _jacobian(self._nodes, point)
        inverse, det = _inverse(jacobian)
        shapes = shape_derivatives(point) @ inverse
        bubbles = np.diag(-2.0 * point) @ self._centre_inverse
        return np.concatenate([shapes, bubbles * (self._centre_det / det)[:, None, None]], axis=1), det


def lame_constants(youngs_modulus: float, poissons_ratio: float) -> tuple[float, float]:
    """Return (lambda, G) in the unit of `youngs_modulus`."""
    shear = youngs_modulus / (2.0 * (1.0 + poissons_ratio))
    return 2.0 * shear * poissons_ratio / (1.0 - 2.0 * poissons_ratio), shear


def shape_values(point: Array) -> Array:
    """Return the eight trilinear shape functions at a natural point, (8,)."""
    return np.asarray(np.prod(1.0 + CORNERS * point, axis=1) / 8.0, dtype=np.float64)


def shape_derivatives(point: Array) -> Array:
    """Return the derivatives of the eight trilinear shape functions at a natural point, (8, 3)."""
    factors = 1.0 + CORNERS * point
    return np.column_stack([CORNERS[:, i] * factors[:, i - 1] * factors[:, i - 2] for i in range(3)]) / 8.0


def _jacobian(nodes: Array, point: Array) -> Array:
    return np.asarray(np.swapaxes(nodes, 1, 2) @ shape_derivatives(point), dtype=np.float64)


def _products(gradients: Array, det: Array, lame: float, shear: float) -> tuple[Array, Array, Array]:
    """Return what m elements' internal modes do with unit nodal displacements (m, 9, 24), their stiffness, and the
    element's when they are free.

    From `gradients` (m, 8, 11, 3) and volumes (m, 8) at the Gauss points: with H_aibj = int g_ai g_bj the stiffness of
    all shape functions is lame H_aibj + shear (H_ajbi + delta_ij H_akbk).
    """
    m = det.shape[0]
    flat = gradients.reshape(m, 8, 33)
    product = (np.swapaxes(flat * det[:, :, None], 1, 2) @ flat).reshape(m, 11, 3, 11, 3)
    whole = lame * product
    whole += shear * np.swapaxes(product, 2, 4)
    trace = shear * (product[:, :, 0, :, 0] + product[:, :, 1, :, 1] + product[:, :, 2, :, 2])
    for i in range(3):
        whole[:, :, i, :, i] += trace
    whole = whole.reshape(m, 33, 33)
    outer, cross, inner = whole[:, :24, :24], whole[:, :24, 24:], whole[:, 24:, 24:]
    solved = np.linalg.solve(inner, np.swapaxes(cross, 1, 2))
    return np.asarray(solved, dtype=np.float64), inner, np.asarray(outer - cross @ solved, dtype=np.float64)


def _inverse(matrix: Array) -> tuple[Array, Array]:
    """Return the inverses (m, 3, 3) and determinants (m,) of 3 x 3 matrices, by cofactors."""
    cofactors = np.empty_like(matrix)
    for i in range(3):
        a, b = matrix[:, i - 2], matrix[:, i - 1]
        for j in range(3):
            cofactors[:, i, j] = a[:, j - 2] * b[:, j - 1] - a[:, j - 1] * b[:, j - 2]
    det = np.einsum("mi,mi->m", matrix[:, 0], cofactors[:, 0])
    return np.asarray(np.swapaxes(cofactors, 1, 2) / det[:, None, None]), det
