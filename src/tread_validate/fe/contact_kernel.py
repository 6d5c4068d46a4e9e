"""Kinematic contact of slave nodes with rigid profiles, swept or revolved: predict, then correct.

The trial position of a slave node at the end of the increment, made without contact, is compared with the master where
it will be. A node that would be inside is put on the surface; the force that does this, m d/(dt dt_mean), is the
normal force. The tangential force that would stop its slip over the increment is the stick force; friction takes all
of it or the part that the law allows.

Works are those of the forces at the start of the increment over the mean of the velocities before and after it, for
which the balance of central differences is an identity (Belytschko, Liu and Moran, Nonlinear Finite Elements, 6.2.3).
The part of a normal force that finds the node approaching the master is the loss of the impact.
"""

from __future__ import annotations

import math

import numpy as np

from ..kernels import kernel
from .kernel_data import EXTERNAL, FRICTION, IMPACT, OPEN, SLIPS, STICKS

TWO_PI = 2.0 * math.pi


@kernel()
def clear_of(segments, x, y):  # type: ignore[no-untyped-def]  # numba types it
    """Whether (x, y) lies outside every line and circle that the profile's segments are parts of: no contact then."""
    for row in range(segments.shape[0]):
        dx, dy = x - segments[row, 1], y - segments[row, 2]
        if segments[row, 0] == 0.0:
            if dy * segments[row, 3] < dx * segments[row, 4]:
                return False
        elif segments[row, 4] * (dx * dx + dy * dy - segments[row, 3] ** 2) < 0.0:
            return False
    return True


@kernel()
def project(segments, x, y):  # type: ignore[no-untyped-def]  # numba types it
    """Return (gap, normal x, normal y) of the nearest point of a profile to (x, y); negative gaps lie inside."""
    best = np.inf
    gap = np.inf
    nx = 0.0
    ny = 0.0
    for row in range(segments.shape[0]):
        dx, dy = x - segments[row, 1], y - segments[row, 2]
        if segments[row, 0] == 0.0:
            tx, ty = segments[row, 3], segments[row, 4]
            along = dx * tx + dy * ty
            beyond = max(-along, along - segments[row, 5], 0.0)
            px, py = -ty, tx
            distance = dx * px + dy * py
        else:
            radius, side, sweep = segments[row, 3], segments[row, 4], segments[row, 6]
            r = math.sqrt(dx * dx + dy * dy)
            if r == 0.0:
                continue
            turn = (math.atan2(dy, dx) - segments[row, 5]) * (1.0 if sweep > 0.0 else -1.0)
            turn -= TWO_PI * math.floor(turn / TWO_PI)
            over = turn - abs(sweep)
            beyond = 0.0
            if over > 0.0:
                beyond = r * min(over, TWO_PI - turn)
            px, py = side * dx / r, side * dy / r
            distance = side * (r - radius)
        score = beyond + abs(distance)
        if beyond <= 1e-9 * (1.0 + abs(distance)) and score < best:
            best = score
            gap = distance
            nx = px
            ny = py
    return gap, nx, ny


@kernel()
def nodal_normals(x0, u, face, out):  # type: ignore[no-untyped-def]  # numba types it
    """Write the integrals of shape function times normal over a bilinear face (4 nodes) into `out` (4, 3); exact.

    With x = c0 + c1 r + c2 s + c3 r s the normal is c1 x c2 + r c1 x c3 + s c3 x c2.
    """
    for c in range(3):
        i, j = (c + 1) % 3, (c + 2) % 3
        i0, i1, i2, i3 = 3 * face[0] + i, 3 * face[1] + i, 3 * face[2] + i, 3 * face[3] + i
        j0, j1, j2, j3 = 3 * face[0] + j, 3 * face[1] + j, 3 * face[2] + j, 3 * face[3] + j
        p0, p1, p2, p3 = x0[i0] + u[i0], x0[i1] + u[i1], x0[i2] + u[i2], x0[i3] + u[i3]
        q0, q1, q2, q3 = x0[j0] + u[j0], x0[j1] + u[j1], x0[j2] + u[j2], x0[j3] + u[j3]
        pr, ps, prs = 0.25 * (p1 + p2 - p0 - p3), 0.25 * (p2 + p3 - p0 - p1), 0.25 * (p0 - p1 + p2 - p3)
        qr, qs, qrs = 0.25 * (q1 + q2 - q0 - q3), 0.25 * (q2 + q3 - q0 - q1), 0.25 * (q0 - q1 + q2 - q3)
        mean = pr * qs - qr * ps
        along_r = (pr * qrs - qr * prs) / 3.0
        along_s = (prs * qs - qrs * ps) / 3.0
        out[0, c] = mean - along_r - along_s
        out[1, c] = mean + along_r - along_s
        out[2, c] = mean + along_r + along_s
        out[3, c] = mean - along_r + along_s


@kernel()
def face_areas(faces, slaves, x0, u, area):  # type: ignore[no-untyped-def]  # numba types it
    """Write each slave node's share of the current area of the faces (k, 4: positions in `slaves`)."""
    normals = np.empty((4, 3))
    face = np.empty(4, dtype=np.int64)
    for k in range(slaves.size):
        area[k] = 0.0
    for k in range(faces.shape[0]):
        for a in range(4):
            face[a] = slaves[faces[k, a]]
        nodal_normals(x0, u, face, normals)
        for a in range(4):
            area[faces[k, a]] += math.sqrt(normals[a, 0] ** 2 + normals[a, 1] ** 2 + normals[a, 2] ** 2)


@kernel()
def find_contacts(pair, turn, turn_old, half_sum, dt, nodes):  # type: ignore[no-untyped-def]  # numba types it
    """Put penetrating slave nodes on the master and find the stick forces; return the number of contacts.

    Parameters
    ----------
    pair : Pair
        `place` and `arrival` hold the master's reference point and the velocities before the increment. Per contact are
        written: its slave position (`touching`), normal, forces (positive numbers), direction of the predicted slip,
        slip with which the node arrived, last frictional force, and displacement of the master's material point.
    turn, turn_old : (3, 3) the master's rotation at the end and at the start of the increment
    """
    place, origin, frame = pair.place, pair.origin, pair.frame
    x0, u, v = nodes.x0, nodes.u, nodes.v
    count = 0
    local = np.empty(3)
    point = np.empty(3)
    for k in range(pair.slaves.size):
        if pair.held[k]:
            continue
        at = 3 * pair.slaves[k]
        for c in range(3):
            point[c] = x0[at + c] + u[at + c] - place[c]
        # back to the master's axes before motion, relative to the profile's origin
        for c in range(3):
            local[c] = turn[0, c] * point[0] + turn[1, c] * point[1] + turn[2, c] * point[2] - origin[c]
        px = frame[0, 0] * local[0] + frame[0, 1] * local[1] + frame[0, 2] * local[2]
        py = frame[1, 0] * local[0] + frame[1, 1] * local[1] + frame[1, 2] * local[2]
        cosine, sine = 1.0, 0.0
        if pair.revolved[0]:
            pz = frame[2, 0] * local[0] + frame[2, 1] * local[1] + frame[2, 2] * local[2]
            r = math.sqrt(px * px + pz * pz)
            if r > 0.0:
                cosine, sine = px / r, pz / r
            px = r
        if clear_of(pair.segments, px, py):
            continue
        gap, nx, ny = project(pair.segments, px, py)
        if not gap < 0.0:
            continue
        for c in range(3):
            local[c] = nx * (cosine * frame[0, c] + sine * frame[2, c]) + ny * frame[1, c]
        n0 = turn[0, 0] * local[0] + turn[0, 1] * local[1] + turn[0, 2] * local[2]
        n1 = turn[1, 0] * local[0] + turn[1, 1] * local[1] + turn[1, 2] * local[2]
        n2 = turn[2, 0] * local[0] + turn[2, 1] * local[1] + turn[2, 2] * local[2]
        # the master's material point at the corrected position, and where it was
        for c in range(3):
            point[c] -= gap * (n0 if c == 0 else n1 if c == 1 else n2)
        for c in range(3):
            local[c] = turn[0, c] * point[0] + turn[1, c] * point[1] + turn[2, c] * point[2]
        for c in range(3):
            was = turn_old[c, 0] * local[0] + turn_old[c, 1] * local[1] + turn_old[c, 2] * local[2]
            pair.carried[count, c] = place[c] + point[c] - place[3 + c] - was
        scale = pair.mass[k] / (dt * half_sum)
        pair.normal[count, 0] = n0
        pair.normal[count, 1] = n1
        pair.normal[count, 2] = n2
        pair.normal_force[count] = -gap * scale
        pair.stick_force[count] = scale * predicted_slip(pair, count, v, at, dt)
        # slip of the increment before, from the velocity with which the node arrived
        along = 0.0
        for c in range(3):
            pair.slip[count, c] = pair.arrival[k, c] * dt - pair.carried[count, c]
            along += pair.slip[count, c] * pair.normal[count, c]
        for c in range(3):
            pair.slip[count, c] -= along * pair.normal[count, c]
            pair.previous[count, c] = pair.force[k, 1, c]
            move = -gap * pair.normal[count, c]
            u[at + c] += move
            v[at + c] += move / dt
        pair.touching[count] = k
        count += 1
    return count


@kernel()
def predicted_slip(pair, row, v, at, dt):  # type: ignore[no-untyped-def]  # numba types it
    """Return the slip over the increment without friction and write its direction; any in the surface if none."""
    n0, n1, n2 = pair.normal[row, 0], pair.normal[row, 1], pair.normal[row, 2]
    s0 = v[at] * dt - pair.carried[row, 0]
    s1 = v[at + 1] * dt - pair.carried[row, 1]
    s2 = v[at + 2] * dt - pair.carried[row, 2]
    along = s0 * n0 + s1 * n1 + s2 * n2
    s0 -= along * n0
    s1 -= along * n1
    s2 -= along * n2
    length = math.sqrt(s0 * s0 + s1 * s1 + s2 * s2)
    size = length
    if length == 0.0:
        if abs(n0) < 0.9:
            s0, s1, s2 = 0.0, n2, -n1
        else:
            s0, s1, s2 = -n2, 0.0, n0
        size = math.sqrt(s0 * s0 + s1 * s1 + s2 * s2)
    pair.slip_direction[row, 0] = s0 / size
    pair.slip_direction[row, 1] = s1 / size
    pair.slip_direction[row, 2] = s2 / size
    return length


@kernel()
def coulomb(pair, count):  # type: ignore[no-untyped-def]  # numba types it
    """Constant friction: the tangential force is -min(mu N, stick force)."""
    for k in range(count):
        pair.tangential[k, 0] = -min(pair.coefficient[0] * pair.normal_force[k], pair.stick_force[k])
        pair.tangential[k, 1] = 0.0


@kernel()
def apply_friction(pair, count, half_sum, dt, nodes, work):  # type: ignore[no-untyped-def]  # numba types it
    """Move the contacts by their tangential forces; return the first contact whose force is out of range, else -1.

    `pair.force` gets each slave node's normal and tangential force, `pair.slipping` its state, `work` what the master
    does on the body and what friction and impact take.
    """
    u, v, force = nodes.u, nodes.v, pair.force
    for k in range(pair.slaves.size):
        pair.slipping[k] = OPEN
        for c in range(3):
            force[k, 0, c] = 0.0
            force[k, 1, c] = 0.0
    for i in range(count):
        k = pair.touching[i]
        at = 3 * pair.slaves[k]
        stick = pair.stick_force[i]
        first = pair.tangential[i, 0]
        second = pair.tangential[i, 1]
        slack = 1e-9 * stick + 1e-300
        if not (-stick - slack <= first <= slack and abs(second) <= stick + slack):
            return i
        n0, n1, n2 = pair.normal[i, 0], pair.normal[i, 1], pair.normal[i, 2]
        t0, t1, t2 = pair.slip_direction[i, 0], pair.slip_direction[i, 1], pair.slip_direction[i, 2]
        force[k, 1, 0] = first * t0 + second * (n1 * t2 - n2 * t1)
        force[k, 1, 1] = first * t1 + second * (n2 * t0 - n0 * t2)
        force[k, 1, 2] = first * t2 + second * (n0 * t1 - n1 * t0)
        scale = half_sum / pair.mass[k]
        pair.slipping[k] = STICKS if -first >= stick * (1.0 - 1e-9) else SLIPS
        for c in range(3):
            v[at + c] += scale * force[k, 1, c]
            u[at + c] += scale * dt * force[k, 1, c]
            force[k, 0, c] = pair.normal_force[i] * pair.normal[i, c]
            road = pair.carried[i, c] / dt
            relative = 0.5 * (pair.arrival[k, c] + v[at + c]) - road
            work[EXTERNAL] += (force[k, 0, c] + force[k, 1, c]) * road * half_sum
            work[FRICTION] -= force[k, 1, c] * relative * half_sum
            work[IMPACT] -= force[k, 0, c] * relative * half_sum
    return -1
