"""Stress and deformation of the elements from the kernel's state, for output and checks."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import polar

from .element_kernel import GEO_G, GEO_VOLUME, LANES, STATE_STRAIN, STATE_U
from .explicit import Simulation

Floats = NDArray[np.float64]


def deformation_gradients(simulation: Simulation) -> Floats:
    """Return F of every lane, (lanes, 3, 3): of an element, or of a Gauss point; 1 where a lane is empty."""
    e = simulation.elements
    u = np.moveaxis(simulation.nodes.u[e.conn[:, :, None] + np.arange(3)[:, None]], -1, 1).reshape(-1, 8, 3)
    b = np.moveaxis(e.geo[:, :GEO_G], -1, 1).reshape(-1, 3, 8)
    return np.asarray(np.eye(3) + np.einsum("nac,nja->ncj", u, b), dtype=np.float64)


def volume_ratios(state: Floats) -> Floats:
    """Return J of every lane, from its stretch: (lanes,)."""
    u0, u1, u2, u3, u4, u5 = state[:, STATE_U : STATE_U + 6].transpose(1, 0, 2).reshape(6, -1)
    return np.asarray(u0 * (u1 * u2 - u5 * u5) + u3 * (u4 * u5 - u3 * u2) + u4 * (u3 * u5 - u1 * u4), dtype=np.float64)


def lane_stress(simulation: Simulation) -> Floats:
    """Return the Cauchy stress of every lane in the global axes, bulk viscosity left out: (lanes, 3, 3)."""
    e = simulation.elements
    ratio = np.where(np.arange(6) < 5, e.elastic[e.kind, 2:3], e.elastic[e.kind, 3:4])
    hereditary = ratio[:, :, None] * e.state[:, STATE_STRAIN : STATE_STRAIN + 6] + e.hist.sum(axis=1)
    rows = np.moveaxis(hereditary, -1, 1).reshape(-1, 6)
    kirchhoff = np.repeat(e.elastic[e.kind, 5] > 0.0, LANES)
    rows[kirchhoff] /= volume_ratios(e.state)[kirchhoff, None]
    shear, bulk = (np.repeat(e.elastic[e.kind, column], LANES) for column in (0, 1))
    tensor = np.zeros((rows.shape[0], 3, 3))
    for i, row in ((0, rows[:, 0]), (1, rows[:, 1]), (2, -rows[:, 0] - rows[:, 1])):
        tensor[:, i, i] = shear * row + bulk * rows[:, 5]
    for (i, j), column in (((0, 1), 2), ((0, 2), 3), ((1, 2), 4)):
        tensor[:, i, j] = tensor[:, j, i] = shear * rows[:, column]
    rotation = np.array([polar(f)[0] for f in deformation_gradients(simulation)])
    return np.asarray(rotation @ tensor @ rotation.transpose(0, 2, 1), dtype=np.float64)


def element_stress(simulation: Simulation) -> Floats:
    """Return the Cauchy stress of every element in the global axes, the mean of its points by volume: (m, 6).

    Order 11, 22, 33, 12, 13, 23, in deck units; bulk viscosity left out.
    """
    b = simulation.blocks
    used = b.order >= 0
    turned = lane_stress(simulation)[used]
    weight = simulation.elements.geo[:, GEO_VOLUME].ravel()[used]
    total = np.bincount(b.order[used], weight, b.volume.size)
    columns = [
        np.bincount(b.order[used], weight * turned[:, i, j], b.volume.size) / total
        for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    ]
    return np.stack(columns, axis=1)
