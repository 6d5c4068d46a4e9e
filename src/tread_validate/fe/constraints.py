"""Prescribed motion, rigid bodies, amplitudes and loads of a step as the kernel's arrays."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .amplitude import Amplitude
from .kernel_data import FIXED, Amplitudes, Bodies, Loads, Prescribed
from .model import Model
from .steps import Condition, Step

Floats = NDArray[np.float64]


def gather_amplitudes(step: Step, start: float) -> tuple[Amplitudes, dict[str, int]]:
    """Return the amplitudes a step uses, evaluated at nothing yet, and the row of each name."""
    used: list[Amplitude] = []
    rows: dict[str, int] = {}
    for item in [*step.conditions.values(), *step.loads]:
        amplitude = item.amplitude  # type: ignore[attr-defined]  # conditions and loads all have one
        if amplitude is not None and amplitude.name not in rows:
            rows[amplitude.name] = len(used)
            used.append(amplitude)
    count = len(used)
    return Amplitudes(
        row=np.cumsum([0, *(a.times.size for a in used)]).astype(np.int64),
        time=_join([a.times for a in used]),
        table=_join([a.values for a in used]),
        area_table=_join([a.integrals() for a in used]),
        smooth=np.array([a.smooth for a in used], dtype=np.bool_),
        base=np.array([0.0 if a.total_time else start for a in used], dtype=np.float64),
        guess=np.zeros(count, dtype=np.int64),
        value=np.zeros(count),
        area=np.zeros(count),
    ), rows


def _join(parts: Sequence[Floats]) -> Floats:
    return np.concatenate(parts) if parts else np.zeros(0)


def gather_bodies(model: Model, mass: Floats) -> Bodies:
    """Return the rigid bodies at rest at their reference points."""
    x = model.mesh.coordinates
    count = len(model.rigid_bodies)
    reference = np.array([x[body.reference] for body in model.rigid_bodies]).reshape(count, 3)
    node = np.concatenate([body.tied for body in model.rigid_bodies] or [np.zeros(0, dtype=np.int64)]).astype(np.int64)
    owner = np.repeat(np.arange(count), [body.tied.size for body in model.rigid_bodies]).astype(np.int64)
    return Bodies(
        reference=reference,
        motion=np.zeros((count, 6)),
        motion_old=np.zeros((count, 6)),
        turn=np.tile(np.eye(3), (count, 1, 1)),
        turn_old=np.tile(np.eye(3), (count, 1, 1)),
        node=node,
        body=owner,
        arm=x[node] - reference[owner] if node.size else np.zeros((0, 3)),
        mass=mass[node],
        reaction=np.zeros((node.size, 3)),
    )


def gather_prescribed(
    model: Model, step: Step, rows: dict[str, int], amplitudes: Amplitudes, u: Floats, bodies: Bodies, mass: Floats
) -> Prescribed:
    """Return a step's prescribed degrees of freedom; `amplitudes` hold the values at its start.

    Raises
    ------
    InputError
        A condition on a node tied to a rigid body, or a rigid body free to move.
    """
    body_of = {body.reference: number for number, body in enumerate(model.rigid_bodies)}
    tied = set(map(int, bodies.node))
    nodal: list[tuple[int, Condition, float]] = []
    rigid: dict[int, Condition] = {}
    for (node, dof), condition in step.conditions.items():
        if node in tied:
            label = model.mesh.node_labels[node]
            raise InputError(
                condition.where, f"node {label}, tied to a rigid body", "a condition on its reference node"
            )
        if node in body_of:
            rigid[6 * body_of[node] + dof - 1] = condition
        elif dof <= 3:
            nodal.append((3 * node + dof - 1, condition, float(u[3 * node + dof - 1])))
    for number, body in enumerate(model.rigid_bodies):
        for dof in range(6):
            if 6 * number + dof not in rigid:
                label = model.mesh.node_labels[body.reference]
                raise InputError(body.where, f"degree of freedom {dof + 1} of node {label} free", "all six prescribed")
    nodal.sort(key=lambda item: item[0])
    every = nodal + [(dof, rigid[dof], float(bodies.motion.flat[dof])) for dof in sorted(rigid)]
    index = np.array([_row(condition, rows) for _, condition, _ in every], dtype=np.int64)
    nodes = np.array([dof // 3 for dof, _, _ in nodal], dtype=np.int64)
    area = np.append(amplitudes.area, 0.0)
    return Prescribed(
        dof=np.array([dof for dof, _, _ in every], dtype=np.int64),
        kind=np.array([condition.kind for _, condition, _ in every], dtype=np.int64),
        magnitude=np.array([condition.magnitude for _, condition, _ in every], dtype=np.float64),
        amplitude=index,
        start=np.array([start for _, _, start in every], dtype=np.float64),
        area_start=area[index],
        mass=mass[nodes],
        reaction=np.zeros(len(nodal)),
        before=np.zeros(len(nodal)),
        bodies=np.array([len(nodal)], dtype=np.int64),
    )


def _row(condition: Condition, rows: dict[str, int]) -> int:
    if condition.kind == FIXED or condition.amplitude is None:
        return -1
    return rows[condition.amplitude.name]


def gather_loads(step: Step, rows: dict[str, int]) -> Loads:
    """Return a step's concentrated forces and pressures."""
    dof: list[int] = []
    force: list[float] = []
    force_row: list[int] = []
    faces: list[NDArray[np.int64]] = []
    pressure: list[float] = []
    pressure_row: list[int] = []
    for load in step.loads:
        row = -1 if load.amplitude is None else rows[load.amplitude.name]
        if load.dof:
            dof += [3 * int(node) + load.dof - 1 for node in load.nodes]
            force += [load.magnitude] * load.nodes.size
            force_row += [row] * load.nodes.size
        else:
            faces.append(load.faces)
            pressure += [load.magnitude] * len(load.faces)
            pressure_row += [row] * len(load.faces)
    return Loads(
        dof=np.array(dof, dtype=np.int64),
        force=np.array(force, dtype=np.float64),
        force_amplitude=np.array(force_row, dtype=np.int64),
        faces=np.ascontiguousarray(np.concatenate(faces)) if faces else np.zeros((0, 4), dtype=np.int64),
        pressure=np.array(pressure, dtype=np.float64),
        pressure_amplitude=np.array(pressure_row, dtype=np.int64),
    )
