"""Displacement, velocity and reaction of every node, reference nodes of rigid bodies included."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from .kernel_data import Bodies, Nodes, Prescribed
from .model import Model
from .pairs import PairData

Floats = NDArray[np.float64]


def node_state(
    model: Model, nodes: Nodes, bodies: Bodies, prescribed: Prescribed, pairs: Sequence[PairData], dt: float
) -> Floats:
    """Return displacement, velocity and reaction force of the nodes after an increment `dt`, (3, n, 3).

    A node tied to a rigid body has no reaction of its own: its reference node has that of all of them, and what holds
    the body's surface in contact.
    """
    count = model.mesh.node_labels.size
    state = np.zeros((3, count, 3))
    state[0] = nodes.u.reshape(-1, 3)[:count]
    state[1] = nodes.v.reshape(-1, 3)[:count]
    nodal = prescribed.dof[: prescribed.bodies[0]]
    np.add.at(state[2].reshape(-1), nodal, prescribed.reaction)
    for number, body in enumerate(model.rigid_bodies):
        state[0, body.reference] = bodies.motion[number, :3]
        state[1, body.reference] = (bodies.motion[number, :3] - bodies.motion_old[number, :3]) / dt
        state[2, body.reference] = bodies.reaction[bodies.body == number].sum(axis=0)
    for data in pairs:
        if data.pair.slaves.size:
            body = model.rigid_bodies[int(data.pair.body[0])]
            state[2, body.reference] += data.pair.force.sum(axis=(0, 1))
    return state
