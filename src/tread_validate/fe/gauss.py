"""Gradients and volumes of hexahedra: the means of one-point elements, and those at the Gauss points of C3D8."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
CORNERS = np.array(
    [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], dtype=float
)
BATCH = 2048
"""Elements whose stiffness matrices are held at a time."""


def mean_gradients(corners: Floats) -> tuple[Floats, Floats]:
    """Return the volume (m,) and the mean shape-function gradients (m, 3, 8) of hexahedra.

    Exact integrals over the element by 2 x 2 x 2 Gauss points; `corners` is (m, 8, 3).
    """
    volume = np.zeros(corners.shape[0])
    total = np.zeros((corners.shape[0], 3, 8))
    for point in CORNERS / np.sqrt(3.0):
        factors = 1.0 + CORNERS * point
        local = np.stack(
            [
                CORNERS[:, 0] * factors[:, 1] * factors[:, 2],
                CORNERS[:, 1] * factors[:, 0] * factors[:, 2],
                CORNERS[:, 2] * factors[:, 0] * factors[:, 1],
            ]
        )
        jacobian = (local / 8.0) @ corners
        determinant = np.linalg.det(jacobian)
        volume += determinant
        with np.errstate(all="ignore"):
            usable = np.where(np.abs(determinant)[:, None, None] > 0, jacobian, np.eye(3))
        total += determinant[:, None, None] * np.linalg.solve(
            usable, np.broadcast_to(local / 8.0, (len(corners), 3, 8))
        )
    return volume, total / np.where(volume == 0, 1.0, volume)[:, None, None]


def gauss_points(corners: Floats) -> tuple[Floats, Floats]:
    """Return volumes (m, 8) and shape-function gradients (m, 8, 3, 8) at the 2 x 2 x 2 Gauss points of hexahedra.

    `corners` is (m, 8, 3). A point that is inside out has a volume that is not positive; its gradients mean nothing.
    """
    volume = np.zeros((len(corners), 8))
    gradients = np.zeros((len(corners), 8, 3, 8))
    for number, point in enumerate(CORNERS / np.sqrt(3.0)):
        factors = 1.0 + CORNERS * point
        local = 0.125 * np.stack(
            [
                CORNERS[:, 0] * factors[:, 1] * factors[:, 2],
                CORNERS[:, 1] * factors[:, 0] * factors[:, 2],
                CORNERS[:, 2] * factors[:, 0] * factors[:, 1],
            ]
        )
        jacobian = local @ corners
        volume[:, number] = np.linalg.det(jacobian)
        usable = np.where(np.abs(volume[:, number])[:, None, None] > 0, jacobian, np.eye(3))
        gradients[:, number] = np.linalg.solve(usable, np.broadcast_to(local, (len(corners), 3, 8)))
    return volume, gradients


def mean_of_points(volume: Floats, gradients: Floats) -> tuple[Floats, Floats]:
    """Return an element's volume (m,) and its mean gradients (m, 3, 8): those of its change of volume."""
    total = volume.sum(axis=1)
    return total, np.einsum("mp,mpja->mja", volume, gradients) / total[:, None, None]


def highest_frequency_squared(
    volume: Floats, gradients: Floats, shear: Floats, bulk: Floats, density: Floats
) -> Floats:
    """Return the square of each element's highest angular frequency with lumped mass, (m,).

    The largest eigenvalue of the stiffness matrix: distortion at the points, change of volume of the whole element.

    Parameters
    ----------
    volume : (m, 8); gradients : (m, 8, 3, 8)
    shear, bulk, density : (m,)
    """
    total, mean = mean_of_points(volume, gradients)
    found = np.zeros(len(volume))
    for first in range(0, len(volume), BATCH):
        own = slice(first, first + BATCH)
        b, weight = gradients[own], volume[own] * shear[own, None]
        inner = np.einsum("mp,mpja,mpjb->mab", weight, b, b)
        cross = np.einsum("mp,mpja,mpcb->macbj", weight, b, b)  # transposed gradient: row (a, c), column (b, j)
        same = np.einsum("mp,mpca,mpjb->macbj", weight, b, b)
        stiffness = cross - 2.0 / 3.0 * same
        for c in range(3):
            stiffness[:, :, c, :, c] += inner
        swelling = mean[own].transpose(0, 2, 1).reshape(-1, 24)
        matrix = stiffness.reshape(-1, 24, 24) + np.einsum("m,mi,mj->mij", bulk[own] * total[own], swelling, swelling)
        found[own] = np.linalg.eigvalsh(matrix)[:, -1] * 8.0 / (density[own] * total[own])
    return found
