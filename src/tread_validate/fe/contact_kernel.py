"""Kinematic contact of slave nodes with rigid profiles: predict, then correct.

The trial position of a slave node at the end of the increment, made without contact, is compared with the master where
it will be. A node that would be inside is put on the surface; the force that does this, m d/(dt dt_mean), is the
normal force. The tangential force that would stop its slip over the increment is the stick force; friction takes all
of it or the part that the law allows.
"""

from __future__ import annotations

import math

import numpy as np

from ..kernels import kernel

TWO_PI = 2.0 * math.pi


@kernel()
def project(segments, x, y):  # type: ignore[no-untyped-def]
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
def face_areas(faces, slaves, x0, u, area):  # type: ignore[no-untyped-def]
    """Write each slave node's share of the current area of the faces (k, 4: positions in `slaves`)."""
    for k in range(slaves.size):
        area[k] = 0.0
    for k in range(faces.shape[0]):
        p0 = 3 * slaves[faces[k, 0]]
        p1 = 3 * slaves[faces[k, 1]]
        p2 = 3 * slaves[faces[k, 2]]
        p3 = 3 * slaves[faces[k, 3]]
        dx = x0[p2] + u[p2] - x0[p0] - u[p0]
        dy = x0[p2 + 1] + u[p2 + 1] - x0[p0 + 1] - u[p0 + 1]
        dz = x0[p2 + 2] + u[p2 + 2] - x0[p0 + 2] - u[p0 + 2]
        ex = x0[p3] + u[p3] - x0[p1] - u[p1]
        ey = x0[p3 + 1] + u[p3 + 1] - x0[p1 + 1] - u[p1 + 1]
        ez = x0[p3 + 2] + u[p3 + 2] - x0[p1 + 2] - u[p1 + 2]
        share = 0.125 * math.sqrt((dy * ez - dz * ey) ** 2 + (dz * ex - dx * ez) ** 2 + (dx * ey - dy * ex) ** 2)
        for a in range(4):
            area[faces[k, a]] += share


@kernel()
def find_contacts(  # type: ignore[no-untyped-def]
    slaves,
    held,
    mass,
    segments,
    origin,
    frame,
    place,
    turn,
    turn_old,
    half_sum,
    dt,
    x0,
    u,
    v,
    touching,
    normal,
    normal_force,
    slip_direction,
    stick_force,
    last_slip,
    carried,
):
    """Put penetrating slave nodes on the master and find the stick forces; return the number of contacts.

    Parameters
    ----------
    slaves, held, mass : (n,) node indices, 1 where a node is wholly prescribed (left alone), nodal masses
    segments, origin, frame : profile, and its local axes before any motion
    place : (6,) the master's reference point at the end and at the start of the increment
    turn, turn_old : (3, 3) its rotation at the end and at the start
    touching : (n,) out, slave positions of the contacts
    normal, normal_force, slip_direction, stick_force, last_slip : out, per contact; forces are positive numbers
    carried : (n, 3) out, displacement of the master's material point over the increment
    """
    count = 0
    local = np.empty(3)
    point = np.empty(3)
    for k in range(slaves.size):
        if held[k]:
            continue
        at = 3 * slaves[k]
        for c in range(3):
            point[c] = x0[at + c] + u[at + c] - place[c]
        # back to the master's axes before motion, relative to the profile's origin
        for c in range(3):
            local[c] = turn[0, c] * point[0] + turn[1, c] * point[1] + turn[2, c] * point[2] - origin[c]
        px = frame[0, 0] * local[0] + frame[0, 1] * local[1] + frame[0, 2] * local[2]
        py = frame[1, 0] * local[0] + frame[1, 1] * local[1] + frame[1, 2] * local[2]
        gap, nx, ny = project(segments, px, py)
        if not gap < 0.0:
            continue
        for c in range(3):
            local[c] = nx * frame[0, c] + ny * frame[1, c]
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
            carried[count, c] = place[c] + point[c] - place[3 + c] - was
        scale = mass[k] / (dt * half_sum)
        normal[count, 0] = n0
        normal[count, 1] = n1
        normal[count, 2] = n2
        normal_force[count] = -gap * scale
        s0 = v[at] * dt - carried[count, 0]
        s1 = v[at + 1] * dt - carried[count, 1]
        s2 = v[at + 2] * dt - carried[count, 2]
        along = s0 * n0 + s1 * n1 + s2 * n2
        s0 -= along * n0
        s1 -= along * n1
        s2 -= along * n2
        length = math.sqrt(s0 * s0 + s1 * s1 + s2 * s2)
        if length > 0.0:
            slip_direction[count, 0] = s0 / length
            slip_direction[count, 1] = s1 / length
            slip_direction[count, 2] = s2 / length
        else:
            # any direction in the surface
            if abs(n0) < 0.9:
                s0, s1, s2 = 0.0, n2, -n1
            else:
                s0, s1, s2 = -n2, 0.0, n0
            inverse = 1.0 / math.sqrt(s0 * s0 + s1 * s1 + s2 * s2)
            slip_direction[count, 0] = s0 * inverse
            slip_direction[count, 1] = s1 * inverse
            slip_direction[count, 2] = s2 * inverse
        stick_force[count] = length * scale
        # slip of the increment before, from the velocity with which the node arrived
        l0 = last_slip[k, 0] * dt - carried[count, 0]
        l1 = last_slip[k, 1] * dt - carried[count, 1]
        l2 = last_slip[k, 2] * dt - carried[count, 2]
        along = l0 * n0 + l1 * n1 + l2 * n2
        last_slip[k, 0] = l0 - along * n0
        last_slip[k, 1] = l1 - along * n1
        last_slip[k, 2] = l2 - along * n2
        for c in range(3):
            move = -gap * (n0 if c == 0 else n1 if c == 1 else n2)
            u[at + c] += move
            v[at + c] += move / dt
        touching[count] = k
        count += 1
    return count


@kernel()
def coulomb(count, coefficient, normal_force, stick_force, tangential):  # type: ignore[no-untyped-def]
    """Constant friction: tangential[k] = -(min(mu N, stick force), 0)."""
    for k in range(count):
        tangential[k, 0] = -min(coefficient * normal_force[k], stick_force[k])
        tangential[k, 1] = 0.0


@kernel()
def apply_friction(  # type: ignore[no-untyped-def]
    count,
    touching,
    slaves,
    mass,
    normal,
    normal_force,
    slip_direction,
    stick_force,
    tangential,
    carried,
    half_sum,
    dt,
    u,
    v,
    force,
    slipping,
    work,
):
    """Move the contacts by their tangential forces; return the first contact whose force is out of range, else -1.

    `force` (n, 2, 3) gets each slave node's normal and tangential force, `slipping` (n,) 0 open, 1 sticks, 2 slips;
    `work` gains (0) what the master does on the body and (1) what friction dissipates.
    """
    for k in range(slaves.size):
        slipping[k] = 0
        for c in range(3):
            force[k, 0, c] = 0.0
            force[k, 1, c] = 0.0
    for i in range(count):
        k = touching[i]
        at = 3 * slaves[k]
        stick = stick_force[i]
        first = tangential[i, 0]
        second = tangential[i, 1]
        slack = 1e-9 * stick + 1e-300
        if not (-stick - slack <= first <= slack and abs(second) <= stick + slack):
            return i
        n0, n1, n2 = normal[i, 0], normal[i, 1], normal[i, 2]
        t0, t1, t2 = slip_direction[i, 0], slip_direction[i, 1], slip_direction[i, 2]
        f0 = first * t0 + second * (n1 * t2 - n2 * t1)
        f1 = first * t1 + second * (n2 * t0 - n0 * t2)
        f2 = first * t2 + second * (n0 * t1 - n1 * t0)
        scale = half_sum / mass[k]
        v[at] += scale * f0
        v[at + 1] += scale * f1
        v[at + 2] += scale * f2
        u[at] += scale * dt * f0
        u[at + 1] += scale * dt * f1
        u[at + 2] += scale * dt * f2
        fn = normal_force[i]
        force[k, 0, 0] = fn * n0
        force[k, 0, 1] = fn * n1
        force[k, 0, 2] = fn * n2
        force[k, 1, 0] = f0
        force[k, 1, 1] = f1
        force[k, 1, 2] = f2
        slipping[k] = 1 if -first >= stick * (1.0 - 1e-9) else 2
        for c in range(3):
            work[0] += (force[k, 0, c] + force[k, 1, c]) * carried[i, c]
            work[1] -= force[k, 1, c] * (v[at + c] * dt - carried[i, c])
    return -1
