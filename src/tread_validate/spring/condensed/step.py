"""One step of a condensed viscoelastic block against a rigid road, quasi-static, in compiled code.

A step has three parts, so that the nodes that matter can be chosen between them: `approach` says where each node would
be carried and which ones may touch; `hold` solves the contact of a window of nodes; `settle` moves everything on.
"""

from __future__ import annotations

import math

import numpy as np

from ...kernels import kernel
from .contact import ContactNodes, Tempo, solve_contact
from .inputs import (
    FREE,
    STICK,
    Array,
    FaceState,
    Integers,
    Operator,
    Pose,
    Scene,
    Scratch,
    Singles,
    Solid,
    Solver,
    Windows,
)
from .products import loads
from .touch import aim, gap, retouch, turn_of

SUNK = 1e-9
"""A node outside the window that stands deeper in the road than this (m) asks for a wider window."""
ROUGH = 10.0
"""Tolerance of the solution that tells where nodes touch, over that of the step."""


@kernel()
def approach(pose: Pose, scene: Scene, state: FaceState, dt: float, work: Scratch) -> tuple[float, int, int, bool]:
    """Write first guess, target and road normal of every node to `work`.

    Returns dq/dw over the step (Pa), the first node that touches or may touch, the last one plus 1 (0, 0: none), and
    whether a free node may touch.
    """
    solid, road = scene.solid, scene.road
    n, terms = state.w.shape[0], solid.moduli.size
    stiffening = solid.long_term
    for j in range(terms):
        x = dt / solid.relaxation_times[j]
        work.decay[j] = math.exp(-x)
        stiffening += solid.moduli[j] * (-math.expm1(-x) / x)
    _relax(solid, state, work)
    first, last, lands = n, 0, False
    q, relaxed = work.q, work.relaxed
    ahead = np.empty(3)
    turn = turn_of(road, dt)
    for i in range(n):
        before = state.code[i]
        work.before[i] = before
        for c in range(3):
            ahead[c] = state.w[i, c] + state.rate[i, c] * dt
            q[i, c] = relaxed[i, c] + stiffening * state.rate[i, c] * dt
        if aim(i, ahead[0], ahead[1], ahead[2], pose, scene, state, stiffening, turn, work):
            first, last = min(first, i), i + 1
            lands = lands or before == FREE
        if before == STICK:
            q[i] = work.target[i]
    if last == 0:
        first = 0
    return stiffening, first, last, lands


@kernel()
def hold(
    operator: Operator,
    windows: Windows,
    begin: int,
    end: int,
    lands: bool,
    pose: Pose,
    scene: Scene,
    tempo: Tempo,
    state: FaceState,
    work: Scratch,
) -> int:
    """Solve the contact of the nodes begin..end with the window's `operator`; return the number of sweeps.

    Nodes outside are free of force, and their q follows from the forces. Where a free node `lands`, a rough solution
    comes first, which tells where.
    """
    n = state.w.shape[0]
    state.force[:] = 0.0
    for i in range(n):
        if i < begin or i >= end:
            state.code[i] = FREE
        else:
            state.code[i] = work.before[i]
    sweeps = 0
    if end > begin:
        q = work.q[begin:end]
        force = state.force[begin:end]
        loads(operator, windows.even, windows.odd, q.ravel(), force.ravel())
        area = scene.face.area[begin:end]
        codes = state.code[begin:end]
        nodes = ContactNodes(
            q, force, work.target[begin:end], work.normal[begin:end], area, work.before[begin:end], codes
        )
        solver = scene.solver
        if lands:
            solver = Solver(ROUGH * solver.tolerance, solver.most_sweeps)
        sweeps = solve_contact(operator.whole, nodes, tempo, scene.law, solver, state.scale[0])
        if retouch(operator.whole, nodes, begin, pose, scene, state, tempo, work):
            sweeps += solve_contact(operator.whole, nodes, tempo, scene.law, scene.solver, state.scale[0])
        for i in range(begin, end):
            if state.code[i] == FREE:
                state.force[i] = 0.0
    _follow(scene.face.compliance, state.code, state.force, begin, end, work.moved.ravel(), work.q)
    return sweeps


@kernel()
def widest(
    pose: Pose, scene: Scene, state: FaceState, tempo: Tempo, begin: int, end: int, work: Scratch
) -> tuple[int, int]:
    """Return a window that also holds the nodes outside begin..end that the solution would sink into the road."""
    road = scene.road
    cosine, sine = math.cos(pose.angle), math.sin(pose.angle)
    n = state.w.shape[0]
    first, last = (begin, end) if end > begin else (n, 0)
    for i in range(n):
        if begin <= i < end:
            continue
        wx = state.w[i, 0] + (work.q[i, 0] - work.relaxed[i, 0]) / tempo.stiffening
        wy = state.w[i, 1] + (work.q[i, 1] - work.relaxed[i, 1]) / tempo.stiffening
        fx, fy = pose.unloaded[i, 0] + wx, pose.unloaded[i, 1] + wy
        height = gap(pose.x + cosine * fx - sine * fy, pose.y + sine * fx + cosine * fy, road.radius, pose.rise)
        if height < -SUNK:
            first, last = min(first, i), max(last, i + 1)
    return (first, last) if last > 0 else (0, 0)


@kernel()
def settle(pose: Pose, solid: Solid, state: FaceState, tempo: Tempo, work: Scratch) -> tuple[float, float]:
    """Move displacements, memory and positions on; return the force on the face in the axle frame (x, y), N."""
    n, terms = state.w.shape[0], solid.moduli.size
    dt = tempo.dt
    for i in range(n):
        for c in range(3):
            change = (work.q[i, c] - work.relaxed[i, c]) / tempo.stiffening
            state.rate[i, c] = change / dt
            state.w[i, c] += change
    for j in range(terms):
        weight = solid.relaxation_times[j] * (1.0 - work.decay[j])
        _fade(state.memory[j], work.decay[j], weight, state.rate)
    put(pose, state)
    cosine, sine = math.cos(pose.angle), math.sin(pose.angle)
    sum_x, sum_y, largest = 0.0, 0.0, 0.0
    for i in range(n):
        if state.code[i] != FREE:
            sum_x += cosine * state.force[i, 0] - sine * state.force[i, 1]
            up = sine * state.force[i, 0] + cosine * state.force[i, 1]
            sum_y += up
            largest = max(largest, up)
    state.scale[0] = max(largest, 1e-3)
    return sum_x, sum_y


@kernel(reorder=True)
def _relax(solid: Solid, state: FaceState, work: Scratch) -> None:
    """What is left of q when w stands still over the step."""
    relaxed = work.relaxed.ravel()
    w = state.w.ravel()
    for i in range(relaxed.size):
        relaxed[i] = solid.long_term * w[i]
    for j in range(solid.moduli.size):
        weight = solid.moduli[j] * work.decay[j]
        memory = state.memory[j].ravel()
        for i in range(relaxed.size):
            relaxed[i] += weight * memory[i]


@kernel(reorder=True)
def _fade(memory: Array, decay: float, weight: float, rate: Array) -> None:
    flat, flow = memory.ravel(), rate.ravel()
    for i in range(flat.size):
        flat[i] = decay * flat[i] + weight * flow[i]


@kernel()
def _follow(compliance: Singles, code: Integers, force: Array, begin: int, end: int, moved: Singles, q: Array) -> None:
    """Set q of every free node to what the forces on the nodes begin..end make of it."""
    n = q.shape[0]
    free = 0
    for i in range(n):
        if code[i] == FREE:
            free += 1
    if free == 0:
        return
    if n * (n - free) < free * (end - begin):  # the fewer numbers of the matrix are read, the faster
        moved[:] = 0.0
        for i in range(begin, end):
            if code[i] != FREE:
                _add_rows(compliance, i, force[i, 0], force[i, 1], force[i, 2], moved)
        for i in range(n):
            if code[i] == FREE:
                for c in range(3):
                    q[i, c] = moved[3 * i + c]
    else:
        load = force.ravel()[3 * begin : 3 * end].astype(np.float32)
        for i in range(n):
            if code[i] == FREE:
                for c in range(3):
                    q[i, c] = _dot(compliance[3 * i + c, 3 * begin : 3 * end], load)


@kernel(reorder=True)
def _add_rows(compliance: Singles, i: int, fx: float, fy: float, fz: float, moved: Singles) -> None:
    sx, sy, sz = np.float32(fx), np.float32(fy), np.float32(fz)
    r0, r1, r2 = compliance[3 * i], compliance[3 * i + 1], compliance[3 * i + 2]
    for j in range(moved.size):
        moved[j] += r0[j] * sx + r1[j] * sy + r2[j] * sz


@kernel(reorder=True)
def _dot(a: Singles, b: Singles) -> np.float32:
    total = np.float32(0.0)
    for j in range(b.size):
        total += a[j] * b[j]
    return total


@kernel()
def put(pose: Pose, state: FaceState) -> None:
    """Write the axle-frame positions of the face's nodes."""
    w, place = state.w, state.place
    cosine, sine = math.cos(pose.angle), math.sin(pose.angle)
    unloaded = pose.unloaded
    for i in range(w.shape[0]):
        x, y = unloaded[i, 0] + w[i, 0], unloaded[i, 1] + w[i, 1]
        place[i, 0] = pose.x + cosine * x - sine * y
        place[i, 1] = pose.y + sine * x + cosine * y
        place[i, 2] = unloaded[i, 2] + w[i, 2]
