"""The node loop of an increment: gather forces, kick, drift, prescribed motion, rigid bodies, loads."""

from __future__ import annotations

import math

import numpy as np

from ..kernels import kernel
from .amplitude import amplitude_at
from .contact_kernel import nodal_normals
from .element_kernel import LANES
from .kernel_data import FIXED, VELOCITY

ROW = np.uint64(LANES)  # unsigned: indices that cannot be negative need not be looked at


@kernel()
def gather_forces(first, last, element_force, slots, slot_start, force):  # type: ignore[no-untyped-def]  # numba types it
    """Sum the element forces (rows of LANES: x, y, z) of nodes `first`..`last` into `force` (3 n,)."""
    f = element_force.reshape(-1)
    for node in range(first, last):
        x = 0.0
        y = 0.0
        z = 0.0
        for row in range(slot_start[node], slot_start[node + 1]):
            at = np.uint64(slots[row])
            x += f[at]
            y += f[at + ROW]
            z += f[at + ROW + ROW]
        force[3 * node] = x
        force[3 * node + 1] = y
        force[3 * node + 2] = z


@kernel()
def kick_and_drift(first, last, half_sum, dt, inverse_mass, force, load, v, u):  # type: ignore[no-untyped-def]  # numba types it
    """v += (load - force)/m (dt_old + dt)/2, u += v dt for nodes `first`..`last` (central differences)."""
    for node in range(first, last):
        scale = half_sum * inverse_mass[node]
        for c in range(3 * node, 3 * node + 3):
            v[c] += scale * (load[c] - force[c])
            u[c] += dt * v[c]


@kernel()
def evaluate_amplitudes(amp_row, amp_time, amp_value, amp_area, amp_smooth, amp_base, guess, total, value, area):  # type: ignore[no-untyped-def]  # numba types it
    """Evaluate every amplitude at the total time `total` into `value` and `area` (integral from its first time)."""
    for k in range(amp_smooth.size):
        value[k], area[k], guess[k] = amplitude_at(
            amp_time, amp_value, amp_area, amp_row[k], amp_row[k + 1], amp_smooth[k], guess[k], total - amp_base[k]
        )


@kernel()
def prescribed_value(kind, magnitude, amplitude, start, area_start, step_time, value, area):  # type: ignore[no-untyped-def]  # numba types it
    """Return the displacement a condition asks for: held, integral of a velocity (exact), or a displacement."""
    if kind == FIXED:
        return start
    if kind == VELOCITY:
        if amplitude < 0:
            return start + magnitude * step_time
        return start + magnitude * (area[amplitude] - area_start)
    return magnitude * value[amplitude]


@kernel()
def rotate(ax, ay, az, matrix):  # type: ignore[no-untyped-def]  # numba types it
    """Turn the rows' frame `matrix` (3, 3) in place by a rotation vector (Rodrigues)."""
    angle = math.sqrt(ax * ax + ay * ay + az * az)
    if angle == 0.0:
        return
    kx, ky, kz = ax / angle, ay / angle, az / angle
    s, c = math.sin(angle), 1.0 - math.cos(angle)
    for j in range(3):
        x, y, z = matrix[0, j], matrix[1, j], matrix[2, j]
        dot = kx * x + ky * y + kz * z
        matrix[0, j] = x + s * (ky * z - kz * y) + c * (kx * dot - x)
        matrix[1, j] = y + s * (kz * x - kx * z) + c * (ky * dot - y)
        matrix[2, j] = z + s * (kx * y - ky * x) + c * (kz * dot - z)


@kernel()
def pressure_loads(faces, magnitude, amplitude, value, x0, u, load):  # type: ignore[no-untyped-def]  # numba types it
    """Add the nodal forces of pressures on faces (k, 4), which follow the deformation."""
    normals = np.empty((4, 3))
    for k in range(faces.shape[0]):
        factor = magnitude[k]
        if amplitude[k] >= 0:
            factor *= value[amplitude[k]]
        nodal_normals(x0, u, faces[k], normals)
        for a in range(4):
            for c in range(3):
                load[3 * faces[k, a] + c] += factor * normals[a, c]
