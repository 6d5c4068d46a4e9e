"""March of a condensed viscoelastic block through its pass, quasi-static, in compiled code."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...kernels import kernel
from .contact import FREE, SLIP, solve_contact

Array = NDArray[np.float64]
Singles = NDArray[np.float32]
Integers = NDArray[np.int64]


@kernel()
def march(
    time: Array,
    origin: Array,
    angle: Array,
    unloaded: Array,
    area: Array,
    stiffness: Singles,
    long_term: float,
    moduli: Array,
    relaxation_times: Array,
    road_radius: float,
    road_speed: float,
    stretch: Array,
    static_coefficient: float,
    code: int,
    parameters: Array,
    pressures: Array,
    slip_speeds: Array,
    table: Array,
    tolerance: float,
    most_sweeps: int,
) -> tuple[Array, Array, Integers, Integers]:
    """Return force (m, n, 3) in N in the axle frame, displacement w (m, n, 3) in m, state (m, n) and sweeps (m,).

    Parameters
    ----------
    time, origin, angle, unloaded : as in `Motion`
    area : (n,) array, m2
    stiffness : (3 n, 3 n) array of float32, N/m per Pa
        Single precision: the sweeps run at the speed of memory, and their tolerance is far coarser.
    long_term, moduli, relaxation_times : Pa, (k,) Pa, (k,) s
    road_radius : float, m
        Of the circle with its top at the axle frame's origin; inf for the plane y = 0.
    road_speed : float, m/s
        Towards +x at the top.
    stretch : (2,) array, 1/m
        Relative growth of the elastic resistance per metre of compression: normal, tangential (0, 0 is small strain).
    tolerance : float
        Convergence of the nodal forces relative to the largest one.
    """
    steps, n = unloaded.shape[0], unloaded.shape[1]
    terms = moduli.size
    force_out = np.zeros((steps, n, 3))
    w_out = np.zeros((steps, n, 3))
    state_out = np.zeros((steps, n), dtype=np.int64)
    sweeps = np.zeros(steps, dtype=np.int64)
    w = np.zeros((n, 3))
    memory = np.zeros((terms, n, 3))
    relaxed = np.zeros((n, 3))
    q = np.zeros((n, 3))
    q_target = np.zeros((n, 3))
    normal = np.zeros((n, 2))
    state = np.zeros(n, dtype=np.int64)
    rate = np.zeros((n, 3))
    place = np.empty((n, 3))
    _positions(unloaded[0], w, origin[0], angle[0], stretch, place)
    decay = np.empty(terms)
    ahead = np.empty(3)
    largest = 1e-3
    for k in range(1, steps):
        dt = time[k] - time[k - 1]
        cosine, sine = math.cos(angle[k]), math.sin(angle[k])
        stiffening = long_term
        for j in range(terms):
            x = dt / relaxation_times[j]
            decay[j] = math.exp(-x)
            stiffening += moduli[j] * (-math.expm1(-x) / x)
        relaxed[:] = long_term * w
        for j in range(terms):
            relaxed += (moduli[j] * decay[j]) * memory[j]
        before = state.copy()
        for i in range(n):
            for c in range(3):
                ahead[c] = w[i, c] + rate[i, c] * dt
            tx, ty, tz, nx, ny = _carried(
                place[i],
                unloaded[k, i],
                ahead,
                before[i],
                origin[k],
                cosine,
                sine,
                stretch,
                road_radius,
                road_speed,
                dt,
            )
            # into the block's frame, less the unloaded place, stretched: the displacement that the road imposes
            gx, gy = tx - origin[k, 0], ty - origin[k, 1]
            ux = cosine * gx + sine * gy - unloaded[k, i, 0]
            uy = cosine * gy - sine * gx - unloaded[k, i, 1]
            uz = tz - unloaded[k, i, 2]
            pressed = max(uy, 0.0)
            shear = 1.0 + stretch[1] * pressed
            q_target[i, 0] = relaxed[i, 0] + stiffening * (ux * shear - w[i, 0])
            q_target[i, 1] = relaxed[i, 1] + stiffening * (uy * (1.0 + stretch[0] * pressed) - w[i, 1])
            q_target[i, 2] = relaxed[i, 2] + stiffening * (uz * shear - w[i, 2])
            normal[i, 0] = cosine * nx + sine * ny
            normal[i, 1] = cosine * ny - sine * nx
            if before[i] == FREE or before[i] == SLIP:
                for c in range(3):
                    q[i, c] = relaxed[i, c] + stiffening * rate[i, c] * dt
            else:
                q[i] = q_target[i]
        force = np.dot(stiffness, q.reshape(3 * n).astype(np.float32)).astype(np.float64).reshape(n, 3)
        sweeps[k] = solve_contact(
            stiffness, q, force, q_target, normal, area, before, state, stiffening, dt,
            static_coefficient, code, parameters, pressures, slip_speeds, table,
            tolerance * largest, most_sweeps,
        )  # fmt: skip
        for i in range(n):
            for c in range(3):
                change = (q[i, c] - relaxed[i, c]) / stiffening
                rate[i, c] = change / dt
                w[i, c] += change
        for j in range(terms):
            weight = relaxation_times[j] / dt * (1.0 - decay[j])
            memory[j] = decay[j] * memory[j] + (weight * dt) * rate
        _positions(unloaded[k], w, origin[k], angle[k], stretch, place)
        total = 0.0
        for i in range(n):
            if state[i] != FREE:
                force_out[k, i, 0] = cosine * force[i, 0] - sine * force[i, 1]
                force_out[k, i, 1] = sine * force[i, 0] + cosine * force[i, 1]
                force_out[k, i, 2] = force[i, 2]
                total = max(total, force_out[k, i, 1])
        largest = max(total, 1e-3)
        w_out[k] = w
        state_out[k] = state
    return force_out, w_out, state_out, sweeps


@kernel()
def _actual(w: float, factor: float) -> float:
    """Solve d (1 + factor d) = w for the compression d; where the face is drawn out, d = w."""
    if factor == 0.0 or w <= 0.0:
        return w
    return 2.0 * w / (1.0 + math.sqrt(1.0 + 4.0 * factor * w))


@kernel()
def _positions(unloaded: Array, w: Array, origin: Array, angle: float, stretch: Array, place: Array) -> None:
    """Write the axle-frame positions of the face's nodes into `place`."""
    cosine, sine = math.cos(angle), math.sin(angle)
    for i in range(w.shape[0]):
        dy = _actual(w[i, 1], stretch[0])
        shear = 1.0 + stretch[1] * max(dy, 0.0)
        x, y = unloaded[i, 0] + w[i, 0] / shear, unloaded[i, 1] + dy
        place[i, 0] = origin[0] + cosine * x - sine * y
        place[i, 1] = origin[1] + sine * x + cosine * y
        place[i, 2] = unloaded[i, 2] + w[i, 2] / shear


@kernel()
def _carried(
    place: Array,
    unloaded: Array,
    w: Array,
    before: int,
    origin: Array,
    cosine: float,
    sine: float,
    stretch: Array,
    road_radius: float,
    road_speed: float,
    dt: float,
) -> tuple[float, float, float, float, float]:
    """Return where the road carries a node from `place` in a step (x, y, z), and the road's normal there (x, y).

    A node that was free moves with its mount and its neighbours (`w`: where its displacement is heading) until it
    touches, part of the step, and with the road for the rest.
    """
    x, y, z = place[0], place[1], place[2]
    rest = 1.0
    if before == FREE:
        dy = _actual(w[1], stretch[0])
        shear = 1.0 + stretch[1] * max(dy, 0.0)
        fx, fy = unloaded[0] + w[0] / shear, unloaded[1] + dy
        ax, ay = origin[0] + cosine * fx - sine * fy, origin[1] + sine * fx + cosine * fy
        az = unloaded[2] + w[2] / shear
        old, new = _gap(x, y, road_radius), _gap(ax, ay, road_radius)
        part = 1.0
        if new < 0.0:
            part = min(max(old / (old - new), 0.0), 1.0) if old > 0.0 else 0.0
        x, y, z = x + part * (ax - x), y + part * (ay - y), z + part * (az - z)
        rest = 1.0 - part
    if math.isinf(road_radius):
        return x + rest * dt * road_speed, 0.0, z, 0.0, 1.0
    turn = math.atan2(x, y + road_radius) + rest * dt * road_speed / road_radius
    nx, ny = math.sin(turn), math.cos(turn)
    return road_radius * nx, road_radius * (ny - 1.0), z, nx, ny


@kernel()
def _gap(x: float, y: float, road_radius: float) -> float:
    if math.isinf(road_radius):
        return y
    return math.hypot(x, y + road_radius) - road_radius
