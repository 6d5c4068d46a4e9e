"""From a deck's blocks to the model the engine runs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import Deck, KeywordBlock, read_deck
from .amplitude import read_amplitudes
from .kernel_data import COULOMB, NO_FRICTION, USER
from .material import SolidSection, read_materials, read_sections
from .mesh import Mesh, read_mesh
from .rigid_surface import RigidSurface
from .steps import Step, read_steps
from .subset import check_subset

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SurfaceFriction:
    """Friction of an interaction: none, a constant coefficient, or VFRIC with its properties."""

    kind: int
    coefficient: float = 0.0
    properties: tuple[float, ...] = ()
    state_variables: int = 0
    where: str = ""


@dataclass(frozen=True)
class RigidBody:
    """A reference node with the nodes tied to it and the analytical surface it carries."""

    reference: int
    tied: NDArray[np.int64]
    surface: RigidSurface | None
    where: str


@dataclass(frozen=True)
class Model:
    """Everything the engine takes from a deck.

    Attributes
    ----------
    temperature : (n,) node temperatures, degC, or None without ``*INITIAL CONDITIONS, TYPE=TEMPERATURE``
    velocity : (n, 3) initial node velocities
    """

    deck: Deck
    mesh: Mesh
    sections: list[SolidSection]
    rigid_bodies: list[RigidBody]
    interactions: dict[str, SurfaceFriction]
    steps: list[Step]
    temperature: Floats | None
    velocity: Floats

    @property
    def needs_user_routine(self) -> bool:
        """Whether a contact pair of any step asks for VFRIC."""
        return self.user_friction is not None

    @property
    def user_friction(self) -> SurfaceFriction | None:
        """The first interaction of a contact pair that asks for VFRIC."""
        used = [pair.interaction for step in self.steps for pair in step.pairs]
        return next((self.interactions[name] for name in used if self.interactions[name].kind == USER), None)


def read_model(path: Path | str) -> Model:
    """Read a deck of the documented subset.

    Raises
    ------
    InputError
        Anything outside the subset, anything missing or contradictory, with file and line.
    """
    deck = read_deck(path)
    check_subset(deck)
    blocks = list(deck.blocks)
    mesh = read_mesh(blocks)
    sections = read_sections(blocks, mesh, read_materials(blocks))
    bodies = _rigid_bodies(blocks, mesh)
    steps = read_steps(blocks, mesh, read_amplitudes(blocks))
    interactions = _interactions(blocks)
    temperature, velocity = _initial(blocks, mesh)
    model = Model(deck, mesh, sections, bodies, interactions, steps, temperature, velocity)
    _check_pairs(model)
    _check_temperature(model)
    return model


def _rigid_bodies(blocks: list[KeywordBlock], mesh: Mesh) -> list[RigidBody]:
    bodies: list[RigidBody] = []
    owner: dict[int, str] = {}
    for block in blocks:
        if block.keyword != "RIGID BODY":
            continue
        reference = mesh.nodes_of(block.value("REF NODE"), block)
        if reference.size != 1:
            raise InputError(block.where, f"{reference.size} reference nodes", "one")
        tied = np.zeros(0, dtype=np.int64)
        for name in ("TIE NSET", "PIN NSET"):
            if block.parameters.get(name):
                tied = np.union1d(tied, mesh.nodes_of(block.value(name), block))
        surface = None
        if block.parameters.get("ANALYTICAL SURFACE"):
            name = block.value("ANALYTICAL SURFACE")
            if name not in mesh.rigid_surfaces:
                raise InputError(
                    block.where, f"analytical surface {name}", "a *SURFACE, TYPE=CYLINDER or REVOLUTION that exists"
                )
            surface = mesh.rigid_surfaces[name]
        elif not tied.size:
            raise InputError(block.where, "a rigid body of nothing", "TIE NSET, PIN NSET or ANALYTICAL SURFACE")
        for node in [int(reference[0]), *map(int, tied)]:
            if node in owner:
                label = mesh.node_labels[node]
                raise InputError(
                    block.where, f"node {label} also in the rigid body of {owner[node]}", "one body a node"
                )
            owner[node] = block.where
        bodies.append(RigidBody(int(reference[0]), tied, surface, block.where))
    return bodies


def _interactions(blocks: list[KeywordBlock]) -> dict[str, SurfaceFriction]:
    found: dict[str, SurfaceFriction] = {}
    name: str | None = None
    for block in blocks:
        if block.keyword == "SURFACE INTERACTION":
            name = block.value("NAME")
            if name in found:
                raise InputError(block.where, f"interaction {name} twice", "each interaction once")
            found[name] = SurfaceFriction(NO_FRICTION, where=block.where)
        elif block.keyword == "FRICTION":
            if name is None:
                raise InputError(block.where, "*FRICTION outside an interaction", "*SURFACE INTERACTION first")
            found[name] = _friction(block)
    return found


def _friction(block: KeywordBlock) -> SurfaceFriction:
    if "USER" not in block.parameters:
        extra = [word for word in ("DEPVAR", "PROPERTIES") if word in block.parameters]
        if extra or len(block.data) != 1 or len(block.data[0].fields) != 1:
            raise InputError(block.where, extra[0] if extra else "a table", "one constant coefficient, or USER=FRIC")
        coefficient = block.data[0].number_at(0, "a friction coefficient")
        if coefficient < 0:
            raise InputError(block.data[0].where, coefficient, "a friction coefficient >= 0")
        return SurfaceFriction(COULOMB, coefficient, where=block.where)
    values = [line.number_at(i, "a property") for line in block.data for i in range(len(line.fields))]
    counts = []
    for word in ("PROPERTIES", "DEPVAR"):
        text = block.parameters.get(word) or "0"
        if not text.isdigit():
            raise InputError(f"{block.where}: *FRICTION, {word}", text, "a count")
        counts.append(int(text))
    if counts[0] != len(values):
        raise InputError(
            block.where, f"PROPERTIES={counts[0]} and {len(values)} values", "as many values as PROPERTIES"
        )
    return SurfaceFriction(USER, 0.0, tuple(values), counts[1], block.where)


def _initial(blocks: list[KeywordBlock], mesh: Mesh) -> tuple[Floats | None, Floats]:
    count = mesh.node_labels.size
    velocity = np.zeros((count, 3))
    temperature: Floats | None = None
    for block in blocks:
        if block.keyword != "INITIAL CONDITIONS":
            continue
        if block.parameters["TYPE"] == "ROTATING VELOCITY":
            _rotating(block, mesh, velocity)
            continue
        for line in block.data:
            nodes = mesh.nodes_of(line.fields[0], line)
            if block.parameters["TYPE"] == "TEMPERATURE":
                if temperature is None:
                    temperature = np.full(count, np.nan)
                temperature[nodes] = line.number_at(1, "a temperature")
                continue
            dof = line.integer_at(1, "a degree of freedom 1..6")
            if not 1 <= dof <= 6:
                raise InputError(line.where, line.text, "a degree of freedom 1 to 6")
            if dof <= 3:
                velocity[nodes, dof - 1] = line.number_at(2, "a velocity")
    return temperature, velocity


def _rotating(block: KeywordBlock, mesh: Mesh, velocity: Floats) -> None:
    """Set ``TYPE=ROTATING VELOCITY``: v = v0 + omega x (x - a), omega along the axis from a to b.

    Pairs of lines: node or set, rate (rad/s), v0; then a and b.
    """
    if len(block.data) % 2:
        raise InputError(f"{block.where}: *{block.keyword}", f"{len(block.data)} lines", "pairs of lines")
    for first, second in zip(block.data[::2], block.data[1::2], strict=True):
        nodes = mesh.nodes_of(first.fields[0], first)
        rate = first.number_at(1, "an angular velocity", 0.0)
        shift = np.array([first.number_at(i, "a velocity", 0.0) for i in (2, 3, 4)])
        a, b = (np.array([second.number_at(i + j, "a coordinate", 0.0) for j in range(3)]) for i in (0, 3))
        length = float(np.linalg.norm(b - a))
        if rate != 0.0 and not length > 0.0:
            raise InputError(second.where, second.text, "two points apart on the axis of rotation")
        spin = rate * (b - a) / (length or 1.0)
        velocity[nodes] = shift + np.cross(spin, mesh.coordinates[nodes] - a)


def _check_pairs(model: Model) -> None:
    carried = {body.surface.name for body in model.rigid_bodies if body.surface is not None}
    for step in model.steps:
        for pair in step.pairs:
            if pair.interaction not in model.interactions:
                raise InputError(pair.where, f"interaction {pair.interaction}", "a *SURFACE INTERACTION of the deck")
            if pair.slave not in model.mesh.faces:
                raise InputError(pair.where, f"slave surface {pair.slave}", "an element-based surface of the deck")
            if pair.master not in model.mesh.rigid_surfaces:
                raise InputError(pair.where, f"master surface {pair.master}", "an analytical surface of the deck")
            if pair.master not in carried:
                raise InputError(
                    pair.where, f"surface {pair.master} in no rigid body", "*RIGID BODY, ANALYTICAL SURFACE="
                )


def _check_temperature(model: Model) -> None:
    shifted = [s for s in model.sections if s.material.trs is not None and s.material.prony.size]
    if not shifted:
        return
    used = np.unique(np.concatenate([model.mesh.connectivity[s.elements].ravel() for s in shifted]))
    if model.temperature is None or np.isnan(model.temperature[used]).any():
        raise InputError(
            f"{shifted[0].material.where}: *TRS",
            "nodes without a temperature",
            "*INITIAL CONDITIONS, TYPE=TEMPERATURE for every node",
        )
