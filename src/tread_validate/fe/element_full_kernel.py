"""Strain, stress and nodal forces of fully integrated hexahedra (C3D8): one lane for each Gauss point.

The eight points of an element lie side by side in the lanes of a block, so that geometry, state and Prony histories
have the layout of the one-point element; forces of the points are summed where nodes gather them. What joins the points
is selectively reduced integration: the distortion is each point's own, the change of volume the element's mean,

    F_bar = (J_bar/J)^(1/3) F,   J_bar = sum of V J over the points / V,

and its dual, one mean stress over the element. First Piola-Kirchhoff stress of a point, from the virtual work of F_bar:
P = R [(J_bar/J) dev sigma + p I] adj U, with p the mean of the points' own mean stresses over the reference volume.
All else (Green-Naghdi rate form, Prony recursion, works by the trapezoidal rule) is as in `element_kernel`.
"""

from __future__ import annotations

from ..kernels import kernel
from .element_kernel import (
    FAST,
    GEO_B,
    GEO_BULK_LINEAR,
    GEO_BULK_QUADRATIC,
    GEO_ROWS,
    GEO_VOLUME,
    LANES,
    STATE_BULK,
    STATE_ROWS,
    STATE_STRAIN,
    STATE_STRESS,
    STATE_U,
    STATE_VISCOUS,
    STATE_WORK,
)
from .hyperelastic_kernel import cauchy_and_strain, stress_for_strain

# Rows of the working set: displacements (24), F (9), R (9), the point's own J U^-1 and J and the mean stress (8),
# strain increment (6), hereditary strain (6), J_bar (1), Piola-Kirchhoff stress (9), then copies of geometry and state.
_U, _F, _R, _Q, _D, _S, _J, _P, _G = 0, 24, 33, 42, 50, 56, 62, 63, 72
_T = _G + GEO_ROWS
FULL_WORK_ROWS = _T + STATE_ROWS
POINTS = 8
"""Gauss points of an element; an element's lanes never straddle two blocks, as `LANES` is a multiple of it."""


@kernel(fastmath=FAST, boundscheck=False)
def full_block_forces(first, last, dt, u, conn, geo, state, hist, decay, gain, elastic, kind, out, work):  # type: ignore[no-untyped-def]  # numba types it
    """Advance blocks `first`..`last` of Gauss points by one step and write their forces.

    Parameters and result are those of `element_kernel.block_forces`, with a Gauss point in the place of an element: its
    gradients, and its share of the volume.
    """
    n = LANES
    w = work
    worst = 1e30
    for b in range(first, last):
        for a in range(8):
            for i in range(n):
                at = conn[b, a, i]
                w[(_U + 3 * a) * n + i] = u[at]
                w[(_U + 3 * a + 1) * n + i] = u[at + 1]
                w[(_U + 3 * a + 2) * n + i] = u[at + 2]
        for row in range(GEO_ROWS):
            for i in range(n):
                w[(_G + row) * n + i] = geo[b, row, i]
        for row in range(STATE_ROWS):
            for i in range(n):
                w[(_T + row) * n + i] = state[b, row, i]
        _gradients(w)
        _rotations(w)
        _own_stretches(w)
        worst = min(worst, _mean_dilatation(w))
        _strain_increments(w)
        _relax(b, dt, hist, decay, gain, elastic, kind[b], w)
        _stresses(dt, elastic[kind[b], 0], elastic[kind[b], 1], w)
        for c in range(3):
            for a in range(8):
                for i in range(n):
                    out[b, 3 * a + c, i] = (
                        w[(_P + 3 * c) * n + i] * w[(_G + GEO_B + a) * n + i]
                        + w[(_P + 3 * c + 1) * n + i] * w[(_G + GEO_B + 8 + a) * n + i]
                        + w[(_P + 3 * c + 2) * n + i] * w[(_G + GEO_B + 16 + a) * n + i]
                    )
        for row in range(STATE_ROWS):
            for i in range(n):
                state[b, row, i] = w[(_T + row) * n + i]
    return worst


@kernel(fastmath=FAST, boundscheck=False)
def _gradients(w):  # type: ignore[no-untyped-def]  # numba types it
    """Deformation gradients, row by row; they are also the start of the rotations."""
    n = LANES
    for c in range(3):
        for i in range(n):
            x = 1.0 if c == 0 else 0.0
            y = 1.0 if c == 1 else 0.0
            z = 1.0 if c == 2 else 0.0
            for a in range(8):
                d = w[(_U + 3 * a + c) * n + i]
                x += d * w[(_G + GEO_B + a) * n + i]
                y += d * w[(_G + GEO_B + 8 + a) * n + i]
                z += d * w[(_G + GEO_B + 16 + a) * n + i]
            w[(_F + 3 * c) * n + i] = x
            w[(_F + 3 * c + 1) * n + i] = y
            w[(_F + 3 * c + 2) * n + i] = z
    for i in range(9 * n):
        w[_R * n + i] = w[_F * n + i]


@kernel(fastmath=FAST, boundscheck=False)
def _rotations(w):  # type: ignore[no-untyped-def]  # numba types it
    """Newton's iteration R <- (R + R^-T)/2 from R = F (Higham, doi:10.1137/0907079)."""
    n = LANES
    for _ in range(12):
        change = 0.0
        for i in range(n):
            a0, a1, a2 = w[_R * n + i], w[(_R + 1) * n + i], w[(_R + 2) * n + i]
            b0, b1, b2 = w[(_R + 3) * n + i], w[(_R + 4) * n + i], w[(_R + 5) * n + i]
            c0, c1, c2 = w[(_R + 6) * n + i], w[(_R + 7) * n + i], w[(_R + 8) * n + i]
            k0 = b1 * c2 - b2 * c1
            k1 = b2 * c0 - b0 * c2
            k2 = b0 * c1 - b1 * c0
            h = 0.5 / (a0 * k0 + a1 * k1 + a2 * k2)
            r0 = h * k0 - 0.5 * a0
            r1 = h * k1 - 0.5 * a1
            r2 = h * k2 - 0.5 * a2
            r3 = h * (a2 * c1 - a1 * c2) - 0.5 * b0
            r4 = h * (a0 * c2 - a2 * c0) - 0.5 * b1
            r5 = h * (a1 * c0 - a0 * c1) - 0.5 * b2
            r6 = h * (a1 * b2 - a2 * b1) - 0.5 * c0
            r7 = h * (a2 * b0 - a0 * b2) - 0.5 * c1
            r8 = h * (a0 * b1 - a1 * b0) - 0.5 * c2
            w[_R * n + i] = a0 + r0
            w[(_R + 1) * n + i] = a1 + r1
            w[(_R + 2) * n + i] = a2 + r2
            w[(_R + 3) * n + i] = b0 + r3
            w[(_R + 4) * n + i] = b1 + r4
            w[(_R + 5) * n + i] = b2 + r5
            w[(_R + 6) * n + i] = c0 + r6
            w[(_R + 7) * n + i] = c1 + r7
            w[(_R + 8) * n + i] = c2 + r8
            change += r0 * r0 + r1 * r1 + r2 * r2 + r3 * r3 + r4 * r4 + r5 * r5 + r6 * r6 + r7 * r7 + r8 * r8
        if not change > 1e-15:
            break


@kernel(fastmath=FAST, boundscheck=False)
def _own_stretches(w):  # type: ignore[no-untyped-def]  # numba types it
    """Each point's own stretch U = R^T F into `_D`, its adjugate J U^-1 and J into `_Q`."""
    n = LANES
    for i in range(n):
        f0, f1, f2 = w[_F * n + i], w[(_F + 1) * n + i], w[(_F + 2) * n + i]
        f3, f4, f5 = w[(_F + 3) * n + i], w[(_F + 4) * n + i], w[(_F + 5) * n + i]
        f6, f7, f8 = w[(_F + 6) * n + i], w[(_F + 7) * n + i], w[(_F + 8) * n + i]
        r0, r1, r2 = w[_R * n + i], w[(_R + 1) * n + i], w[(_R + 2) * n + i]
        r3, r4, r5 = w[(_R + 3) * n + i], w[(_R + 4) * n + i], w[(_R + 5) * n + i]
        r6, r7, r8 = w[(_R + 6) * n + i], w[(_R + 7) * n + i], w[(_R + 8) * n + i]
        u0 = r0 * f0 + r3 * f3 + r6 * f6
        u1 = r1 * f1 + r4 * f4 + r7 * f7
        u2 = r2 * f2 + r5 * f5 + r8 * f8
        u3 = 0.5 * (r0 * f1 + r3 * f4 + r6 * f7 + r1 * f0 + r4 * f3 + r7 * f6)
        u4 = 0.5 * (r0 * f2 + r3 * f5 + r6 * f8 + r2 * f0 + r5 * f3 + r8 * f6)
        u5 = 0.5 * (r1 * f2 + r4 * f5 + r7 * f8 + r2 * f1 + r5 * f4 + r8 * f7)
        w[_D * n + i] = u0
        w[(_D + 1) * n + i] = u1
        w[(_D + 2) * n + i] = u2
        w[(_D + 3) * n + i] = u3
        w[(_D + 4) * n + i] = u4
        w[(_D + 5) * n + i] = u5
        k0 = u1 * u2 - u5 * u5
        k3 = u4 * u5 - u3 * u2
        k4 = u3 * u5 - u1 * u4
        w[_Q * n + i] = k0
        w[(_Q + 1) * n + i] = u0 * u2 - u4 * u4
        w[(_Q + 2) * n + i] = u0 * u1 - u3 * u3
        w[(_Q + 3) * n + i] = k3
        w[(_Q + 4) * n + i] = k4
        w[(_Q + 5) * n + i] = u3 * u4 - u0 * u5
        w[(_Q + 6) * n + i] = u0 * k0 + u3 * k3 + u4 * k4


@kernel(fastmath=FAST, boundscheck=False)
def _mean_dilatation(w):  # type: ignore[no-untyped-def]  # numba types it
    """Write J_bar into `_J`, stretch `_D` to it; return the least of the points' own J."""
    n = LANES
    worst = 1e30
    for first in range(0, n, POINTS):
        volume = 0.0
        filled = 0.0
        for i in range(first, first + POINTS):
            worst = min(worst, w[(_Q + 6) * n + i])
            volume += w[(_G + GEO_VOLUME) * n + i]
            filled += w[(_G + GEO_VOLUME) * n + i] * w[(_Q + 6) * n + i]
        mean = filled / volume if volume > 0.0 else 1.0
        for i in range(first, first + POINTS):
            w[_J * n + i] = mean
            scale = (mean / w[(_Q + 6) * n + i]) ** (1.0 / 3.0)
            for row in range(6):
                w[(_D + row) * n + i] *= scale
    return worst


@kernel(fastmath=FAST, boundscheck=False)
def _strain_increments(w):  # type: ignore[no-untyped-def]  # numba types it
    """Put the stretches of `_D` into the state and write sym(dU U_mid^-1) in their place: deviator, then volume."""
    n = LANES
    for i in range(n):
        u0, u1, u2 = w[_D * n + i], w[(_D + 1) * n + i], w[(_D + 2) * n + i]
        u3, u4, u5 = w[(_D + 3) * n + i], w[(_D + 4) * n + i], w[(_D + 5) * n + i]
        s = (_T + STATE_U) * n + i
        v0, v1, v2, v3, v4, v5 = w[s], w[s + n], w[s + 2 * n], w[s + 3 * n], w[s + 4 * n], w[s + 5 * n]
        w[s] = u0
        w[s + n] = u1
        w[s + 2 * n] = u2
        w[s + 3 * n] = u3
        w[s + 4 * n] = u4
        w[s + 5 * n] = u5
        m0, m1, m2 = 0.5 * (u0 + v0), 0.5 * (u1 + v1), 0.5 * (u2 + v2)
        m3, m4, m5 = 0.5 * (u3 + v3), 0.5 * (u4 + v4), 0.5 * (u5 + v5)
        k0 = m1 * m2 - m5 * m5
        k3 = m4 * m5 - m3 * m2
        k4 = m3 * m5 - m1 * m4
        h = 1.0 / (m0 * k0 + m3 * k3 + m4 * k4)
        k0 *= h
        k3 *= h
        k4 *= h
        k1 = h * (m0 * m2 - m4 * m4)
        k2 = h * (m0 * m1 - m3 * m3)
        k5 = h * (m3 * m4 - m0 * m5)
        v0, v1, v2, v3, v4, v5 = u0 - v0, u1 - v1, u2 - v2, u3 - v3, u4 - v4, u5 - v5
        e0 = v0 * k0 + v3 * k3 + v4 * k4
        e1 = v3 * k3 + v1 * k1 + v5 * k5
        volume = e0 + e1 + v4 * k4 + v5 * k5 + v2 * k2
        w[_D * n + i] = e0 - volume / 3.0
        w[(_D + 1) * n + i] = e1 - volume / 3.0
        w[(_D + 2) * n + i] = 0.5 * (v0 * k3 + v3 * k1 + v4 * k5 + v3 * k0 + v1 * k3 + v5 * k4)
        w[(_D + 3) * n + i] = 0.5 * (v0 * k4 + v3 * k5 + v4 * k2 + v4 * k0 + v5 * k3 + v2 * k4)
        w[(_D + 4) * n + i] = 0.5 * (v3 * k4 + v1 * k5 + v5 * k2 + v4 * k3 + v5 * k1 + v2 * k5)
        w[(_D + 5) * n + i] = volume


@kernel(fastmath=FAST, boundscheck=False)
def _relax(b, dt, hist, decay, gain, elastic, k, w):  # type: ignore[no-untyped-def]  # numba types it
    """Long-term strain, damping and the Prony terms into `_S`: rows 0-4 deviator, row 5 volume."""
    n = LANES
    damp = elastic[k, 4] / dt
    jacobian, increment, kept = w[_J * n : (_J + 1) * n], w[_D * n : (_D + 6) * n], w[_P * n : (_P + 6) * n]
    if elastic[k, 5] > 0.0:
        stretch, total = w[(_T + STATE_U) * n : (_T + STATE_U + 6) * n], w[(_T + STATE_STRAIN) * n :]
        stress_for_strain(stretch, jacobian, total, increment, kept)
    for c in range(6):
        ratio = elastic[k, 2] if c < 5 else elastic[k, 3]
        for i in range(n):
            e = w[(_T + STATE_STRAIN + c) * n + i] + w[(_D + c) * n + i]
            w[(_T + STATE_STRAIN + c) * n + i] = e
            w[(_S + c) * n + i] = ratio * e + damp * w[(_D + c) * n + i]
    for t in range(hist.shape[1]):
        fade = decay[k, t]
        for c in range(6):
            grow = gain[k, t, 0] if c < 5 else gain[k, t, 1]
            for i in range(n):
                q = fade * hist[b, t, c, i] + grow * w[(_D + c) * n + i]
                hist[b, t, c, i] = q
                w[(_S + c) * n + i] += q
    if elastic[k, 5] > 0.0:
        cauchy_and_strain(damp, jacobian, w[_S * n : (_S + 6) * n], increment, kept)


@kernel(fastmath=FAST, boundscheck=False)
def _stresses(dt, shear, bulk, w):  # type: ignore[no-untyped-def]  # numba types it
    """Stresses, their work and that of bulk viscosity, and Piola-Kirchhoff stress times volume into `_P`."""
    n = LANES
    for first in range(0, n, POINTS):
        volume = 0.0
        total = 0.0
        for i in range(first, first + POINTS):
            rate = w[(_D + 5) * n + i] / dt
            squeeze = min(rate, 0.0)
            viscous = (
                w[(_G + GEO_BULK_LINEAR) * n + i] * rate - w[(_G + GEO_BULK_QUADRATIC) * n + i] * squeeze * squeeze
            )
            own = w[(_G + GEO_VOLUME) * n + i]
            volume += own
            total += own * (bulk * w[(_S + 5) * n + i] + viscous)
            now = w[_J * n + i] * viscous
            w[(_T + STATE_BULK) * n + i] += 0.5 * own * (w[(_T + STATE_VISCOUS) * n + i] + now) * w[(_D + 5) * n + i]
            w[(_T + STATE_VISCOUS) * n + i] = now
        mean = total / volume if volume > 0.0 else 0.0
        for i in range(first, first + POINTS):
            w[(_Q + 7) * n + i] = mean
    for i in range(n):
        jacobian = w[_J * n + i]
        d0 = shear * w[_S * n + i]
        d1 = shear * w[(_S + 1) * n + i]
        d2 = -d0 - d1
        d3, d4, d5 = shear * w[(_S + 2) * n + i], shear * w[(_S + 3) * n + i], shear * w[(_S + 4) * n + i]
        own = bulk * w[(_S + 5) * n + i]
        third = w[(_D + 5) * n + i] / 3.0
        e0 = w[_D * n + i] + third
        e1 = w[(_D + 1) * n + i] + third
        e2 = 3.0 * third - e0 - e1
        t0, t1, t2 = jacobian * (d0 + own), jacobian * (d1 + own), jacobian * (d2 + own)
        t3, t4, t5 = jacobian * d3, jacobian * d4, jacobian * d5
        s = (_T + STATE_STRESS) * n + i
        w[(_T + STATE_WORK) * n + i] += (0.5 * w[(_G + GEO_VOLUME) * n + i]) * (
            (w[s] + t0) * e0
            + (w[s + n] + t1) * e1
            + (w[s + 2 * n] + t2) * e2
            + 2.0 * (w[s + 3 * n] + t3) * w[(_D + 2) * n + i]
            + 2.0 * (w[s + 4 * n] + t4) * w[(_D + 3) * n + i]
            + 2.0 * (w[s + 5 * n] + t5) * w[(_D + 4) * n + i]
        )
        w[s] = t0
        w[s + n] = t1
        w[s + 2 * n] = t2
        w[s + 3 * n] = t3
        w[s + 4 * n] = t4
        w[s + 5 * n] = t5
        scale = jacobian / w[(_Q + 6) * n + i]
        mean = w[(_Q + 7) * n + i]
        t0, t1, t2 = scale * d0 + mean, scale * d1 + mean, scale * d2 + mean
        t3, t4, t5 = scale * d3, scale * d4, scale * d5
        k0, k1, k2 = w[_Q * n + i], w[(_Q + 1) * n + i], w[(_Q + 2) * n + i]
        k3, k4, k5 = w[(_Q + 3) * n + i], w[(_Q + 4) * n + i], w[(_Q + 5) * n + i]
        v = w[(_G + GEO_VOLUME) * n + i]
        z00, z01, z02 = (
            v * (t0 * k0 + t3 * k3 + t4 * k4),
            v * (t0 * k3 + t3 * k1 + t4 * k5),
            v * (t0 * k4 + t3 * k5 + t4 * k2),
        )
        z10, z11, z12 = (
            v * (t3 * k0 + t1 * k3 + t5 * k4),
            v * (t3 * k3 + t1 * k1 + t5 * k5),
            v * (t3 * k4 + t1 * k5 + t5 * k2),
        )
        z20, z21, z22 = (
            v * (t4 * k0 + t5 * k3 + t2 * k4),
            v * (t4 * k3 + t5 * k1 + t2 * k5),
            v * (t4 * k4 + t5 * k5 + t2 * k2),
        )
        for c in range(3):
            r0, r1, r2 = w[(_R + 3 * c) * n + i], w[(_R + 3 * c + 1) * n + i], w[(_R + 3 * c + 2) * n + i]
            w[(_P + 3 * c) * n + i] = r0 * z00 + r1 * z10 + r2 * z20
            w[(_P + 3 * c + 1) * n + i] = r0 * z01 + r1 * z11 + r2 * z21
            w[(_P + 3 * c + 2) * n + i] = r0 * z02 + r1 * z12 + r2 * z22
