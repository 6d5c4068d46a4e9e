"""Where a free node meets the road within a step."""

from __future__ import annotations

import math

import numpy as np

from ...kernels import kernel
from .contact import ContactNodes, Tempo, Three, spread
from .inputs import FREE, STICK, Array, FaceState, Integers, Pose, RoadMotion, Scene, Scratch, Singles


@kernel()
def aim(
    i: int,
    wx: float,
    wy: float,
    wz: float,
    pose: Pose,
    scene: Scene,
    state: FaceState,
    stiffening: float,
    turn: Three,
    work: Scratch,
) -> bool:
    """Write target and road normal of a node whose displacement, free of force, would be (wx, wy, wz) after the step.

    Returns whether it touches or may touch.
    """
    road, target = scene.road, work.target
    cosine, sine = math.cos(pose.angle), math.sin(pose.angle)
    before = work.before[i]
    relaxed, place, unloaded = work.relaxed[i], state.place[i], pose.unloaded[i]
    x, y, z = place[0], place[1], place[2]
    rest = 1.0
    if before == FREE:
        # a free node moves with its mount and its neighbours (where its displacement is heading) until it
        # touches, part of the step, and with the road for the rest
        fx, fy = unloaded[0] + wx, unloaded[1] + wy
        ax, ay = pose.x + cosine * fx - sine * fy, pose.y + sine * fx + cosine * fy
        az = unloaded[2] + wz
        new = gap(ax, ay, road.radius, pose.rise)
        part = 1.0
        if new < 0.0:
            old = gap(x, y, road.radius, pose.rise)
            part = min(max(old / (old - new), 0.0), 1.0) if old > 0.0 else 0.0
        x, y, z = x + part * (ax - x), y + part * (ay - y), z + part * (az - z)
        rest = 1.0 - part
    travel = rest * turn[0]
    if math.isinf(road.radius):
        tx, ty, nx, ny = x + travel, pose.rise, 0.0, 1.0
    else:
        turned, across = turn[1], turn[2]
        if rest == 0.0:
            turned, across = 1.0, 0.0
        elif rest < 1.0:
            turned, across = math.cos(travel / road.radius), math.sin(travel / road.radius)
        up = y + road.radius
        far = 1.0 / math.sqrt(x * x + up * up)
        nx, ny = far * (x * turned + up * across), far * (up * turned - x * across)
        tx, ty = (road.radius + pose.rise) * nx, road.radius * (ny - 1.0) + pose.rise * ny
    # into the block's frame, less the unloaded place: the displacement that the road imposes
    gx, gy = tx - pose.x, ty - pose.y
    ux = cosine * gx + sine * gy - unloaded[0]
    uy = cosine * gy - sine * gx - unloaded[1]
    uz = z - unloaded[2]
    target[i, 0] = relaxed[0] + stiffening * (ux - state.w[i, 0])
    target[i, 1] = relaxed[1] + stiffening * (uy - state.w[i, 1])
    target[i, 2] = relaxed[2] + stiffening * (uz - state.w[i, 2])
    work.normal[i, 0] = cosine * nx + sine * ny
    work.normal[i, 1] = cosine * ny - sine * nx
    return before != FREE or rest > 0.0


@kernel()
def retouch(
    operator: Singles,
    nodes: ContactNodes,
    begin: int,
    pose: Pose,
    scene: Scene,
    state: FaceState,
    tempo: Tempo,
    work: Scratch,
) -> bool:
    """Let the nodes that touched within the step do so where they would have been, free of force, its neighbours held.

    `approach` had to guess from the last step's rates where free nodes are heading. Returns whether there are any.
    """
    count = 0
    touched = np.empty(nodes.state.size, dtype=np.int64)
    for i in range(nodes.state.size):
        if nodes.before[i] == FREE and nodes.state[i] != FREE:
            touched[count] = i
            count += 1
    if count == 0:
        return False
    freed = released(operator, nodes.force.ravel(), touched[:count])
    force = nodes.force.ravel()
    turn = turn_of(scene.road, tempo.dt)
    for a in range(count):
        i = touched[a]
        k = begin + i
        wx = state.w[k, 0] + (nodes.q[i, 0] - freed[3 * a] - work.relaxed[k, 0]) / tempo.stiffening
        wy = state.w[k, 1] + (nodes.q[i, 1] - freed[3 * a + 1] - work.relaxed[k, 1]) / tempo.stiffening
        wz = state.w[k, 2] + (nodes.q[i, 2] - freed[3 * a + 2] - work.relaxed[k, 2]) / tempo.stiffening
        aim(k, wx, wy, wz, pose, scene, state, tempo.stiffening, turn, work)
        if nodes.state[i] == STICK:
            x, y, z = nodes.target[i, 0], nodes.target[i, 1], nodes.target[i, 2]
            dx, dy, dz = x - nodes.q[i, 0], y - nodes.q[i, 1], z - nodes.q[i, 2]
            nodes.q[i, 0], nodes.q[i, 1], nodes.q[i, 2] = x, y, z
            spread(operator, force, i, dx, dy, dz, 0, nodes.state.size)
    return True


@kernel()
def released(operator: Singles, force: Array, some: Integers) -> Array:
    """Return the changes of q (3 k,) that would make `force` on some k nodes, all others held (Cholesky)."""
    size = 3 * some.size
    a, x = np.empty((size, size)), np.empty(size)
    for i in range(size):
        row = 3 * some[i // 3] + i % 3
        x[i] = force[row]
        for j in range(i + 1):
            a[i, j] = operator[row, 3 * some[j // 3] + j % 3]
    for i in range(size):
        for j in range(i + 1):
            total = a[i, j]
            for k in range(j):
                total -= a[i, k] * a[j, k]
            a[i, j] = math.sqrt(total) if i == j else total / a[j, j]
        total = x[i]
        for k in range(i):
            total -= a[i, k] * x[k]
        x[i] = total / a[i, i]
    for i in range(size - 1, -1, -1):
        total = x[i]
        for k in range(i + 1, size):
            total -= a[k, i] * x[k]
        x[i] = total / a[i, i]
    return x


@kernel()
def turn_of(road: RoadMotion, dt: float) -> Three:
    """Return the road's travel in a step (m), and cosine and sine of a round one's turn."""
    turn = dt * road.speed / road.radius
    return dt * road.speed, math.cos(turn), math.sin(turn)


@kernel()
def gap(x: float, y: float, road_radius: float, rise: float) -> float:
    """Return the height of a point above the road that stands proud by `rise`, m."""
    if math.isinf(road_radius):
        return y - rise
    return math.sqrt(x * x + (y + road_radius) * (y + road_radius)) - road_radius - rise
