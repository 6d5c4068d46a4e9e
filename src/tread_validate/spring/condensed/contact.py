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
LEAST_CORE = 24
"""Nodes of a core that are worth the second pass over the rows of the matrix."""
OVER = 1.3
"""Over-relaxation of free nodes: a fifth fewer sweeps; more does not help."""

Three = tuple[float, float, float]
Six = tuple[float, float, float, float, float, float]


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

    A sweep over all nodes is followed by sweeps over those outside the core, the longest run of sticking nodes: what
    they do to each other is all they need; the forces on the core follow when they have settled.

    Parameters
    ----------
    operator : (3 n, 3 n) array, N/m per Pa
    scale : float, N
        Largest nodal force: sweeps stop when none changes by more than `solver.tolerance` times this.
    """
    n = nodes.q.shape[0]
    tolerance = solver.tolerance * scale
    late, force = np.zeros((n, 3)), nodes.force.ravel()
    sweep, begin, end = 0, n, n
    while sweep < solver.most_sweeps:
        largest = _sweep(operator, nodes, force, begin, end, tempo, law, tolerance, sweep, late)
        sweep += 1
        if largest < tolerance or sweep == solver.most_sweeps:
            if begin == end:
                break
            _catch_up(operator, force, late, begin, end)
            begin, end = n, n
        elif begin == end:
            begin, end = _core(nodes.state)
            late[:] = 0.0
    return sweep


@kernel()
def _core(state: Integers) -> tuple[int, int]:
    """Return the longest run of nodes that stick; (n, n) if it is short."""
    first, last, begin = 0, 0, 0
    for i in range(state.size + 1):
        if i == state.size or state[i] != STICK:
            if i - begin > last - first:
                first, last = begin, i
            begin = i + 1
    return (first, last) if last - first >= LEAST_CORE else (state.size, state.size)


@kernel()
def _catch_up(operator: Singles, force: Array, late: Array, begin: int, end: int) -> None:
    """Add to the forces on the nodes begin..end what the others' changes of q, `late`, made of them."""
    for i in range(late.shape[0]):
        if late[i, 0] != 0.0 or late[i, 1] != 0.0 or late[i, 2] != 0.0:
            spread(operator, force, i, late[i, 0], late[i, 1], late[i, 2], begin, end)


@kernel()
def _sweep(
    operator: Singles,
    nodes: ContactNodes,
    force: Array,
    begin: int,
    end: int,
    tempo: Tempo,
    law: KernelLaw,
    tolerance: float,
    sweep: int,
    late: Array,
) -> float:
    """Solve node after node, all others as they are, but for those of the core begin..end.

    Forces on the core are left behind, and the changes of q noted in `late`. Returns the largest change of a force, N.
    """
    q, target, normal, state = nodes.q, nodes.target, nodes.normal, nodes.state
    before, area = nodes.before, nodes.area
    n = q.shape[0]
    count, largest = n - (end - begin), 0.0
    for visit in range(count):
        i = visit if sweep % 2 == 0 else count - 1 - visit
        if i >= begin:
            i += end - begin
        if area[i] == 0.0:
            continue
        nx, ny = normal[i, 0], normal[i, 1]
        fx, fy = force[3 * i], force[3 * i + 1]
        f = nx * fx + ny * fy, ny * fx - nx * fy, force[3 * i + 2]
        # how far the node is from moving with the road, in local axes
        gx, gy = q[i, 0] - target[i, 0], q[i, 1] - target[i, 1]
        g = nx * gx + ny * gy, ny * gx - nx * gy, q[i, 2] - target[i, 2]
        if state[i] == STICK and before[i] == STICK and g[0] == 0.0 and g[1] == 0.0 and g[2] == 0.0:
            bound = law.static_coefficient * f[0]
            if f[0] > 0.0 and f[1] * f[1] + f[2] * f[2] <= bound * bound:
                continue
        a = _local(operator, i, nx, ny)
        stuck0 = f[0] - a[0] * g[0] - a[1] * g[1] - a[2] * g[2]
        stuck1 = f[1] - a[1] * g[0] - a[3] * g[1] - a[4] * g[2]
        stuck2 = f[2] - a[2] * g[0] - a[4] * g[1] - a[5] * g[2]
        pull = math.sqrt(stuck1 * stuck1 + stuck2 * stuck2)
        sticks = stuck0 > 0.0 and pull <= law.static_coefficient * stuck0
        # late sweeps do not let a node go back and forth between the static and the lower kinetic limit
        if sticks and (before[i] == SLIP or (state[i] == SLIP and sweep >= SETTLING)):
            sticks = pull <= _kinetic(law, stuck0 / area[i], 0.0) * stuck0
        if sticks:
            state[i] = STICK
            d = -g[0], -g[1], -g[2]
        else:
            sliding, d = False, (0.0, 0.0, 0.0)
            if stuck0 > 0.0 or state[i] != FREE:
                sliding, d = _slide(a, f, g, area[i], tempo, law, SLIDING * tolerance)
            if not sliding:
                d = _release(a, f)
                if state[i] == FREE and g[0] + OVER * d[0] > 0.0:
                    d = OVER * d[0], OVER * d[1], OVER * d[2]
                if g[0] + d[0] < 0.0:
                    # a free node would sink into the road: it touches, and slides there
                    sliding, slid = True, _slide(a, f, g, area[i], tempo, law, SLIDING * tolerance)
                    d = slid[1] if slid[0] else d
            state[i] = SLIP if sliding else FREE
        dx, dy, dz = nx * d[0] + ny * d[1], ny * d[0] - nx * d[1], d[2]
        change = max(abs(dx), abs(dy), abs(dz)) * a[0]
        if change > LAZY * tolerance:
            if state[i] == STICK:  # exactly where the road holds it
                q[i, 0], q[i, 1], q[i, 2] = target[i, 0], target[i, 1], target[i, 2]
            else:
                q[i, 0] += dx
                q[i, 1] += dy
                q[i, 2] += dz
            spread(operator, force, i, dx, dy, dz, 0, begin)
            if begin < n:
                spread(operator, force, i, dx, dy, dz, end, n)
                late[i, 0] += dx
                late[i, 1] += dy
                late[i, 2] += dz
            largest = max(largest, change)
    return largest


@kernel()
def _local(operator: Singles, i: int, nx: float, ny: float) -> Six:
    """Turn the node's own 3 x 3 stiffness into axes (normal, along, across): its upper triangle, row by row."""
    j = 3 * i
    xx, xy, yy = float(operator[j, j]), float(operator[j, j + 1]), float(operator[j + 1, j + 1])
    xz, yz = float(operator[j, j + 2]), float(operator[j + 1, j + 2])
    return (
        nx * nx * xx + 2.0 * nx * ny * xy + ny * ny * yy,
        nx * ny * (xx - yy) + (ny * ny - nx * nx) * xy,
        nx * xz + ny * yz,
        ny * ny * xx - 2.0 * nx * ny * xy + nx * nx * yy,
        ny * xz - nx * yz,
        float(operator[j + 2, j + 2]),
    )


@kernel()
def _release(a: Six, f: Three) -> Three:
    """Return the change of q that frees the node of all force: a d = -f (Cholesky of a 3 x 3 matrix)."""
    l00 = math.sqrt(a[0])
    l10, l20 = a[1] / l00, a[2] / l00
    l11 = math.sqrt(a[3] - l10 * l10)
    l21 = (a[4] - l20 * l10) / l11
    l22 = math.sqrt(a[5] - l20 * l20 - l21 * l21)
    y0 = -f[0] / l00
    y1 = (-f[1] - l10 * y0) / l11
    y2 = (-f[2] - l20 * y0 - l21 * y1) / l22
    d2 = y2 / l22
    d1 = (y1 - l21 * d2) / l11
    return (y0 - l10 * d1 - l20 * d2) / l00, d1, d2


@kernel()
def _slide(a: Six, f: Three, g: Three, area: float, tempo: Tempo, law: KernelLaw, close: float) -> tuple[bool, Three]:
    """Take one step towards the sliding solution of a node on the road; False where it would be pulled at.

    The fixed point has the friction force opposite to the slip, of size mu(p, v) times the normal force: f = P(f - r s)
    with r any stiffness and P the projection on to the friction disk, which is exact also where the node's tangential
    stiffness differs between its two directions.
    """
    # put the node on the road first, its slip as it is
    f0, f1, f2 = f[0] - a[0] * g[0], f[1] - a[1] * g[0], f[2] - a[2] * g[0]
    if f0 <= 0.0:
        return False, (0.0, 0.0, 0.0)
    mean = 0.5 * (a[3] + a[5]) if a[5] < 1.5 * a[3] else a[3]
    slip = math.sqrt(g[1] * g[1] + g[2] * g[2])
    e1, e2 = f1 - mean * g[1], f2 - mean * g[2]
    length = math.sqrt(e1 * e1 + e2 * e2)
    if length == 0.0:
        return True, (-g[0], 0.0, 0.0)
    # size of the slip: length - mean g - mu(p, v) N = 0 falls with g; a Newton step, then secants, within a bracket
    pressure = f0 / area
    to_speed = 1.0 / (tempo.stiffening * tempo.dt)
    low, high = 0.0, length / mean
    slip = min(slip, high)
    size = length - mean * slip
    slope, last, last_value = 0.0, 0.0, 0.0
    for k in range(30):
        mu = _kinetic(law, pressure, slip * to_speed)
        value = length - mean * slip - mu * f0
        size = length - mean * slip
        if abs(value) <= close:
            break
        if value > 0.0:
            low = slip
        else:
            high = slip
        if k == 0:
            ahead = 1.001 * slip + 1e-9 * high
            more = _kinetic(law, pressure, ahead * to_speed)
            slope = -mean - f0 * (more - mu) / (ahead - slip)
        elif slip != last:
            slope = (value - last_value) / (slip - last)
        last, last_value = slip, value
        slip = slip - value / slope if slope < 0.0 else low
        if not low < slip < high:
            slip = 0.5 * (low + high)
        if high - low < 1e-9 * length / mean:
            break
    c1, c2 = size * e1 / length - f1, size * e2 / length - f2
    determinant = a[3] * a[5] - a[4] * a[4]
    return True, (-g[0], (a[5] * c1 - a[4] * c2) / determinant, (a[3] * c2 - a[4] * c1) / determinant)


@kernel(reorder=True)
def spread(operator: Singles, force: Array, i: int, dx: float, dy: float, dz: float, begin: int, end: int) -> None:
    """Add the forces that a change of one node's q makes on the nodes begin..end (rows of the symmetric matrix)."""
    sx, sy, sz = np.float32(dx), np.float32(dy), np.float32(dz)
    # without a sign, so that no index counts from the end and the loop uses vector units; views would cost more
    x, y, z = np.uintp(3 * i), np.uintp(3 * i + 1), np.uintp(3 * i + 2)
    for j in range(np.uintp(3 * begin), np.uintp(3 * end)):
        force[j] += operator[x, j] * sx + operator[y, j] * sy + operator[z, j] * sz
