"""Loads: concentrated forces and pressures, and how a later step changes them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import DataLine, KeywordBlock
from .amplitude import Amplitude
from .mesh import FACES, Mesh

Ints = NDArray[np.int64]
NONE: Ints = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True)
class Load:
    """A concentrated force (`dof` 1..3 on `nodes`) or a pressure (`dof` 0 on `faces`).

    `kind` and `members` say what a later load replaces: the same degree of freedom of the same nodes, the same face of
    the same elements, the same surface (no members). `step` is where the step begins that gave it.
    """

    nodes: Ints
    faces: Ints
    dof: int
    magnitude: float
    amplitude: Amplitude | None
    where: str
    step: str
    kind: str
    members: Ints


def read_loads(block: KeywordBlock, mesh: Mesh, amplitude: Amplitude | None, step: str, loads: list[Load]) -> None:
    """Add the loads of ``*CLOAD``, ``*DLOAD`` or ``*DSLOAD`` to `loads`, in place of what they modify (OP=MOD).

    Loads of the same step on the same place add up.
    """
    read = {"CLOAD": _concentrated, "DLOAD": _on_elements, "DSLOAD": _on_surface}[block.keyword]
    for line in block.data:
        new = read(line, mesh, amplitude, step)
        loads[:] = [kept for load in loads if (kept := _without(load, new)) is not None]
        loads.append(new)


def _without(load: Load, new: Load) -> Load | None:
    """Return what is left of an earlier step's load where `new` takes its place; None where nothing is."""
    if load.step == new.step or load.kind != new.kind:
        return load
    if not load.members.size:
        return None
    kept = ~np.isin(load.members, new.members)
    if not kept.any():
        return None
    if load.dof:
        return replace(load, nodes=load.nodes[kept], members=load.members[kept])
    return replace(load, faces=load.faces[kept], members=load.members[kept])


def _concentrated(line: DataLine, mesh: Mesh, amplitude: Amplitude | None, step: str) -> Load:
    dof = line.integer_at(1, "a degree of freedom 1..3")
    if not 1 <= dof <= 3:
        raise InputError(line.where, line.text, "a degree of freedom 1 to 3")
    nodes = mesh.nodes_of(line.fields[0], line)
    size = line.number_at(2, "a magnitude")
    return Load(nodes, NONE, dof, size, amplitude, line.where, step, f"CLOAD {dof}", nodes)


def _on_surface(line: DataLine, mesh: Mesh, amplitude: Amplitude | None, step: str) -> Load:
    name = line.fields[0].upper()
    word = line.fields[1].upper() if len(line.fields) > 1 else ""
    if word != "P" or name not in mesh.faces:
        raise InputError(line.where, line.text, "element surface, P, magnitude")
    size = line.number_at(2, "a magnitude")
    return Load(NONE, mesh.faces[name], 0, size, amplitude, line.where, step, f"DSLOAD {name}", NONE)


def _on_elements(line: DataLine, mesh: Mesh, amplitude: Amplitude | None, step: str) -> Load:
    word = line.fields[1].upper() if len(line.fields) > 1 else ""
    if word not in ("P1", "P2", "P3", "P4", "P5", "P6"):
        raise InputError(line.where, line.text, "element set, P1 to P6, magnitude")
    elements = mesh.elements_of(line.fields[0], line)
    faces = mesh.connectivity[elements][:, FACES[int(word[1]) - 1]]
    size = line.number_at(2, "a magnitude")
    return Load(NONE, faces, 0, size, amplitude, line.where, step, f"DLOAD {word}", elements)
