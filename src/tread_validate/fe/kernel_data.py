"""The arrays that the compiled kernels work on, by name."""

from __future__ import annotations

from typing import Any, NamedTuple

# Rows of the clock: total time, time in the step, length of the increment before, step number, increment number.
TOTAL_TIME, STEP_TIME, LAST_INCREMENT, STEP_NUMBER, INCREMENT_NUMBER = range(5)
CLOCK_ROWS = 5
# Rows of the works: of constraints, master and loads on the body; lost to friction; lost to impacts of contact nodes.
EXTERNAL, FRICTION, IMPACT = range(3)
WORK_SUMS = 3
OPEN, STICKS, SLIPS = 0, 1, 2  # state of a slave node
FIXED, VELOCITY, DISPLACEMENT = 0, 1, 2  # kind of a prescribed degree of freedom
NO_FRICTION, COULOMB, USER = 0, 1, 2  # kind of an interaction


class Elements(NamedTuple):
    """Element data of the kernels (see `block_forces`); `reduced` (1,): the number of blocks of one-point elements."""

    conn: Any
    geo: Any
    state: Any
    hist: Any
    decay: Any
    gain: Any
    elastic: Any
    kind: Any
    out: Any
    work: Any
    slots: Any
    slot_start: Any
    reduced: Any


class Nodes(NamedTuple):
    """Node data; vectors are flat, x y z of each node, with one node more than the mesh for empty lanes."""

    x0: Any
    u: Any
    v: Any
    force: Any
    load: Any
    inverse_mass: Any


class Amplitudes(NamedTuple):
    """Every amplitude's table one after the other, and their values now."""

    row: Any
    time: Any
    table: Any
    area_table: Any
    smooth: Any
    base: Any
    guess: Any
    value: Any
    area: Any


class Prescribed(NamedTuple):
    """Prescribed degrees of freedom: nodal ones first, then six for each rigid body."""

    dof: Any
    kind: Any
    magnitude: Any
    amplitude: Any
    start: Any
    area_start: Any
    mass: Any
    reaction: Any
    before: Any
    bodies: Any


class Loads(NamedTuple):
    """Concentrated forces and pressures."""

    dof: Any
    force: Any
    force_amplitude: Any
    faces: Any
    pressure: Any
    pressure_amplitude: Any


class Bodies(NamedTuple):
    """Rigid bodies: reference points, motion, and the nodes tied to them."""

    reference: Any
    motion: Any
    motion_old: Any
    turn: Any
    turn_old: Any
    node: Any
    body: Any
    arm: Any
    mass: Any
    reaction: Any


class Pair(NamedTuple):
    """A contact pair: slave nodes, master profile, friction and the arrays of its contacts."""

    slaves: Any
    held: Any
    mass: Any
    faces: Any
    segments: Any
    origin: Any
    frame: Any
    revolved: Any
    body: Any
    kind: Any
    coefficient: Any
    address: Any
    table: Any
    integers: Any
    reals: Any
    position: Any
    touching: Any
    normal: Any
    normal_force: Any
    slip_direction: Any
    stick_force: Any
    arrival: Any
    carried: Any
    tangential: Any
    slip: Any
    previous: Any
    coordinates: Any
    master: Any
    place: Any
    temperature: Any
    node_temperature: Any
    area: Any
    force: Any
    slipping: Any
    count: Any
