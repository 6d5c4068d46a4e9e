"""An element's mount point B, contact point C and spring lengths (section 4.2 and Fig. 11 of the paper).

The neutral line is n = (sin theta, -cos theta), the belt's direction t = (cos theta, sin theta); with BC the vector
from B to C, delta = BC.n = L cos(gamma) and lambda = BC.t = L sin(gamma): Eqs. (6) and (7) of the paper,
whose angles phi and gamma are never formed. A contact point is named by its place c on the
road: x on the plane, the angle from the top on the big wheel.
"""

from __future__ import annotations

import math

from ..geometry.line import ARC_FLAT_ARC, DOWN_AND_UP, WHEEL
from ..kernels import kernel
from .inputs import Motion

BETWEEN_POSES = 4  # beside the codes of the paths' own lines: an even motion from one pose to the next
MountPoint = tuple[float, float, float, float, float, float]


@kernel()
def mount_point(motion: Motion, arc: float) -> MountPoint:
    """Return what the mount point of the mount line does at an arc (m).

    x, y (m), sin and cos of theta, d theta/dt (rad/s), and the speed along the neutral line, towards the road (m/s).
    """
    if motion.code == ARC_FLAT_ARC:
        half, radius, height = motion.parameters[0], motion.parameters[1], motion.parameters[2]
        flat = min(max(arc, -half), half)
        if -half <= arc < half:
            return arc, height, 0.0, 1.0, 0.0, 0.0
        theta = (arc - flat) / radius
        sine, cosine = math.sin(theta), math.cos(theta)
        return flat + radius * sine, height + radius * (1.0 - cosine), sine, cosine, motion.speed / radius, 0.0
    if motion.code == WHEEL:
        surface, mount, axle = motion.parameters[0], motion.parameters[1], motion.parameters[2]
        theta = arc / surface
        sine, cosine = math.sin(theta), math.cos(theta)
        return mount * sine, axle - mount * cosine, sine, cosine, motion.speed / surface, 0.0
    if motion.code == BETWEEN_POSES:
        return _turned_mount_point(motion, arc)
    if motion.code == DOWN_AND_UP:
        return _pressed_mount(motion, arc)
    return _table_mount(motion, arc)


@kernel()
def _table_mount(motion: Motion, arc: float) -> MountPoint:
    table, first, step = motion.table, motion.parameters[0], motion.parameters[1]
    last = first + step * (table.shape[0] - 1)
    inside = min(max(arc, first), last)
    place = (inside - first) / step
    i = min(int(place), table.shape[0] - 2)
    w = place - i
    h00, h10 = (1.0 + 2.0 * w) * (1.0 - w) ** 2, w * (1.0 - w) ** 2 * step
    h01, h11 = w * w * (3.0 - 2.0 * w), w * w * (w - 1.0) * step
    angle0, angle1, bend0, bend1 = table[i, 2], table[i + 1, 2], table[i, 3], table[i + 1, 3]
    x = h00 * table[i, 0] + h10 * math.cos(angle0) + h01 * table[i + 1, 0] + h11 * math.cos(angle1)
    y = h00 * table[i, 1] + h10 * math.sin(angle0) + h01 * table[i + 1, 1] + h11 * math.sin(angle1)
    theta = h00 * angle0 + h10 * bend0 + h01 * angle1 + h11 * bend1
    bend = 6.0 * w * (1.0 - w) * (angle1 - angle0) / step
    bend += (1.0 - w) * (1.0 - 3.0 * w) * bend0 + w * (3.0 * w - 2.0) * bend1
    beyond = arc - inside
    if beyond != 0.0:
        bend = bend0 if beyond < 0.0 else bend1
        half = 0.5 * beyond * bend
        chord = beyond * (math.sin(half) / half if abs(half) > 1e-9 else 1.0)
        x += chord * math.cos(theta + half)
        y += chord * math.sin(theta + half)
        theta += 2.0 * half
    return x, y, math.sin(theta), math.cos(theta), motion.speed * bend, 0.0


@kernel()
def _pressed_mount(motion: Motion, arc: float) -> MountPoint:
    height, depth, pressed, released, left = motion.parameters
    quarter = 0.5 * math.pi
    down, up = quarter * arc / pressed, quarter * (arc - released) / (left - released)
    if arc < 0.0:
        sunk, rate = down, 1.0 / pressed
    elif arc < pressed:
        sunk, rate = math.sin(down), math.cos(down) / pressed
    elif arc < released:
        sunk, rate = 1.0, 0.0
    elif arc < left:
        sunk, rate = math.cos(up), -math.sin(up) / (left - released)
    else:
        sunk, rate = quarter - up, -1.0 / (left - released)
    return 0.0, height - depth * sunk, 0.0, 1.0, 0.0, quarter * depth * motion.speed * rate


@kernel()
def _turned_mount_point(motion: Motion, time: float) -> MountPoint:
    """Between two poses: x, y, theta at first, then an even turn (rad/s) and even speeds along and towards the road."""
    x, y, theta, turn, along, down = motion.parameters
    half = 0.5 * turn * time
    reach = time * (math.sin(half) / half if abs(half) > 1e-9 else 1.0)
    sine, cosine = math.sin(theta + half), math.cos(theta + half)
    x += reach * (along * cosine + down * sine)
    y += reach * (along * sine - down * cosine)
    return x, y, math.sin(theta + 2.0 * half), math.cos(theta + 2.0 * half), turn, down


@kernel()
def sticking(motion: Motion, at: MountPoint, c: float) -> tuple[float, float, float, float]:
    """Return delta, lambda (m) and their rates (m/s) while C rides on the road at the place `c`."""
    x, y, sine, cosine, turn, sinking = at
    if motion.road_curvature == 0.0:
        bx, by, ex, ey = c - x, -y, 1.0, 0.0
    else:
        ex, ey = math.cos(c), -math.sin(c)
        bx, by = -ey / motion.road_curvature - x, (ex - 1.0) / motion.road_curvature - y
    delta = bx * sine - by * cosine
    deflection = bx * cosine + by * sine
    d_delta = motion.road_speed * (ex * sine - ey * cosine) + deflection * turn - sinking
    d_deflection = motion.road_speed * (ex * cosine + ey * sine) - motion.speed * motion.speed_ratio - delta * turn
    return delta, deflection, d_delta, d_deflection


@kernel()
def sliding(motion: Motion, at: MountPoint, deflection: float) -> tuple[float, float, float, float, float]:
    """Return what holds while C is on the road with the longitudinal spring at `deflection` (m).

    delta (m), place c on the road, the rate lambda would have if it stuck (m/s), d delta/d lambda along the road,
    and the two parts of the rate of delta: ``d delta/dt = slope (d lambda/dt) + drift``, slope being d delta/d lambda
    again and drift in m/s.
    """
    x, y, sine, cosine, turn, sinking = at
    if motion.road_curvature == 0.0:
        delta = (y + deflection * sine) / cosine
        c = x + delta * sine + deflection * cosine
        ex, ey = 1.0, 0.0
    else:
        radius = 1.0 / motion.road_curvature
        px, py = x + deflection * cosine, y + deflection * sine  # from the big wheel's top
        along = px * sine - (py + radius) * cosine
        outside = px * px + py * (py + 2.0 * radius)  # |P - O|^2 - R2^2
        delta = outside / (-along + math.sqrt(max(along * along - outside, 0.0)))
        c = math.atan2(px + delta * sine, py - delta * cosine + radius)
        ex, ey = math.cos(c), -math.sin(c)
    ahead, down = ex * cosine + ey * sine, ex * sine - ey * cosine
    slope = down / ahead
    mount = motion.speed * motion.speed_ratio + delta * turn
    return delta, c, motion.road_speed * ahead - mount, slope, slope * mount + deflection * turn - sinking
