"""Contact pairs of a step as the kernel's arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .contact_kernel import project
from .kernel_data import USER, Bodies, Pair, Prescribed
from .model import Model, SurfaceFriction
from .steps import ContactPair, Step
from .user_friction import Arguments, UserRoutine

Floats = NDArray[np.float64]
DEEPEST_START = 1e-6  # of the face's extent


@dataclass(frozen=True)
class PairData:
    """A pair's kernel arrays with what keeps them alive and names them."""

    pair: Pair
    arguments: Arguments
    contact: ContactPair
    labels: NDArray[np.int64]


def gather_pairs(
    model: Model,
    step: Step,
    bodies: Bodies,
    prescribed: Prescribed,
    mass: Floats,
    u: Floats,
    routine: UserRoutine | None,
) -> list[PairData]:
    """Return the contact pairs of a step; one without slave nodes when the step has none.

    Raises
    ------
    InputError
        Slave nodes inside the master at the start, or VFRIC asked for and not given.
    """
    held = held_nodes(model, bodies, prescribed)
    body_of = {body.surface.name: n for n, body in enumerate(model.rigid_bodies) if body.surface is not None}
    made = [_pair(model, contact, body_of[contact.master], held, mass, routine) for contact in step.pairs]
    for data in made:
        _check_start(model, data, bodies, u)
    return made or [_empty()]


def held_nodes(model: Model, bodies: Bodies, prescribed: Prescribed) -> NDArray[np.bool_]:
    """Return which nodes have all three displacements prescribed, (n,)."""
    count = np.bincount(prescribed.dof[: prescribed.bodies[0]] // 3, minlength=model.mesh.node_labels.size)
    held = np.asarray(count >= 3)
    held[bodies.node] = True
    return held


def _pair(
    model: Model, contact: ContactPair, body: int, held: NDArray[np.bool_], mass: Floats, routine: UserRoutine | None
) -> PairData:
    friction = model.interactions[contact.interaction]
    if friction.kind == USER and routine is None:
        raise InputError(friction.where, "*FRICTION, USER without a user routine", "--user vfric.f")
    surface = model.mesh.rigid_surfaces[contact.master]
    reference = model.rigid_bodies[body].reference
    faces = model.mesh.faces[contact.slave]
    slaves = np.unique(faces)
    arguments = Arguments(
        slaves.size,
        friction.state_variables,
        np.array(friction.properties, dtype=np.float64),
        model.mesh.node_labels[slaves],
        (contact.interaction, contact.slave, contact.master),
        int(model.mesh.node_labels[reference]),
        None if model.temperature is None else np.nan_to_num(model.temperature[slaves]),
    )
    pair = _assemble(
        slaves,
        held[slaves],
        mass[slaves],
        np.ascontiguousarray(np.searchsorted(slaves, faces)),
        np.ascontiguousarray(surface.segments),
        surface.origin - model.mesh.coordinates[reference],
        surface.frame,
        surface.revolved,
        body,
        friction,
        0 if routine is None else routine.address,
        arguments,
    )
    return PairData(pair, arguments, contact, model.mesh.node_labels[slaves])


def _empty() -> PairData:
    arguments = Arguments(0, 0, np.zeros(0), np.zeros(0, dtype=np.int64), ("", "", ""), 0, None)
    none = np.zeros(0, dtype=np.int64)
    pair = _assemble(
        none, np.zeros(0, dtype=np.bool_), np.zeros(0), np.zeros((0, 4), dtype=np.int64), np.zeros((0, 7)), np.zeros(3),
        np.eye(3), False, -1, SurfaceFriction(0), 0, arguments,
    )  # fmt: skip
    return PairData(pair, arguments, ContactPair("", "", "", ""), none)


def _assemble(
    slaves: NDArray[np.int64],
    held: NDArray[np.bool_],
    mass: Floats,
    faces: NDArray[np.int64],
    segments: Floats,
    origin: Floats,
    frame: Floats,
    revolved: bool,
    body: int,
    friction: SurfaceFriction,
    address: int,
    arguments: Arguments,
) -> Pair:
    n = slaves.size
    a = arguments.arrays
    return Pair(
        slaves=slaves,
        held=held.astype(np.int64),
        mass=mass,
        faces=faces,
        segments=segments,
        origin=origin,
        frame=frame,
        revolved=np.array([revolved]),
        body=np.array([body], dtype=np.int64),
        kind=np.array([friction.kind], dtype=np.int64),
        coefficient=np.array([friction.coefficient]),
        address=np.array([address], dtype=np.int64),
        table=arguments.table,
        integers=arguments.integers,
        reals=arguments.reals,
        position=a["jConSlvid"],
        touching=np.zeros(n, dtype=np.int64),
        normal=a["dircosN"],
        normal_force=a["fNormal"],
        slip_direction=a["dirCosSl"],
        stick_force=a["fStickForce"],
        arrival=np.zeros((n, 3)),
        carried=np.zeros((n, 3)),
        tangential=a["fTangential"],
        slip=a["dSlipFric"],
        previous=a["fTangPrev"],
        coordinates=a["coordSlv"],
        master=a["coordMst"],
        place=np.zeros(6),
        temperature=a["tempSlv"],
        node_temperature=np.zeros(n) if arguments.temperature is None else arguments.temperature,
        area=a["areaSlv"],
        force=np.zeros((n, 2, 3)),
        slipping=np.zeros(n, dtype=np.int64),
        count=np.zeros(1, dtype=np.int64),
    )


def gaps(data: PairData, bodies: Bodies, coordinates: Floats, u: Floats) -> Floats:
    """Return the gap of each slave node from the master's profile; inf beside it."""
    pair = data.pair
    body = int(pair.body[0])
    points = coordinates[pair.slaves] + u.reshape(-1, 3)[pair.slaves]
    local = (points - bodies.reference[body] - bodies.motion[body, :3]) @ bodies.turn[body] - pair.origin
    plane = local @ pair.frame.T
    if pair.revolved[0]:
        plane[:, 0] = np.hypot(plane[:, 0], plane[:, 2])
    plane = plane[:, :2]
    return np.array([project(pair.segments, x, y)[0] for x, y in plane], dtype=np.float64)


def _check_start(model: Model, data: PairData, bodies: Bodies, u: Floats) -> None:
    """Refuse a pair whose slave nodes begin inside the master: a normal the wrong way, or overlap."""
    found = gaps(data, bodies, model.mesh.coordinates, u)
    extent = float(np.ptp(model.mesh.coordinates[data.pair.slaves], axis=0).max())
    worst = int(np.argmin(found))
    if found[worst] < -DEEPEST_START * extent:
        raise InputError(
            data.contact.where,
            f"slave node {data.labels[worst]} inside {data.contact.master} by {-found[worst]:g}",
            "slave nodes outside at the start (the outward normal lies to the left of the profile's direction)",
        )
