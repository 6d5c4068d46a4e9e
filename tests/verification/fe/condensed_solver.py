"""A second formulation of a block pass: quasi-static, small strain, condensed to the contact face.

One relaxation function R(t) scales the whole elastic stiffness (constant Poisson's ratio), so inner nodes can be
eliminated once: f(t) = int R(t - s) S d(u_face - u_mount)/ds ds on the face. A contact problem with the few face nodes
is left for each step, solved by projected Gauss-Seidel on the contact forces. Shares no code with the engine: its own
element stiffness, its own Prony sums, steps ten times longer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import splu

Floats = NDArray[np.float64]
SIGNS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])


def brick_stiffness(size: Floats, modulus: float, ratio: float, hourglass: float) -> Floats:
    """(24, 24) stiffness of a brick with one integration point; hourglass modes by energy (c/2) G V sum(b^2) q^2."""
    b = SIGNS / (4.0 * size)
    volume = float(np.prod(size))
    shear = modulus / (2.0 * (1.0 + ratio))
    lame = modulus * ratio / ((1.0 + ratio) * (1.0 - 2.0 * ratio))
    strain = np.zeros((6, 24))
    for axis in range(3):
        strain[axis, axis::3] = b[:, axis]
    for row, (i, j) in enumerate(((0, 1), (0, 2), (1, 2)), start=3):
        strain[row, i::3] = b[:, j]
        strain[row, j::3] = b[:, i]
    elastic = np.diag([2.0 * shear] * 3 + [shear] * 3)
    elastic[:3, :3] += lame
    total = volume * strain.T @ elastic @ strain
    stiff = hourglass * shear * volume * float((b**2).sum())
    x, y, z = SIGNS.T
    for pattern in (y * z, x * z, x * y, x * y * z):
        for axis in range(3):
            mode = np.zeros(24)
            mode[axis::3] = pattern / 8.0
            total += stiff * np.outer(mode, mode)
    return total


@dataclass(frozen=True)
class Condensed:
    """Elastic stiffness of the face (3n, 3n) at E_0, displacements relative to a mount that moves as one."""

    face: Floats


def condense(points: Floats, elements: NDArray[np.int64], face: NDArray[np.int64], mount: NDArray[np.int64],
             modulus: float, ratio: float, hourglass: float) -> Condensed:  # fmt: skip
    """Eliminate the inner nodes of a regular brick whose mount is held."""
    size = points[elements[0, 6]] - points[elements[0, 0]]
    own = brick_stiffness(size, modulus, ratio, hourglass)
    dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(len(elements), 24)
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    count = 3 * len(points)
    full = coo_matrix((np.tile(own.ravel(), len(elements)), (rows, columns)), shape=(count, count)).tocsc()
    f = (3 * face[:, None] + np.arange(3)).ravel()
    m = (3 * mount[:, None] + np.arange(3)).ravel()
    inner = np.setdiff1d(np.arange(count), np.concatenate([f, m]))
    inner_motion = splu(full[inner][:, inner].tocsc()).solve(full[inner][:, f].toarray())
    return Condensed(full[f][:, f].toarray() - full[f][:, inner] @ inner_motion)


@njit(cache=True)
def gauss_seidel(compliance, free, gap, mu, force, sweeps):  # type: ignore[no-untyped-def]
    """Contact forces on the face: gap + C f >= 0 and f_n >= 0 complementary; |f_t| <= mu f_n opposes slip.

    `free` (n, 3) is the slip of the step without contact forces, in columns 0 and 1; gap (n,) the normal gap without
    contact forces.
    """
    n = gap.size
    u = np.zeros((n, 3))
    for k in range(n):
        for c in range(3):
            for j in range(n):
                for d in range(3):
                    u[k, c] += compliance[3 * k + c, 3 * j + d] * force[j, d]
    for _ in range(sweeps):
        change = 0.0
        for k in range(n):
            old0, old1, old2 = force[k, 0], force[k, 1], force[k, 2]
            normal = max(0.0, old2 - (gap[k] + u[k, 2]) / compliance[3 * k + 2, 3 * k + 2])
            d2 = normal - old2
            s0 = free[k, 0] + u[k, 0] + compliance[3 * k, 3 * k + 2] * d2
            s1 = free[k, 1] + u[k, 1] + compliance[3 * k + 1, 3 * k + 2] * d2
            t0 = old0 - s0 / compliance[3 * k, 3 * k]
            t1 = old1 - s1 / compliance[3 * k + 1, 3 * k + 1]
            size = np.sqrt(t0 * t0 + t1 * t1)
            if size > mu * normal:
                scale = mu * normal / size if size > 0.0 else 0.0
                t0 *= scale
                t1 *= scale
            d0, d1 = t0 - old0, t1 - old1
            force[k, 0], force[k, 1], force[k, 2] = t0, t1, normal
            change = max(change, abs(d0), abs(d1), abs(d2))
            if d0 != 0.0 or d1 != 0.0 or d2 != 0.0:
                for j in range(n):
                    for c in range(3):
                        row = compliance[3 * j + c]
                        u[j, c] += row[3 * k] * d0 + row[3 * k + 1] * d1 + row[3 * k + 2] * d2
        if change < 1e-9:
            break
    return force


def roll_over_wheel(
    condensed: Condensed, face: Floats, prony: list[tuple[float, float]], radius: float, low: float, start: float,
    speed: float, creep: float, mu: float, period: float, steps: int,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Carry the block straight over the crest of a turning wheel at x = 0, z = -low.

    Parameters
    ----------
    face : (n, 3) face nodes in the block before it moves; `start` is what is added to x at t = 0
    prony : (ratio, relaxation time) of the terms; the rest of the modulus stays
    speed, creep : the mount's speed along x; the wheel's surface runs at speed (1 + creep)

    Returns
    -------
    time (steps,), force (steps, 3) on the block
    """
    n = len(face)
    dt = period / steps
    g = np.array([ratio for ratio, _ in prony])
    tau = np.array([t for _, t in prony])
    decay = np.exp(-dt / tau)
    gain = g * (-np.expm1(-dt / tau)) * tau / dt
    left = 1.0 - g.sum()
    grow = left + gain.sum()
    compliance = np.linalg.inv(condensed.face) / grow
    u = np.zeros((n, 3))  # of the face relative to the mount
    history = np.zeros((len(prony), 3 * n))
    lasting = np.zeros(3 * n)
    force = np.zeros((n, 3))
    out = np.zeros((steps, 3))
    time = dt * np.arange(1, steps + 1)
    for step, t in enumerate(time):
        held = (lasting + decay @ history).reshape(-1)
        # without contact forces on the face the step brings this displacement
        base = u.ravel() - compliance @ held
        base = base.reshape(n, 3)
        x = start + speed * t + face[:, 0]
        crest = -low - radius + np.sqrt(np.maximum(radius**2 - x**2, 0.0))
        gap = face[:, 2] + base[:, 2] - crest
        # the wheel's point under a node moves along x by the surface's speed, seen on the chord
        slope = x / radius
        road = speed * (1.0 + creep) * np.sqrt(np.maximum(1.0 - slope**2, 0.0)) * dt - speed * dt
        free = np.zeros((n, 3))
        free[:, 0] = base[:, 0] - u[:, 0] - road
        free[:, 1] = base[:, 1] - u[:, 1]
        force = gauss_seidel(compliance, free, gap, mu, force, 400)
        new = base + (compliance @ force.ravel()).reshape(n, 3)
        elastic = condensed.face @ (new - u).ravel()
        history = decay[:, None] * history + gain[:, None] * elastic
        lasting = lasting + left * elastic
        u = new
        # forces act along the wheel's normal and tangent
        normal, tangent = force[:, 2], force[:, 0]
        out[step] = [tangent.sum() + (normal * slope).sum(), force[:, 1].sum(), normal.sum()]
    return time, out
