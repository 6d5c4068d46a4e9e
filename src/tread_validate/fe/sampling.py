"""What is kept of a step at its sampling times."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import EngineError
from .blocks import Blocks
from .contact_kernel import face_areas
from .energy import element_energies, kinetic_energy, largest_strain
from .kernel_data import (
    EXTERNAL,
    FRICTION,
    IMPACT,
    LAST_INCREMENT,
    OPEN,
    SLIPS,
    STEP_NUMBER,
    STEP_TIME,
    TOTAL_TIME,
    USER,
    Bodies,
    Elements,
    Nodes,
    Prescribed,
)
from .model import Model
from .node_state import node_state
from .pairs import PairData
from .stability import dot

Floats = NDArray[np.float64]


@dataclass
class Samples:
    """What is kept of a step at its sampling times; forces act on the body.

    `time` is the step's; normal and tangential are the sums of normal and frictional contact forces, (n, 3); `nodes`
    has displacement, velocity and reaction of the nodes asked for, (3, n, 3) a sample.
    """

    time: list[float] = field(default_factory=list)
    normal: list[Floats] = field(default_factory=list)
    tangential: list[Floats] = field(default_factory=list)
    slipping: list[float] = field(default_factory=list)
    reaction: list[Floats] = field(default_factory=list)
    energy: list[tuple[float, ...]] = field(default_factory=list)
    pressure: list[NDArray[np.float32]] = field(default_factory=list)
    traction: list[NDArray[np.float32]] = field(default_factory=list)
    slip_state: list[NDArray[np.int8]] = field(default_factory=list)
    nodes: dict[str, list[Floats]] = field(default_factory=dict)


class Sampled(Protocol):
    """A model under way, as far as it is sampled; a `Simulation` is one."""

    model: Model
    blocks: Blocks
    nodes: Nodes
    elements: Elements
    weights: Floats
    bodies: Bodies
    prescribed: Prescribed
    pairs: list[PairData]
    clock: Floats
    work: Floats
    strain: float
    start_energy: float
    samples: Samples


def take_sample(simulation: Sampled, dt: float, energies: bool) -> None:
    """Keep the state of the increment just made: forces belong to its start."""
    s = simulation.samples
    time = simulation.clock[STEP_TIME] - dt
    s.time.append(max(time, 0.0) if s.time == [] else time)
    normal = np.zeros(3)
    tangential = np.zeros(3)
    touching = slipping = 0.0
    for data in simulation.pairs:
        pair = data.pair
        if pair.kind[0] != USER:
            _areas(simulation, data)
        normal += pair.force[:, 0].sum(axis=0)
        tangential += pair.force[:, 1].sum(axis=0)
        touching += float(pair.area[pair.slipping > OPEN].sum())
        slipping += float(pair.area[pair.slipping == SLIPS].sum())
    s.normal.append(normal)
    s.tangential.append(tangential)
    s.slipping.append(slipping / touching if touching > 0 else 0.0)
    pair = simulation.pairs[0].pair
    share = np.divide(1.0, pair.area, out=np.zeros_like(pair.area), where=pair.area > 0)
    s.pressure.append((np.linalg.norm(pair.force[:, 0], axis=1) * share).astype(np.float32))
    s.traction.append((pair.force[:, 1] * share[:, None]).astype(np.float32))
    s.slip_state.append(pair.slipping.astype(np.int8))
    s.reaction.append(_reaction(simulation))
    asked = simulation.model.steps[int(simulation.clock[STEP_NUMBER]) - 1].node_history
    if asked:
        state = node_state(
            simulation.model, simulation.nodes, simulation.bodies, simulation.prescribed, simulation.pairs, dt
        )
        for name, request in asked.items():
            s.nodes.setdefault(name, []).append(state[:, request.nodes])
    if energies:
        _sample_energy(simulation)


def _areas(simulation: Sampled, data: PairData) -> None:
    pair = data.pair
    if pair.slaves.size:
        face_areas(pair.faces, pair.slaves, simulation.nodes.x0, simulation.nodes.u, pair.area)


def _reaction(simulation: Sampled) -> Floats:
    """Return the sum of the forces that hold prescribed nodes, (3,)."""
    p = simulation.prescribed
    nodal = p.dof[: p.bodies[0]] % 3
    total = np.bincount(nodal, weights=p.reaction, minlength=3)
    return np.asarray(total + simulation.bodies.reaction.sum(axis=0), dtype=np.float64)


def _sample_energy(simulation: Sampled) -> None:
    stored, stress_work, hourglass, bulk = element_energies(simulation.elements, simulation.weights, simulation.nodes.u)
    now = simulation.clock[TOTAL_TIME]
    simulation.strain = largest_strain(simulation.elements, simulation.strain)
    kinetic = kinetic_energy(simulation.nodes.v, simulation.blocks.mass)
    if not math.isfinite(kinetic + stored):
        raise EngineError(f"the energy is no longer finite at {now:.6g} s")
    # velocities live half an increment before the displacements; internal energy is taken back to them
    lead = 0.5 * simulation.clock[LAST_INCREMENT] * float(dot(simulation.nodes.force, simulation.nodes.v))
    stored, stress_work = stored - lead, stress_work - lead
    internal = stress_work + hourglass
    external, friction, impact = (float(simulation.work[row]) for row in (EXTERNAL, FRICTION, IMPACT))
    total = kinetic + internal + bulk + friction + impact - external - simulation.start_energy
    simulation.samples.energy.append(
        (
            simulation.clock[STEP_TIME], internal, stored, stress_work - stored, hourglass, bulk, kinetic, friction,
            impact, external, total,
        )
    )  # fmt: skip
