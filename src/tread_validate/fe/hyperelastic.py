"""How much stiffer than at no strain a neo-Hookean element is, for the stable increment."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def stiffening(gradient: Floats) -> tuple[Floats, Floats]:
    """Return bounds on the factors of the shear and the bulk modulus at deformation gradients (m, 3, 3), each (m,).

    Waves of shear feel at most G times the square of the largest distortional stretch, over J; those of volume
    K (2 J - 1). A factor is at least 1.
    """
    jacobian = np.linalg.det(gradient)
    largest = np.linalg.eigvalsh(np.swapaxes(gradient, 1, 2) @ gradient)[:, 2] * np.abs(jacobian) ** (-2.0 / 3.0)
    shear = np.maximum(largest / np.abs(jacobian), 1.0)
    return np.asarray(shear, dtype=np.float64), np.asarray(np.maximum(2.0 * jacobian - 1.0, 1.0), dtype=np.float64)


def stiffened(
    shear: Floats, bulk: Floats, neo_hookean: NDArray[np.bool_], displacement_gradient: Floats | None
) -> tuple[Floats, Floats]:
    """Return shear and bulk modulus (m,), times `stiffening` where `neo_hookean` (m,), at F - 1 of (m, 3, 3)."""
    if displacement_gradient is None or not neo_hookean.any():
        return shear, bulk
    factors = stiffening(displacement_gradient[neo_hookean] + np.eye(3))
    shear, bulk = shear.copy(), bulk.copy()
    shear[neo_hookean] *= factors[0]
    bulk[neo_hookean] *= factors[1]
    return shear, bulk
