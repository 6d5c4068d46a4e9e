"""The increment of explicit dynamics, run many times without coming back to the interpreter."""

from __future__ import annotations

import numpy as np
from numba import prange

from ..kernels import kernel
from .contact_kernel import apply_friction, coulomb, face_areas, find_contacts
from .element_full_kernel import full_block_forces
from .element_kernel import block_forces
from .kernel_data import (
    COULOMB,
    EXTERNAL,
    INCREMENT_NUMBER,
    LAST_INCREMENT,
    STEP_NUMBER,
    STEP_TIME,
    TOTAL_TIME,
    USER,
)
from .step_kernel import (
    evaluate_amplitudes,
    gather_forces,
    kick_and_drift,
    prescribed_value,
    pressure_loads,
    rotate,
)
from .user_friction import call_at

CHUNKS = 16  # of the element and node loops; their number does not depend on the number of threads
OK, INVERTED, BAD_FRICTION = 0, 1, 2


@kernel()
def element_loop(chunk, chunks, dt, elements, u):  # type: ignore[no-untyped-def]  # numba types it
    """Do one chunk of the element loop; return its least volume ratio."""
    total = elements.kind.size
    first, last = chunk * total // chunks, (chunk + 1) * total // chunks
    reduced = min(max(elements.reduced[0], first), last)
    worst = block_forces(
        first, reduced, dt, u, elements.conn, elements.geo, elements.state, elements.hist, elements.decay,
        elements.gain, elements.elastic, elements.kind, elements.out, elements.work[chunk],
    )  # fmt: skip
    if reduced == last:
        return worst
    return min(worst, full_block_forces(
        reduced, last, dt, u, elements.conn, elements.geo, elements.state, elements.hist, elements.decay,
        elements.gain, elements.elastic, elements.kind, elements.out, elements.work[chunk],
    ))  # fmt: skip


@kernel()
def node_loop(chunk, chunks, half_sum, dt, elements, nodes):  # type: ignore[no-untyped-def]  # numba types it
    """Do one chunk of the node loop."""
    total = elements.slot_start.size - 1
    first, last = chunk * total // chunks, (chunk + 1) * total // chunks
    kick_and_drift(first, last, half_sum, dt, nodes.inverse_mass, nodes.force, nodes.load, nodes.v, nodes.u)


@kernel()
def gather_loop(chunk, chunks, elements, nodes):  # type: ignore[no-untyped-def]  # numba types it
    """Do one chunk of the gathering of element forces."""
    total = elements.slot_start.size - 1
    first, last = chunk * total // chunks, (chunk + 1) * total // chunks
    gather_forces(first, last, elements.out, elements.slots, elements.slot_start, nodes.force)


@kernel()
def add_work_of_loads(half_sum, nodes, work):  # type: ignore[no-untyped-def]  # numba types it
    """Add half of what the loads do: called with the velocities before and after the increment."""
    for dof in range(nodes.load.size):
        if nodes.load[dof] != 0.0:
            work[EXTERNAL] += 0.5 * nodes.load[dof] * nodes.v[dof] * half_sum


@kernel()
def before_nodes(half_sum, nodes, amplitudes, prescribed, loads, bodies, pairs, work):  # type: ignore[no-untyped-def]  # numba types it
    """Loads at the start of the increment, and what the node loop will overwrite but is still needed."""
    if loads.dof.size or loads.pressure.size:
        for dof in range(nodes.load.size):
            nodes.load[dof] = 0.0
        for k in range(loads.dof.size):
            factor = loads.force[k]
            if loads.force_amplitude[k] >= 0:
                factor *= amplitudes.value[loads.force_amplitude[k]]
            nodes.load[loads.dof[k]] += factor
        pressure_loads(
            loads.faces, loads.pressure, loads.pressure_amplitude, amplitudes.value, nodes.x0, nodes.u, nodes.load
        )
        add_work_of_loads(half_sum, nodes, work)
    for k in range(prescribed.bodies[0]):
        prescribed.before[k] = nodes.v[prescribed.dof[k]]
    for k in range(bodies.node.size):
        for c in range(3):
            bodies.reaction[k, c] = nodes.v[3 * bodies.node[k] + c]
    for pair in pairs:
        for k in range(pair.slaves.size):
            for c in range(3):
                pair.arrival[k, c] = nodes.v[3 * pair.slaves[k] + c]


@kernel()
def constrain(half_sum, dt, total, step_time, nodes, amplitudes, prescribed, bodies, work):  # type: ignore[no-untyped-def]  # numba types it
    """Put prescribed degrees of freedom and rigid bodies where they are at the end of the increment."""
    evaluate_amplitudes(
        amplitudes.row, amplitudes.time, amplitudes.table, amplitudes.area_table, amplitudes.smooth, amplitudes.base,
        amplitudes.guess, total, amplitudes.value, amplitudes.area,
    )  # fmt: skip
    for b in range(bodies.motion.shape[0]):
        for c in range(6):
            bodies.motion_old[b, c] = bodies.motion[b, c]
        for c in range(9):
            bodies.turn_old[b, c // 3, c % 3] = bodies.turn[b, c // 3, c % 3]
    for k in range(prescribed.dof.size):
        target = prescribed_value(
            prescribed.kind[k], prescribed.magnitude[k], prescribed.amplitude[k], prescribed.start[k],
            prescribed.area_start[k], step_time, amplitudes.value, amplitudes.area,
        )  # fmt: skip
        if k >= prescribed.bodies[0]:
            bodies.motion[prescribed.dof[k] // 6, prescribed.dof[k] % 6] = target
            continue
        dof = prescribed.dof[k]
        old = nodes.u[dof] - dt * nodes.v[dof]
        before = prescribed.before[k]
        now = (target - old) / dt
        nodes.u[dof] = target
        nodes.v[dof] = now
        reaction = prescribed.mass[k] * (now - before) / half_sum + nodes.force[dof] - nodes.load[dof]
        prescribed.reaction[k] = reaction
        work[EXTERNAL] += reaction * 0.5 * (before + now) * half_sum
    for b in range(bodies.motion.shape[0]):
        rotate(
            bodies.motion[b, 3] - bodies.motion_old[b, 3],
            bodies.motion[b, 4] - bodies.motion_old[b, 4],
            bodies.motion[b, 5] - bodies.motion_old[b, 5],
            bodies.turn[b],
        )
    for k in range(bodies.node.size):
        b = bodies.body[k]
        for c in range(3):
            dof = 3 * bodies.node[k] + c
            x = bodies.reference[b, c] + bodies.motion[b, c] - nodes.x0[dof]
            for j in range(3):
                x += bodies.turn[b, c, j] * bodies.arm[k, j]
            old = nodes.u[dof] - dt * nodes.v[dof]
            before = bodies.reaction[k, c]
            now = (x - old) / dt
            nodes.u[dof] = x
            nodes.v[dof] = now
            reaction = bodies.mass[k] * (now - before) / half_sum + nodes.force[dof] - nodes.load[dof]
            bodies.reaction[k, c] = reaction
            work[EXTERNAL] += reaction * 0.5 * (before + now) * half_sum


@kernel()
def user_friction(pair, count, dt, total, step_time, step, increment, nodes):  # type: ignore[no-untyped-def]  # numba types it
    """Call VFRIC with the contacts found."""
    face_areas(pair.faces, pair.slaves, nodes.x0, nodes.u, pair.area)
    for k in range(pair.slaves.size):
        for c in range(3):
            pair.coordinates[k, c] = nodes.x0[3 * pair.slaves[k] + c] + nodes.u[3 * pair.slaves[k] + c]
    for i in range(count):
        k = pair.touching[i]
        pair.position[i] = k + 1
        pair.temperature[i] = pair.node_temperature[k]
        pair.tangential[i, 0] = 0.0
        pair.tangential[i, 1] = 0.0
    for c in range(3):
        pair.master[0, c] = pair.place[c]
    pair.integers[0] = step
    pair.integers[1] = increment
    pair.integers[2] = count
    pair.reals[0] = step_time
    pair.reals[1] = total
    pair.reals[2] = dt
    call_at(pair.address[0], pair.table)


@kernel()
def contact(half_sum, dt, total, step_time, step, increment, nodes, bodies, pairs, work):  # type: ignore[no-untyped-def]  # numba types it
    """Correct the trial motion of the slave nodes; return pair and contact of the first bad friction force, or -1."""
    for number in range(len(pairs)):
        pair = pairs[number]
        b = pair.body[0]
        for c in range(3):
            pair.place[c] = bodies.reference[b, c] + bodies.motion[b, c]
            pair.place[3 + c] = bodies.reference[b, c] + bodies.motion_old[b, c]
        count = find_contacts(pair, bodies.turn[b], bodies.turn_old[b], half_sum, dt, nodes)
        pair.count[0] = count
        if pair.kind[0] == COULOMB:
            coulomb(pair, count)
        elif pair.kind[0] == USER and count > 0:
            user_friction(pair, count, dt, total, step_time, step, increment, nodes)
        else:
            for i in range(count):
                pair.tangential[i, 0] = 0.0
                pair.tangential[i, 1] = 0.0
        bad = apply_friction(pair, count, half_sum, dt, nodes, work)
        if bad >= 0:
            return number, bad
    return -1, -1


@kernel()
def finish(half_sum, dt, clock, nodes, amplitudes, prescribed, loads, bodies, pairs, work):  # type: ignore[no-untyped-def]  # numba types it
    """Do everything of an increment between the node loop and the element loop; return pair and contact gone bad."""
    clock[TOTAL_TIME] += dt
    clock[STEP_TIME] += dt
    clock[INCREMENT_NUMBER] += 1.0
    total, step_time = clock[TOTAL_TIME], clock[STEP_TIME]
    constrain(half_sum, dt, total, step_time, nodes, amplitudes, prescribed, bodies, work)
    step, increment = int(clock[STEP_NUMBER]), int(clock[INCREMENT_NUMBER])
    found = contact(half_sum, dt, total, step_time, step, increment, nodes, bodies, pairs, work)
    if loads.dof.size or loads.pressure.size:
        add_work_of_loads(half_sum, nodes, work)
    clock[LAST_INCREMENT] = dt
    return found


@kernel(parallel=True)
def advance(increments, dt, clock, elements, nodes, amplitudes, prescribed, loads, bodies, pairs, work, fault):  # type: ignore[no-untyped-def]  # numba types it
    """Run `increments` increments of `dt`, the chunks of the loops spread over the threads that numba has.

    Every number comes from the same operations in the same order whatever the number of threads.

    Parameters
    ----------
    clock : (CLOCK_ROWS,) and work : (WORK_SUMS,), rows named in `kernel_data`
    fault : (3,) out: kind of fault, pair or 0, contact or 0
    """
    least = np.zeros(CHUNKS)
    for _ in range(increments):
        half_sum = 0.5 * (clock[LAST_INCREMENT] + dt)
        before_nodes(half_sum, nodes, amplitudes, prescribed, loads, bodies, pairs, work)
        for chunk in prange(CHUNKS):
            node_loop(chunk, CHUNKS, half_sum, dt, elements, nodes)
        found = finish(half_sum, dt, clock, nodes, amplitudes, prescribed, loads, bodies, pairs, work)
        if found[0] >= 0:
            fault[0], fault[1], fault[2] = BAD_FRICTION, found[0], found[1]
            return
        for chunk in prange(CHUNKS):
            least[chunk] = element_loop(chunk, CHUNKS, dt, elements, nodes.u)
        for chunk in prange(CHUNKS):
            gather_loop(chunk, CHUNKS, elements, nodes)
        worst = np.inf
        for chunk in range(CHUNKS):
            worst = min(worst, least[chunk])
        if not worst > 0.0:
            fault[0] = INVERTED
            return
