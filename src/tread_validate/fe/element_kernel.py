"""The element loop: strain, stress and nodal forces of one-point hexahedra, `LANES` elements at a time.

Everything here is written for the compiler: elements come in blocks of `LANES`, each quantity is a row of `LANES`
numbers, and every row of a block's working set lies in one flat array at an offset known at compile time, so that the
inner loops over lanes become vector instructions.

Formulation (docs/fe_engine.md): uniform-gradient hexahedron in the reference configuration (Flanagan and Belytschko,
doi:10.1002/nme.1620170504), polar decomposition F = R U, strain increment sym(dU U_mid^-1) in the rotated frame (the
Green-Naghdi rate form), Prony recursion exact for a strain that is linear over the step, forces from the first
Piola-Kirchhoff stress.
"""

from __future__ import annotations

from ..kernels import kernel

LANES = 16
FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}

# Rows of the geometry of a block: gradients B[j, a] (24), hourglass offsets G[alpha, j] (12), then scalars.
GEO_B, GEO_G, GEO_VOLUME, GEO_HOURGLASS, GEO_BULK_LINEAR, GEO_BULK_QUADRATIC, GEO_VISCOUS = 0, 24, 36, 37, 38, 39, 40
GEO_ROWS = 41
# Rows of the state of a block: right stretch U (6: 11, 22, 33, 12, 13, 23), long-term strain (6), bulk viscous work,
# work of the stress, both of the element's reference volume; Kirchhoff stress in the rotated frame (11, 22, 33, 12, 13,
# 23) and bulk viscous pressure times J at the end of the increment before.
STATE_U, STATE_STRAIN, STATE_BULK, STATE_WORK, STATE_STRESS, STATE_VISCOUS = 0, 6, 12, 13, 14, 20
STATE_ROWS = 21
# Rows of the working set: displacements, later forces (24), F (9), R (9), hourglass (12), strain increment (6),
# hereditary strain (6), J U^-1 and J (7), Piola-Kirchhoff stress (9), then copies of geometry and state.
_U, _F, _R, _Q, _D, _S, _I, _P, _G, _T = 0, 24, 33, 42, 54, 60, 66, 73, 82, 123
WORK_ROWS = 144


@kernel(fastmath=FAST, boundscheck=False)
def block_forces(first, last, dt, u, conn, geo, state, hist, decay, gain, elastic, kind, out, work):  # type: ignore[no-untyped-def]
    """Advance blocks `first`..`last` by one step and write their element forces.

    Parameters
    ----------
    first, last : int
        Blocks to do.
    dt : float
        Length of the step just made, s.
    u : (3 nodes,) displacement
    conn : (blocks, 8, LANES) int32, 3 times the node number
    geo, state : (blocks, rows, LANES)
    hist : (blocks, terms, 6, LANES) Prony histories of strain
    decay : (kinds, terms); gain : (kinds, terms, 2) for the deviator and the volume
    elastic : (kinds, 5): twice the shear modulus, bulk modulus (both instantaneous), long-term ratios of each, and the
        time by which the strain rate adds to the strain (stiffness-proportional damping)
    kind : (blocks,) int32, row of the material tables
    out : (blocks, 24, LANES) internal forces, rows 3 a + component
    work : (WORK_ROWS * LANES,) working set

    Returns
    -------
    float
        Least ratio of current to reference volume; not positive, or not a number, when an element has turned inside
        out.
    """
    n = LANES
    terms = hist.shape[1]
    u1 = u.reshape(-1)
    c1 = conn.reshape(-1)
    g1 = geo.reshape(-1)
    s1 = state.reshape(-1)
    h1 = hist.reshape(-1)
    o1 = out.reshape(-1)
    w = work
    worst = 1e30
    for b in range(first, last):
        cb = b * 8 * n
        gb = b * GEO_ROWS * n
        sb = b * STATE_ROWS * n
        ob = b * 24 * n
        k = kind[b]
        for a in range(8):
            for i in range(n):
                at = c1[cb + a * n + i]
                if at < 0:  # never so; keeps the compiler from gather instructions, which are slower here
                    break
                w[(_U + 3 * a) * n + i] = u1[at]
                w[(_U + 3 * a + 1) * n + i] = u1[at + 1]
                w[(_U + 3 * a + 2) * n + i] = u1[at + 2]
        for i in range(GEO_ROWS * n):
            w[_G * n + i] = g1[gb + i]
        for i in range(STATE_ROWS * n):
            w[_T * n + i] = s1[sb + i]
        # deformation gradient
        for c in range(3):
            for i in range(n):
                x = 0.0
                y = 0.0
                z = 0.0
                for a in range(8):
                    d = w[(_U + 3 * a + c) * n + i]
                    x += d * w[(_G + GEO_B + a) * n + i]
                    y += d * w[(_G + GEO_B + 8 + a) * n + i]
                    z += d * w[(_G + GEO_B + 16 + a) * n + i]
                w[(_F + 3 * c) * n + i] = x
                w[(_F + 3 * c + 1) * n + i] = y
                w[(_F + 3 * c + 2) * n + i] = z
        # hourglass amplitudes q[alpha, c] = (Gamma u - grad u . Gamma X) / 8
        for c in range(3):
            for i in range(n):
                d0 = w[(_U + c) * n + i]
                d1 = w[(_U + 3 + c) * n + i]
                d2 = w[(_U + 6 + c) * n + i]
                d3 = w[(_U + 9 + c) * n + i]
                d4 = w[(_U + 12 + c) * n + i]
                d5 = w[(_U + 15 + c) * n + i]
                d6 = w[(_U + 18 + c) * n + i]
                d7 = w[(_U + 21 + c) * n + i]
                fx = w[(_F + 3 * c) * n + i]
                fy = w[(_F + 3 * c + 1) * n + i]
                fz = w[(_F + 3 * c + 2) * n + i]
                m01 = d0 - d1
                m23 = d2 - d3
                m45 = d4 - d5
                m67 = d6 - d7
                p01 = d0 + d1
                p23 = d2 + d3
                p45 = d4 + d5
                p67 = d6 + d7
                q0 = p01 - p23 - p45 + p67
                q1 = m01 - m23 - m45 + m67
                q2 = m01 + m23 + m45 + m67
                q3 = -m01 - m23 + m45 + m67
                g = (_G + GEO_G) * n + i
                w[(_Q + c) * n + i] = 0.125 * (q0 - fx * w[g] - fy * w[g + n] - fz * w[g + 2 * n])
                w[(_Q + 3 + c) * n + i] = 0.125 * (q1 - fx * w[g + 3 * n] - fy * w[g + 4 * n] - fz * w[g + 5 * n])
                w[(_Q + 6 + c) * n + i] = 0.125 * (q2 - fx * w[g + 6 * n] - fy * w[g + 7 * n] - fz * w[g + 8 * n])
                w[(_Q + 9 + c) * n + i] = 0.125 * (q3 - fx * w[g + 9 * n] - fy * w[g + 10 * n] - fz * w[g + 11 * n])
        for i in range(n):
            w[_F * n + i] += 1.0
            w[(_F + 4) * n + i] += 1.0
            w[(_F + 8) * n + i] += 1.0
        # rotation: Newton's iteration R <- (R + R^-T)/2 from R = F (Higham, doi:10.1137/0907079), quadratic
        for i in range(9 * n):
            w[_R * n + i] = w[_F * n + i]
        for _ in range(12):
            change = 0.0
            for i in range(n):
                a00 = w[_R * n + i]
                a01 = w[(_R + 1) * n + i]
                a02 = w[(_R + 2) * n + i]
                a10 = w[(_R + 3) * n + i]
                a11 = w[(_R + 4) * n + i]
                a12 = w[(_R + 5) * n + i]
                a20 = w[(_R + 6) * n + i]
                a21 = w[(_R + 7) * n + i]
                a22 = w[(_R + 8) * n + i]
                k00 = a11 * a22 - a12 * a21
                k01 = a12 * a20 - a10 * a22
                k02 = a10 * a21 - a11 * a20
                h = 0.5 / (a00 * k00 + a01 * k01 + a02 * k02)
                r00 = 0.5 * a00 + h * k00
                r01 = 0.5 * a01 + h * k01
                r02 = 0.5 * a02 + h * k02
                r10 = 0.5 * a10 + h * (a02 * a21 - a01 * a22)
                r11 = 0.5 * a11 + h * (a00 * a22 - a02 * a20)
                r12 = 0.5 * a12 + h * (a01 * a20 - a00 * a21)
                r20 = 0.5 * a20 + h * (a01 * a12 - a02 * a11)
                r21 = 0.5 * a21 + h * (a02 * a10 - a00 * a12)
                r22 = 0.5 * a22 + h * (a00 * a11 - a01 * a10)
                w[_R * n + i] = r00
                w[(_R + 1) * n + i] = r01
                w[(_R + 2) * n + i] = r02
                w[(_R + 3) * n + i] = r10
                w[(_R + 4) * n + i] = r11
                w[(_R + 5) * n + i] = r12
                w[(_R + 6) * n + i] = r20
                w[(_R + 7) * n + i] = r21
                w[(_R + 8) * n + i] = r22
                t0 = r00 - a00
                t1 = r01 - a01
                t2 = r02 - a02
                t3 = r10 - a10
                t4 = r11 - a11
                t5 = r12 - a12
                t6 = r20 - a20
                t7 = r21 - a21
                t8 = r22 - a22
                change += t0 * t0 + t1 * t1 + t2 * t2 + t3 * t3 + t4 * t4 + t5 * t5 + t6 * t6 + t7 * t7 + t8 * t8
            if not change > 1e-15:
                break
        # stretch, its increment, the strain increment in the rotated frame, U^-1 and J
        for i in range(n):
            f00 = w[_F * n + i]
            f01 = w[(_F + 1) * n + i]
            f02 = w[(_F + 2) * n + i]
            f10 = w[(_F + 3) * n + i]
            f11 = w[(_F + 4) * n + i]
            f12 = w[(_F + 5) * n + i]
            f20 = w[(_F + 6) * n + i]
            f21 = w[(_F + 7) * n + i]
            f22 = w[(_F + 8) * n + i]
            r00 = w[_R * n + i]
            r01 = w[(_R + 1) * n + i]
            r02 = w[(_R + 2) * n + i]
            r10 = w[(_R + 3) * n + i]
            r11 = w[(_R + 4) * n + i]
            r12 = w[(_R + 5) * n + i]
            r20 = w[(_R + 6) * n + i]
            r21 = w[(_R + 7) * n + i]
            r22 = w[(_R + 8) * n + i]
            u0 = r00 * f00 + r10 * f10 + r20 * f20
            u1_ = r01 * f01 + r11 * f11 + r21 * f21
            u2 = r02 * f02 + r12 * f12 + r22 * f22
            u3 = 0.5 * (r00 * f01 + r10 * f11 + r20 * f21 + r01 * f00 + r11 * f10 + r21 * f20)
            u4 = 0.5 * (r00 * f02 + r10 * f12 + r20 * f22 + r02 * f00 + r12 * f10 + r22 * f20)
            u5 = 0.5 * (r01 * f02 + r11 * f12 + r21 * f22 + r02 * f01 + r12 * f11 + r22 * f21)
            su = (_T + STATE_U) * n + i
            v0 = w[su]
            v1 = w[su + n]
            v2 = w[su + 2 * n]
            v3 = w[su + 3 * n]
            v4 = w[su + 4 * n]
            v5 = w[su + 5 * n]
            w[su] = u0
            w[su + n] = u1_
            w[su + 2 * n] = u2
            w[su + 3 * n] = u3
            w[su + 4 * n] = u4
            w[su + 5 * n] = u5
            m0 = 0.5 * (u0 + v0)
            m1 = 0.5 * (u1_ + v1)
            m2 = 0.5 * (u2 + v2)
            m3 = 0.5 * (u3 + v3)
            m4 = 0.5 * (u4 + v4)
            m5 = 0.5 * (u5 + v5)
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
            v0 = u0 - v0
            v1 = u1_ - v1
            v2 = u2 - v2
            v3 = u3 - v3
            v4 = u4 - v4
            v5 = u5 - v5
            e0 = v0 * k0 + v3 * k3 + v4 * k4
            e1 = v3 * k3 + v1 * k1 + v5 * k5
            e2 = v4 * k4 + v5 * k5 + v2 * k2
            volume = e0 + e1 + e2
            third = volume / 3.0
            w[_D * n + i] = e0 - third
            w[(_D + 1) * n + i] = e1 - third
            w[(_D + 2) * n + i] = 0.5 * (v0 * k3 + v3 * k1 + v4 * k5 + v3 * k0 + v1 * k3 + v5 * k4)
            w[(_D + 3) * n + i] = 0.5 * (v0 * k4 + v3 * k5 + v4 * k2 + v4 * k0 + v5 * k3 + v2 * k4)
            w[(_D + 4) * n + i] = 0.5 * (v3 * k4 + v1 * k5 + v5 * k2 + v4 * k3 + v5 * k1 + v2 * k5)
            w[(_D + 5) * n + i] = volume
            k0 = u1_ * u2 - u5 * u5
            k3 = u4 * u5 - u3 * u2
            k4 = u3 * u5 - u1_ * u4
            # J U^-1 is the adjugate of U
            w[_I * n + i] = k0
            w[(_I + 1) * n + i] = u0 * u2 - u4 * u4
            w[(_I + 2) * n + i] = u0 * u1_ - u3 * u3
            w[(_I + 3) * n + i] = k3
            w[(_I + 4) * n + i] = k4
            w[(_I + 5) * n + i] = u3 * u4 - u0 * u5
            w[(_I + 6) * n + i] = u0 * k0 + u3 * k3 + u4 * k4
        for i in range(n):
            worst = min(worst, w[(_I + 6) * n + i])
        # long-term strain, then the Prony terms: rows 0-4 deviator, row 5 volume
        same = True
        for t in range(terms):
            same = same and gain[k, t, 0] == gain[k, t, 1]
        damp = elastic[k, 4] / dt
        for c in range(6):
            ratio = elastic[k, 2] if c < 5 else elastic[k, 3]
            for i in range(n):
                e = w[(_T + STATE_STRAIN + c) * n + i] + w[(_D + c) * n + i]
                w[(_T + STATE_STRAIN + c) * n + i] = e
                w[(_S + c) * n + i] = ratio * e + damp * w[(_D + c) * n + i]
        t = 0
        while t + 4 <= terms and same:
            # four terms at a time: the strain increment and the sum pass through memory once. Histories are taken as
            # slices, whose indices the compiler knows not to be negative; else it would not make vectors of them.
            own = h1[(b * terms + t) * 6 * n : (b * terms + t + 4) * 6 * n]
            fade0, fade1, fade2, fade3 = decay[k, t], decay[k, t + 1], decay[k, t + 2], decay[k, t + 3]
            grow0, grow1, grow2, grow3 = gain[k, t, 0], gain[k, t + 1, 0], gain[k, t + 2, 0], gain[k, t + 3, 0]
            for i in range(6 * n):
                d = w[_D * n + i]
                q0 = fade0 * own[i] + grow0 * d
                q1 = fade1 * own[6 * n + i] + grow1 * d
                q2 = fade2 * own[12 * n + i] + grow2 * d
                q3 = fade3 * own[18 * n + i] + grow3 * d
                own[i] = q0
                own[6 * n + i] = q1
                own[12 * n + i] = q2
                own[18 * n + i] = q3
                w[_S * n + i] += (q0 + q1) + (q2 + q3)
            t += 4
        while t < terms:
            own = h1[(b * terms + t) * 6 * n : (b * terms + t + 1) * 6 * n]
            fade = decay[k, t]
            grow = gain[k, t, 0]
            for i in range(5 * n):
                q = fade * own[i] + grow * w[_D * n + i]
                own[i] = q
                w[_S * n + i] += q
            grow = gain[k, t, 1]
            for i in range(n):
                q = fade * own[5 * n + i] + grow * w[(_D + 5) * n + i]
                own[5 * n + i] = q
                w[(_S + 5) * n + i] += q
            t += 1
        # stress in the rotated frame, bulk viscosity, first Piola-Kirchhoff stress times volume
        shear = elastic[k, 0]
        bulk = elastic[k, 1]
        for i in range(n):
            rate = w[(_D + 5) * n + i] / dt
            squeeze = min(rate, 0.0)
            viscous = (
                w[(_G + GEO_BULK_LINEAR) * n + i] * rate - w[(_G + GEO_BULK_QUADRATIC) * n + i] * squeeze * squeeze
            )
            d0 = w[_S * n + i]
            d1 = w[(_S + 1) * n + i]
            mean = bulk * w[(_S + 5) * n + i]
            t0 = shear * d0 + mean
            t1 = shear * d1 + mean
            t2 = mean - shear * (d0 + d1)
            t3 = shear * w[(_S + 2) * n + i]
            t4 = shear * w[(_S + 3) * n + i]
            t5 = shear * w[(_S + 4) * n + i]
            # works over the increment by the trapezoidal rule, which is the balance of central differences
            jacobian = w[(_I + 6) * n + i]
            third = w[(_D + 5) * n + i] / 3.0
            e0 = w[_D * n + i]
            e1 = w[(_D + 1) * n + i]
            e2 = third - e0 - e1
            e0 += third
            e1 += third
            so = (_T + STATE_STRESS) * n + i
            half = 0.5 * w[(_G + GEO_VOLUME) * n + i]
            z00 = jacobian * t0
            z01 = jacobian * t1
            z02 = jacobian * t2
            z10 = jacobian * t3
            z11 = jacobian * t4
            z12 = jacobian * t5
            w[(_T + STATE_WORK) * n + i] += half * (
                (w[so] + z00) * e0
                + (w[so + n] + z01) * e1
                + (w[so + 2 * n] + z02) * e2
                + 2.0 * (w[so + 3 * n] + z10) * w[(_D + 2) * n + i]
                + 2.0 * (w[so + 4 * n] + z11) * w[(_D + 3) * n + i]
                + 2.0 * (w[so + 5 * n] + z12) * w[(_D + 4) * n + i]
            )
            w[so] = z00
            w[so + n] = z01
            w[so + 2 * n] = z02
            w[so + 3 * n] = z10
            w[so + 4 * n] = z11
            w[so + 5 * n] = z12
            z00 = jacobian * viscous
            w[(_T + STATE_BULK) * n + i] += half * (w[(_T + STATE_VISCOUS) * n + i] + z00) * w[(_D + 5) * n + i]
            w[(_T + STATE_VISCOUS) * n + i] = z00
            t0 += viscous
            t1 += viscous
            t2 += viscous
            k0 = w[_I * n + i]
            k1 = w[(_I + 1) * n + i]
            k2 = w[(_I + 2) * n + i]
            k3 = w[(_I + 3) * n + i]
            k4 = w[(_I + 4) * n + i]
            k5 = w[(_I + 5) * n + i]
            volume = w[(_G + GEO_VOLUME) * n + i]
            z00 = volume * (t0 * k0 + t3 * k3 + t4 * k4)
            z01 = volume * (t0 * k3 + t3 * k1 + t4 * k5)
            z02 = volume * (t0 * k4 + t3 * k5 + t4 * k2)
            z10 = volume * (t3 * k0 + t1 * k3 + t5 * k4)
            z11 = volume * (t3 * k3 + t1 * k1 + t5 * k5)
            z12 = volume * (t3 * k4 + t1 * k5 + t5 * k2)
            z20 = volume * (t4 * k0 + t5 * k3 + t2 * k4)
            z21 = volume * (t4 * k3 + t5 * k1 + t2 * k5)
            z22 = volume * (t4 * k4 + t5 * k5 + t2 * k2)
            for c in range(3):
                r0 = w[(_R + 3 * c) * n + i]
                r1 = w[(_R + 3 * c + 1) * n + i]
                r2 = w[(_R + 3 * c + 2) * n + i]
                w[(_P + 3 * c) * n + i] = r0 * z00 + r1 * z10 + r2 * z20
                w[(_P + 3 * c + 1) * n + i] = r0 * z01 + r1 * z11 + r2 * z21
                w[(_P + 3 * c + 2) * n + i] = r0 * z02 + r1 * z12 + r2 * z22
        # nodal forces, the hourglass part with its offset folded into the stress
        for c in range(3):
            for i in range(n):
                stiff = 0.125 * w[(_G + GEO_HOURGLASS) * n + i]
                q0 = stiff * w[(_Q + c) * n + i]
                q1 = stiff * w[(_Q + 3 + c) * n + i]
                q2 = stiff * w[(_Q + 6 + c) * n + i]
                q3 = stiff * w[(_Q + 9 + c) * n + i]
                g = (_G + GEO_G) * n + i
                px = w[(_P + 3 * c) * n + i] - q0 * w[g] - q1 * w[g + 3 * n] - q2 * w[g + 6 * n] - q3 * w[g + 9 * n]
                py = (
                    w[(_P + 3 * c + 1) * n + i]
                    - q0 * w[g + n]
                    - q1 * w[g + 4 * n]
                    - q2 * w[g + 7 * n]
                    - q3 * w[g + 10 * n]
                )
                pz = (
                    w[(_P + 3 * c + 2) * n + i]
                    - q0 * w[g + 2 * n]
                    - q1 * w[g + 5 * n]
                    - q2 * w[g + 8 * n]
                    - q3 * w[g + 11 * n]
                )
                hg0 = q0 + q1 + q2 - q3
                hg1 = q0 - q1 - q2 + q3
                hg2 = -q0 - q1 + q2 - q3
                hg3 = -q0 + q1 - q2 + q3
                hg4 = -q0 - q1 + q2 + q3
                hg5 = -q0 + q1 - q2 - q3
                hg6 = q0 + q1 + q2 + q3
                hg7 = q0 - q1 - q2 - q3
                gx = (_G + GEO_B) * n + i
                gy = (_G + GEO_B + 8) * n + i
                gz = (_G + GEO_B + 16) * n + i
                o = (_U + c) * n + i
                w[o] = hg0 + px * w[gx] + py * w[gy] + pz * w[gz]
                w[o + 3 * n] = hg1 + px * w[gx + n] + py * w[gy + n] + pz * w[gz + n]
                w[o + 6 * n] = hg2 + px * w[gx + 2 * n] + py * w[gy + 2 * n] + pz * w[gz + 2 * n]
                w[o + 9 * n] = hg3 + px * w[gx + 3 * n] + py * w[gy + 3 * n] + pz * w[gz + 3 * n]
                w[o + 12 * n] = hg4 + px * w[gx + 4 * n] + py * w[gy + 4 * n] + pz * w[gz + 4 * n]
                w[o + 15 * n] = hg5 + px * w[gx + 5 * n] + py * w[gy + 5 * n] + pz * w[gz + 5 * n]
                w[o + 18 * n] = hg6 + px * w[gx + 6 * n] + py * w[gy + 6 * n] + pz * w[gz + 6 * n]
                w[o + 21 * n] = hg7 + px * w[gx + 7 * n] + py * w[gy + 7 * n] + pz * w[gz + 7 * n]
        for i in range(24 * n):
            o1[ob + i] = w[_U * n + i]
        for i in range(STATE_ROWS * n):
            s1[sb + i] = w[_T * n + i]
    return worst
