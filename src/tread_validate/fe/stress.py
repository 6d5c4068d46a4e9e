"""Stress and deformation of the elements from the kernel's state, for output and checks."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import polar

from .element_kernel import STATE_STRAIN

if TYPE_CHECKING:
    from .explicit import Simulation

Floats = NDArray[np.float64]


def deformation_gradients(simulation: Simulation) -> Floats:
    """Return F of every element, (m, 3, 3)."""
    b = simulation.blocks
    u = simulation.nodes.u.reshape(-1, 3)[b.connectivity]
    return np.asarray(np.eye(3) + np.einsum("nac,nja->ncj", u, b.gradients), dtype=np.float64)


def element_stress(simulation: Simulation) -> Floats:
    """Return the Cauchy stress of every element in the global axes, bulk viscosity left out: (m, 6).

    Order 11, 22, 33, 12, 13, 23, in deck units.
    """
    b = simulation.blocks
    e = simulation.elements
    lanes = e.state[:, STATE_STRAIN : STATE_STRAIN + 6]
    ratio = np.where(np.arange(6) < 5, e.elastic[e.kind, 2:3], e.elastic[e.kind, 3:4])
    hereditary = ratio[:, :, None] * lanes + e.hist.sum(axis=1)
    rows = hereditary.transpose(0, 2, 1).reshape(-1, 6)
    kept = np.zeros((b.volume.size, 6))
    kept[b.order[b.order >= 0]] = rows[b.order >= 0]
    shear = 2.0 * b.shear
    tensor = np.zeros((b.volume.size, 3, 3))
    mean = b.bulk * kept[:, 5]
    for i, row in ((0, kept[:, 0]), (1, kept[:, 1]), (2, -kept[:, 0] - kept[:, 1])):
        tensor[:, i, i] = shear * row + mean
    for (i, j), column in (((0, 1), 2), ((0, 2), 3), ((1, 2), 4)):
        tensor[:, i, j] = tensor[:, j, i] = shear * kept[:, column]
    rotation = np.array([polar(f)[0] for f in deformation_gradients(simulation)])
    turned = rotation @ tensor @ rotation.transpose(0, 2, 1)
    return np.stack([turned[:, i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))], axis=1)
