"""Normal and shear stiffness of a block whose face sticks: two motions of the face, without condensing the block."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded

from ...study import Block
from ...units import DEG
from .body import Body
from .condense import dofs_of, held_dofs
from .element import IncompatibleField

Array = NDArray[np.float64]


def stuck_ratios_of(block: Block, body: Body, poissons_ratio: float, height: float) -> tuple[float, float]:
    """Return the ratios that `stuck_ratios` finds of the condensed body, from a banded Cholesky of its inside.

    Nodes are numbered section by section along the block, so that the band is as wide as two sections.
    """
    n, layers = body.nodes_per_layer, body.layers
    element = IncompatibleField(body.nodes[body.elements], poissons_ratio).stiffness()
    rank = _section_order(block, body)
    layer, node = np.divmod(np.arange(body.nodes.shape[0]), n)
    inside = (layer > 0) & (layer < layers)
    number = np.where(inside, rank[node] * (layers - 1) + layer - 1, -1)
    dofs, held = dofs_of(body.elements), held_dofs(body)
    element = element * (~held[dofs])[:, :, None] * (~held[dofs])[:, None, :]
    size = 3 * n * (layers - 1)
    place = np.where(np.repeat(inside, 3), (3 * number[:, None] + np.arange(3)).ravel(), -1)
    at = place[dofs]
    motion = np.zeros((3 * body.nodes.shape[0], 2))
    motion[1 : 3 * n : 3, 0] = 1.0
    motion[0 : 3 * n : 3, 1] = 1.0
    pull = element @ motion[dofs]
    load = np.zeros((size, 2))
    np.add.at(load, at[at >= 0], -pull[at >= 0])
    band = _band(element, at, size)
    band[0, place[held & (place >= 0)]] = 1.0
    moved = cho_solve_banded((cholesky_banded(band, overwrite_ab=True, lower=True, check_finite=False), True), load)
    motion[place >= 0] = moved[place[place >= 0]]
    each = motion[dofs]
    work = np.einsum("mik,mik->k", each, element @ each)
    area = float(body.area.sum())
    shear_modulus = 0.5 / (1.0 + poissons_ratio)
    return float(work[0]) * height / area, float(work[1]) * height / (shear_modulus * area)


def _section_order(block: Block, body: Body) -> NDArray[np.int64]:
    """Return the number of each node of a layer, section by section along the block."""
    across = body.face[:, 2]
    along = body.along + across * np.tan(block.skew_deg * DEG)
    rank = np.empty(across.size, dtype=np.int64)
    rank[np.lexsort((across, np.round(along, 9)))] = np.arange(across.size)
    return rank


def _band(element: Array, at: NDArray[np.int64], size: int) -> Array:
    """Return the lower band (b, size) of the sum of the elements' matrices, in the layout of LAPACK."""
    below = at[:, :, None] - at[:, None, :]
    mine = (at[:, None, :] >= 0) & (below >= 0)
    reach = int(below[mine].max()) + 1
    where = (below * size + at[:, None, :])[mine]
    return np.asarray(np.bincount(where, element[mine], reach * size).reshape(reach, size), dtype=np.float64)
