"""One contact problem: the forces on the face's nodes when a rigid road meets them, with dry friction.

Unknowns are the relaxed displacements q = int E(t - s) dw/ds ds (m Pa) of the nodes of a window; forces are M q with M
the stiffness of the window when all other nodes of the face are free of force. Sweeps of projected Gauss-Seidel visit
the nodes in turn; a node that sticks where it should costs nothing, since its q is known.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...friction import kinetic_kernel
from ...kernels import kernel
from ..inputs import KernelLaw
from .inputs import FREE, SLIP, STICK, Array, Integers, Singles, Solver

SETTLING = 8
"""Sweeps after which a node that slips is held to the lower limit of sliding, so that it cannot cycle."""
LAZY = 0.2
"""A change below this fraction of the tolerance is not worth a pass over the matrix."""
SLIDING = 0.1
"""Error of a node's friction force within a sweep over the tolerance; the next sweep starts from it."""
OVER = 1.3
"""Over-relaxation of free nodes: a fifth fewer sweeps; more does not help."""


class ContactNodes(NamedTuple):
    """The nodes of a contact problem.

    Attributes
    ----------
    q : (n, 3) array, m Pa
        First guess, and result; components x, y, z of the block's frame.
    force : (n, 3) array, N
        operator @ q of the first guess, and of the result: force of the road on the block.
    target : (n, 3) array, m Pa
        q of a node that touches and moves with the road.
    normal : (n, 2) array
        Unit normal of the road (x, y), towards the block.
    area : (n,) array, m2
    before : (n,) array of int
        States at the end of the step before: a node that slipped sticks again only when its slip speed passes zero.
    state : (n,) array of int
    """

    q: Array
    force: Array
    target: Array
    normal: Array
    area: Array
    before: Integers
    state: Integers


class Tempo(NamedTuple):
    """dq/dw over a step (Pa), and the step's length (s)."""

    stiffening: float
    dt: float


@kernel()
def _kinetic(law: KernelLaw, pressure: float, speed: float) -> float:
    return kinetic_kernel(law.code, law.parameters, law.pressures, law.slip_speeds, law.table, pressure, speed)


@kernel()
def solve_contact(
    operator: Singles, nodes: ContactNodes, tempo: Tempo, law: KernelLaw, solver: Solver, scale: float
) -> int:
    """Solve in place for q, force and state; return the number of sweeps.

    Parameters
    ----------
    operator : (3 n, 3 n) array, N/m per Pa
    scale : float, N
        Largest nodal force: sweeps stop when none changes by more than `solver.tolerance` times this.
    """
    q, force, target, normal, state = nodes.q, nodes.force, nodes.target, nodes.normal, nodes.state
    tolerance = solver.tolerance * scale
    n = q.shape[0]
    a = np.empty((3, 3))
    f = np.empty(3)
    d = np.empty(3)
    for sweep in range(solver.most_sweeps):
        largest = 0.0
        for visit in range(n):
            i = visit if sweep % 2 == 0 else n - 1 - visit
            if nodes.area[i] == 0.0:
                continue
            nx, ny = normal[i, 0], normal[i, 1]
            f[0] = nx * force[i, 0] + ny * force[i, 1]
            f[1] = ny * force[i, 0] - nx * force[i, 1]
            f[2] = force[i, 2]
            # how far the node is from moving with the road, in local axes
            gx, gy = q[i, 0] - target[i, 0], q[i, 1] - target[i, 1]
            g0 = nx * gx + ny * gy
            g1 = ny * gx - nx * gy
            g2 = q[i, 2] - target[i, 2]
            if state[i] == STICK and nodes.before[i] == STICK and g0 == 0.0 and g1 == 0.0 and g2 == 0.0:
                bound = law.static_coefficient * f[0]
                if f[0] > 0.0 and f[1] * f[1] + f[2] * f[2] <= bound * bound:
                    continue
            _local(operator, i, nx, ny, a)
            stuck0 = f[0] - a[0, 0] * g0 - a[0, 1] * g1 - a[0, 2] * g2
            stuck1 = f[1] - a[1, 0] * g0 - a[1, 1] * g1 - a[1, 2] * g2
            stuck2 = f[2] - a[2, 0] * g0 - a[2, 1] * g1 - a[2, 2] * g2
            pull = math.hypot(stuck1, stuck2)
            limit = law.static_coefficient
            sticks = stuck0 > 0.0 and pull <= limit * stuck0
            # late sweeps do not let a node go back and forth between the static and the lower kinetic limit
            if sticks and (nodes.before[i] == SLIP or (state[i] == SLIP and sweep >= SETTLING)):
                sticks = pull <= _kinetic(law, stuck0 / nodes.area[i], 0.0) * stuck0
            if sticks:
                state[i] = STICK
                d[0], d[1], d[2] = -g0, -g1, -g2
            else:
                sliding = False
                if stuck0 > 0.0 or state[i] != FREE:
                    sliding = _slide(a, f, g0, g1, g2, nodes.area[i], tempo, law, SLIDING * tolerance, d)
                if sliding:
                    state[i] = SLIP
                else:
                    _release(a, f, d)
                    if state[i] == FREE and g0 + OVER * d[0] > 0.0:
                        d *= OVER
                    if g0 + d[0] < 0.0:
                        # a free node would sink into the road: it touches, and slides there
                        state[i] = SLIP
                        _slide(a, f, g0, g1, g2, nodes.area[i], tempo, law, SLIDING * tolerance, d)
                    else:
                        state[i] = FREE
            dx, dy = nx * d[0] + ny * d[1], ny * d[0] - nx * d[1]
            change = max(abs(dx), abs(dy), abs(d[2])) * a[0, 0]
            if change > LAZY * tolerance:
                if state[i] == STICK:  # exactly where the road holds it
                    q[i] = target[i]
                else:
                    q[i, 0] += dx
                    q[i, 1] += dy
                    q[i, 2] += d[2]
                _spread(operator, force, i, dx, dy, d[2])
                largest = max(largest, change)
        if largest < tolerance:
            return sweep + 1
    return solver.most_sweeps


@kernel()
def _local(operator: Singles, i: int, nx: float, ny: float, a: Array) -> None:
    """Turn the node's own 3 x 3 stiffness into axes (normal, along, across)."""
    j = 3 * i
    xx, xy, yy = float(operator[j, j]), float(operator[j, j + 1]), float(operator[j + 1, j + 1])
    xz, yz = float(operator[j, j + 2]), float(operator[j + 1, j + 2])
    a[0, 0] = nx * nx * xx + 2.0 * nx * ny * xy + ny * ny * yy
    a[1, 1] = ny * ny * xx - 2.0 * nx * ny * xy + nx * nx * yy
    a[0, 1] = nx * ny * (xx - yy) + (ny * ny - nx * nx) * xy
    a[1, 0] = a[0, 1]
    a[0, 2] = nx * xz + ny * yz
    a[2, 0] = a[0, 2]
    a[1, 2] = ny * xz - nx * yz
    a[2, 1] = a[1, 2]
    a[2, 2] = operator[j + 2, j + 2]


@kernel()
def _release(a: Array, f: Array, d: Array) -> None:
    """Change of q that frees the node of all force: a d = -f (Cholesky of a 3 x 3 matrix)."""
    l00 = math.sqrt(a[0, 0])
    l10, l20 = a[1, 0] / l00, a[2, 0] / l00
    l11 = math.sqrt(a[1, 1] - l10 * l10)
    l21 = (a[2, 1] - l20 * l10) / l11
    l22 = math.sqrt(a[2, 2] - l20 * l20 - l21 * l21)
    y0 = -f[0] / l00
    y1 = (-f[1] - l10 * y0) / l11
    y2 = (-f[2] - l20 * y0 - l21 * y1) / l22
    d[2] = y2 / l22
    d[1] = (y1 - l21 * d[2]) / l11
    d[0] = (y0 - l10 * d[1] - l20 * d[2]) / l00


@kernel()
def _slide(
    a: Array,
    f: Array,
    g0: float,
    g1: float,
    g2: float,
    area: float,
    tempo: Tempo,
    law: KernelLaw,
    close: float,
    d: Array,
) -> bool:
    """One step towards the sliding solution of a node on the road; False where it would be pulled at.

    The fixed point has the friction force opposite to the slip, of size mu(p, v) times the normal force: f = P(f - r s)
    with r any stiffness and P the projection on to the friction disk, which is exact also where the node's tangential
    stiffness differs between its two directions.
    """
    # put the node on the road first, its slip as it is
    f0 = f[0] - a[0, 0] * g0
    f1 = f[1] - a[1, 0] * g0
    f2 = f[2] - a[2, 0] * g0
    if f0 <= 0.0:
        return False
    mean = 0.5 * (a[1, 1] + a[2, 2]) if a[2, 2] < 1.5 * a[1, 1] else a[1, 1]
    slip = math.hypot(g1, g2)
    e1, e2 = f1 - mean * g1, f2 - mean * g2
    length = math.hypot(e1, e2)
    if length == 0.0:
        d[0], d[1], d[2] = -g0, 0.0, 0.0
        return True
    # size of the slip: length - mean g - mu(p, v) N = 0 falls with g; Newton, kept inside a bracket
    pressure = f0 / area
    to_speed = 1.0 / (tempo.stiffening * tempo.dt)
    low, high = 0.0, length / mean
    slip = min(slip, high)
    size = length - mean * slip
    for _ in range(30):
        mu = _kinetic(law, pressure, slip * to_speed)
        value = length - mean * slip - mu * f0
        size = length - mean * slip
        if abs(value) <= close:
            break
        if value > 0.0:
            low = slip
        else:
            high = slip
        ahead = 1.001 * slip + 1e-9 * high
        more = _kinetic(law, pressure, ahead * to_speed)
        slope = -mean - f0 * (more - mu) / (ahead - slip)
        slip = slip - value / slope if slope < 0.0 else low
        if not low < slip < high:
            slip = 0.5 * (low + high)
        if high - low < 1e-9 * length / mean:
            break
    c1, c2 = size * e1 / length - f1, size * e2 / length - f2
    determinant = a[1, 1] * a[2, 2] - a[1, 2] * a[1, 2]
    d[0] = -g0
    d[1] = (a[2, 2] * c1 - a[1, 2] * c2) / determinant
    d[2] = (a[1, 1] * c2 - a[1, 2] * c1) / determinant
    return True


@kernel(reorder=True)
def _spread(operator: Singles, force: Array, i: int, dx: float, dy: float, dz: float) -> None:
    """Add the forces that a change of one node's q makes everywhere (rows of the symmetric matrix)."""
    flat = force.ravel()
    sx, sy, sz = np.float32(dx), np.float32(dy), np.float32(dz)
    r0, r1, r2 = operator[3 * i], operator[3 * i + 1], operator[3 * i + 2]
    for j in range(flat.size):
        flat[j] += r0[j] * sx + r1[j] * sy + r2[j] * sz
