"""The element loop: strain, stress and nodal forces of one-point hexahedra, `LANES` elements at a time.

Everything here is written for the compiler: elements come in blocks of `LANES`, each quantity is a row of `LANES`
numbers, and every row of a block's working set lies in one flat array at an offset known at compile time, so that the
inner loops over lanes become vector instructions.

Formulation (docs/fe_engine.md): uniform-gradient hexahedron in the reference configuration (Flanagan and Belytschko,
doi:10.1002/nme.1620170504), polar decomposition F = R U (Hoger and Carlson, Q. Appl. Math. 42 (1984) 113-117), strain
increment sym(dU U_mid^-1) in the rotated frame (the Green-Naghdi rate form), Prony recursion exact for a strain that is
linear over the step, forces from the first Piola-Kirchhoff stress.
"""

from __future__ import annotations

from ..kernels import kernel
from .hyperelastic_kernel import cauchy_and_strain, stress_for_strain

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
# Rows of the working set: displacements (24), F (9), hourglass (12), C = F^T F (6), first two invariants of C and of U
# (4), strain increment (6), hereditary strain (6), J U^-1 and J (7), Piola-Kirchhoff stress (9), least J (1).
_U, _F, _Q, _C, _V, _D, _S, _I, _P, _W = 0, 24, 33, 45, 51, 55, 61, 67, 74, 83
WORK_ROWS = 84


@kernel(fastmath=FAST, boundscheck=False)
def block_forces(first, last, dt, u, conn, geo, state, hist, decay, gain, elastic, kind, out, work):  # type: ignore[no-untyped-def]  # numba types it
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
    elastic : (kinds, 6): twice the shear modulus, bulk modulus (both instantaneous), long-term ratios of each, the time
        by which the strain rate adds to the strain (stiffness-proportional damping), and 1 for the neo-Hookean law
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
    h1 = hist.reshape(-1)
    w = work
    for i in range(n):
        w[_W * n + i] = 1e30
    for b in range(first, last):
        cb = b * 8 * n
        k = kind[b]
        for a in range(8):
            for i in range(n):
                at = c1[cb + a * n + i]
                if at < 0:  # never so; keeps the compiler from gather instructions, which are slower here
                    break
                w[(_U + 3 * a) * n + i] = u1[at]
                w[(_U + 3 * a + 1) * n + i] = u1[at + 1]
                w[(_U + 3 * a + 2) * n + i] = u1[at + 2]
        # slices: indices into them cannot be negative, else every access goes through gather and scatter instructions
        fixed = geo.reshape(-1)[b * GEO_ROWS * n : (b + 1) * GEO_ROWS * n]
        kept = state.reshape(-1)[b * STATE_ROWS * n : (b + 1) * STATE_ROWS * n]
        # deformation gradient
        for i in range(n):
            f00 = 0.0
            f01 = 0.0
            f02 = 0.0
            f10 = 0.0
            f11 = 0.0
            f12 = 0.0
            f20 = 0.0
            f21 = 0.0
            f22 = 0.0
            for a in range(8):
                x = w[(_U + 3 * a) * n + i]
                y = w[(_U + 3 * a + 1) * n + i]
                z = w[(_U + 3 * a + 2) * n + i]
                d0 = fixed[(GEO_B + a) * n + i]
                d1 = fixed[(GEO_B + 8 + a) * n + i]
                d2 = fixed[(GEO_B + 16 + a) * n + i]
                f00 += x * d0
                f01 += x * d1
                f02 += x * d2
                f10 += y * d0
                f11 += y * d1
                f12 += y * d2
                f20 += z * d0
                f21 += z * d1
                f22 += z * d2
            w[_F * n + i] = f00
            w[(_F + 1) * n + i] = f01
            w[(_F + 2) * n + i] = f02
            w[(_F + 3) * n + i] = f10
            w[(_F + 4) * n + i] = f11
            w[(_F + 5) * n + i] = f12
            w[(_F + 6) * n + i] = f20
            w[(_F + 7) * n + i] = f21
            w[(_F + 8) * n + i] = f22
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
                g = GEO_G * n + i
                w[(_Q + c) * n + i] = 0.125 * (q0 - fx * fixed[g] - fy * fixed[g + n] - fz * fixed[g + 2 * n])
                w[(_Q + 3 + c) * n + i] = 0.125 * (
                    q1 - fx * fixed[g + 3 * n] - fy * fixed[g + 4 * n] - fz * fixed[g + 5 * n]
                )
                w[(_Q + 6 + c) * n + i] = 0.125 * (
                    q2 - fx * fixed[g + 6 * n] - fy * fixed[g + 7 * n] - fz * fixed[g + 8 * n]
                )
                w[(_Q + 9 + c) * n + i] = 0.125 * (
                    q3 - fx * fixed[g + 9 * n] - fy * fixed[g + 10 * n] - fz * fixed[g + 11 * n]
                )
        for i in range(n):
            w[_F * n + i] += 1.0
            w[(_F + 4) * n + i] += 1.0
            w[(_F + 8) * n + i] += 1.0
        # C = F^T F, det F and the invariants of U: I^2 = I_C + 2 II, II^2 = II_C + 2 III I by Newton's
        # iteration from those of the stretch before: two steps with the matrix of the first, which leave the product of
        # their corrections, and more where that is no rounding
        change = 0.0
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
            c0 = f00 * f00 + f10 * f10 + f20 * f20
            c1_ = f01 * f01 + f11 * f11 + f21 * f21
            c2 = f02 * f02 + f12 * f12 + f22 * f22
            c3 = f00 * f01 + f10 * f11 + f20 * f21
            c4 = f00 * f02 + f10 * f12 + f20 * f22
            c5 = f01 * f02 + f11 * f12 + f21 * f22
            jacobian = f00 * (f11 * f22 - f12 * f21) + f01 * (f12 * f20 - f10 * f22) + f02 * (f10 * f21 - f11 * f20)
            w[_C * n + i] = c0
            w[(_C + 1) * n + i] = c1_
            w[(_C + 2) * n + i] = c2
            w[(_C + 3) * n + i] = c3
            w[(_C + 4) * n + i] = c4
            w[(_C + 5) * n + i] = c5
            w[(_I + 6) * n + i] = jacobian
            first_of_c = c0 + c1_ + c2
            second_of_c = (c0 * c1_ - c3 * c3) + (c0 * c2 - c4 * c4) + (c1_ * c2 - c5 * c5)
            w[_V * n + i] = first_of_c
            w[(_V + 1) * n + i] = second_of_c
            su = STATE_U * n + i
            v0 = kept[su]
            v1 = kept[su + n]
            v2 = kept[su + 2 * n]
            v3 = kept[su + 3 * n]
            v4 = kept[su + 4 * n]
            v5 = kept[su + 5 * n]
            trace = v0 + v1 + v2
            minors = (v0 * v1 - v3 * v3) + (v0 * v2 - v4 * v4) + (v1 * v2 - v5 * v5)
            x = trace * trace - 2.0 * minors - first_of_c
            y = minors * minors - 2.0 * jacobian * trace - second_of_c
            h = 0.5 / (trace * minors - jacobian)
            h00 = h * minors
            h10 = h * jacobian
            h11 = h * trace
            trace -= h00 * x + h * y
            minors -= h10 * x + h11 * y
            x = trace * trace - 2.0 * minors - first_of_c
            y = minors * minors - 2.0 * jacobian * trace - second_of_c
            t0 = h00 * x + h * y
            t1 = h10 * x + h11 * y
            w[(_V + 2) * n + i] = trace - t0
            w[(_V + 3) * n + i] = minors - t1
            change += t0 * t0 + t1 * t1
        for _ in range(20):
            if not change > 1e-20:
                break
            change = 0.0
            for i in range(n):
                jacobian = w[(_I + 6) * n + i]
                trace = w[(_V + 2) * n + i]
                minors = w[(_V + 3) * n + i]
                x = trace * trace - 2.0 * minors - w[_V * n + i]
                y = minors * minors - 2.0 * jacobian * trace - w[(_V + 1) * n + i]
                h = 0.5 / (trace * minors - jacobian)
                t0 = h * (minors * x + y)
                t1 = h * (jacobian * x + trace * y)
                w[(_V + 2) * n + i] = trace - t0
                w[(_V + 3) * n + i] = minors - t1
                change += t0 * t0 + t1 * t1
            if not change > 1e-15:
                break
        # stretch by the theorem of Cayley and Hamilton, its increment, the rotated frame's strain increment and J U^-1
        for i in range(n):
            c0 = w[_C * n + i]
            c1_ = w[(_C + 1) * n + i]
            c2 = w[(_C + 2) * n + i]
            c3 = w[(_C + 3) * n + i]
            c4 = w[(_C + 4) * n + i]
            c5 = w[(_C + 5) * n + i]
            jacobian = w[(_I + 6) * n + i]
            trace = w[(_V + 2) * n + i]
            minors = w[(_V + 3) * n + i]
            h = 1.0 / (trace * minors - jacobian)
            x = h * (trace * trace - minors)
            y = h * trace * jacobian
            u0 = y + x * c0 - h * (c0 * c0 + c3 * c3 + c4 * c4)
            u1_ = y + x * c1_ - h * (c3 * c3 + c1_ * c1_ + c5 * c5)
            u2 = y + x * c2 - h * (c4 * c4 + c5 * c5 + c2 * c2)
            u3 = x * c3 - h * (c0 * c3 + c3 * c1_ + c4 * c5)
            u4 = x * c4 - h * (c0 * c4 + c3 * c5 + c4 * c2)
            u5 = x * c5 - h * (c3 * c4 + c1_ * c5 + c5 * c2)
            # the adjugate of U
            w[_I * n + i] = c0 - trace * u0 + minors
            w[(_I + 1) * n + i] = c1_ - trace * u1_ + minors
            w[(_I + 2) * n + i] = c2 - trace * u2 + minors
            w[(_I + 3) * n + i] = c3 - trace * u3
            w[(_I + 4) * n + i] = c4 - trace * u4
            w[(_I + 5) * n + i] = c5 - trace * u5
            su = STATE_U * n + i
            v0 = kept[su]
            v1 = kept[su + n]
            v2 = kept[su + 2 * n]
            v3 = kept[su + 3 * n]
            v4 = kept[su + 4 * n]
            v5 = kept[su + 5 * n]
            kept[su] = u0
            kept[su + n] = u1_
            kept[su + 2 * n] = u2
            kept[su + 3 * n] = u3
            kept[su + 4 * n] = u4
            kept[su + 5 * n] = u5
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
        for i in range(n):
            w[_W * n + i] = min(w[_W * n + i], w[(_I + 6) * n + i])
        # long-term strain, then the Prony terms: rows 0-4 deviator, row 5 volume
        same = True
        for t in range(terms):
            same = same and gain[k, t, 0] == gain[k, t, 1]
        damp = elastic[k, 4] / dt
        if elastic[k, 5] > 0.0:
            stress_for_strain(
                kept[STATE_U * n : (STATE_U + 6) * n], w[(_I + 6) * n : (_I + 7) * n],
                kept[STATE_STRAIN * n : (STATE_STRAIN + 6) * n], w[_D * n : (_D + 6) * n], w[_P * n : (_P + 6) * n],
            )  # fmt: skip
        if elastic[k, 2] == 0.0 and elastic[k, 3] == 0.0 and elastic[k, 5] == 0.0:
            # all relaxes within the run: nothing asks for the strain
            for i in range(6 * n):
                w[_S * n + i] = damp * w[_D * n + i]
        else:
            for c in range(6):
                ratio = elastic[k, 2] if c < 5 else elastic[k, 3]
                for i in range(n):
                    e = kept[(STATE_STRAIN + c) * n + i] + w[(_D + c) * n + i]
                    kept[(STATE_STRAIN + c) * n + i] = e
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
        if t + 2 <= terms and same:
            own = h1[(b * terms + t) * 6 * n : (b * terms + t + 2) * 6 * n]
            fade0, fade1 = decay[k, t], decay[k, t + 1]
            grow0, grow1 = gain[k, t, 0], gain[k, t + 1, 0]
            for i in range(6 * n):
                d = w[_D * n + i]
                q0 = fade0 * own[i] + grow0 * d
                q1 = fade1 * own[6 * n + i] + grow1 * d
                own[i] = q0
                own[6 * n + i] = q1
                w[_S * n + i] += q0 + q1
            t += 2
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
        if elastic[k, 5] > 0.0:
            cauchy_and_strain(
                damp, w[(_I + 6) * n : (_I + 7) * n], w[_S * n : (_S + 6) * n], w[_D * n : (_D + 6) * n],
                w[_P * n : (_P + 6) * n],
            )  # fmt: skip
        # stress in the rotated frame, bulk viscosity, first Piola-Kirchhoff stress times volume
        shear = elastic[k, 0]
        bulk = elastic[k, 1]
        for i in range(n):
            rate = w[(_D + 5) * n + i] / dt
            squeeze = min(rate, 0.0)
            viscous = fixed[GEO_BULK_LINEAR * n + i] * rate - fixed[GEO_BULK_QUADRATIC * n + i] * squeeze * squeeze
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
            so = STATE_STRESS * n + i
            half = 0.5 * fixed[GEO_VOLUME * n + i]
            z00 = jacobian * t0
            z01 = jacobian * t1
            z02 = jacobian * t2
            z10 = jacobian * t3
            z11 = jacobian * t4
            z12 = jacobian * t5
            kept[STATE_WORK * n + i] += half * (
                (kept[so] + z00) * e0
                + (kept[so + n] + z01) * e1
                + (kept[so + 2 * n] + z02) * e2
                + 2.0 * (kept[so + 3 * n] + z10) * w[(_D + 2) * n + i]
                + 2.0 * (kept[so + 4 * n] + z11) * w[(_D + 3) * n + i]
                + 2.0 * (kept[so + 5 * n] + z12) * w[(_D + 4) * n + i]
            )
            kept[so] = z00
            kept[so + n] = z01
            kept[so + 2 * n] = z02
            kept[so + 3 * n] = z10
            kept[so + 4 * n] = z11
            kept[so + 5 * n] = z12
            z00 = jacobian * viscous
            kept[STATE_BULK * n + i] += half * (kept[STATE_VISCOUS * n + i] + z00) * w[(_D + 5) * n + i]
            kept[STATE_VISCOUS * n + i] = z00
            t0 += viscous
            t1 += viscous
            t2 += viscous
            k0 = w[_I * n + i]
            k1 = w[(_I + 1) * n + i]
            k2 = w[(_I + 2) * n + i]
            k3 = w[(_I + 3) * n + i]
            k4 = w[(_I + 4) * n + i]
            k5 = w[(_I + 5) * n + i]
            # first Piola-Kirchhoff stress times volume, R T J U^-1 V = F (J U^-1) T (J U^-1) V/J
            z00 = t0 * k0 + t3 * k3 + t4 * k4
            z01 = t0 * k3 + t3 * k1 + t4 * k5
            z02 = t0 * k4 + t3 * k5 + t4 * k2
            z10 = t3 * k0 + t1 * k3 + t5 * k4
            z11 = t3 * k3 + t1 * k1 + t5 * k5
            z12 = t3 * k4 + t1 * k5 + t5 * k2
            z20 = t4 * k0 + t5 * k3 + t2 * k4
            z21 = t4 * k3 + t5 * k1 + t2 * k5
            z22 = t4 * k4 + t5 * k5 + t2 * k2
            scale = fixed[GEO_VOLUME * n + i] / jacobian
            t0 = scale * (k0 * z00 + k3 * z10 + k4 * z20)
            t1 = scale * (k3 * z01 + k1 * z11 + k5 * z21)
            t2 = scale * (k4 * z02 + k5 * z12 + k2 * z22)
            t3 = scale * (k0 * z01 + k3 * z11 + k4 * z21)
            t4 = scale * (k0 * z02 + k3 * z12 + k4 * z22)
            t5 = scale * (k3 * z02 + k1 * z12 + k5 * z22)
            for c in range(3):
                r0 = w[(_F + 3 * c) * n + i]
                r1 = w[(_F + 3 * c + 1) * n + i]
                r2 = w[(_F + 3 * c + 2) * n + i]
                w[(_P + 3 * c) * n + i] = r0 * t0 + r1 * t3 + r2 * t4
                w[(_P + 3 * c + 1) * n + i] = r0 * t3 + r1 * t1 + r2 * t5
                w[(_P + 3 * c + 2) * n + i] = r0 * t4 + r1 * t5 + r2 * t2
        forces = out.reshape(-1)[b * 24 * n : (b + 1) * 24 * n]
        # nodal forces, the hourglass part with its offset folded into the stress
        for i in range(n):
            stiff = 0.125 * fixed[GEO_HOURGLASS * n + i]
            g = GEO_G * n + i
            q00 = stiff * w[_Q * n + i]
            q10 = stiff * w[(_Q + 3) * n + i]
            q20 = stiff * w[(_Q + 6) * n + i]
            q30 = stiff * w[(_Q + 9) * n + i]
            q01 = stiff * w[(_Q + 1) * n + i]
            q11 = stiff * w[(_Q + 4) * n + i]
            q21 = stiff * w[(_Q + 7) * n + i]
            q31 = stiff * w[(_Q + 10) * n + i]
            q02 = stiff * w[(_Q + 2) * n + i]
            q12 = stiff * w[(_Q + 5) * n + i]
            q22 = stiff * w[(_Q + 8) * n + i]
            q32 = stiff * w[(_Q + 11) * n + i]
            p00 = (
                w[_P * n + i]
                - q00 * fixed[g]
                - q10 * fixed[g + 3 * n]
                - q20 * fixed[g + 6 * n]
                - q30 * fixed[g + 9 * n]
            )
            p01 = (
                w[(_P + 1) * n + i]
                - q00 * fixed[g + n]
                - q10 * fixed[g + 4 * n]
                - q20 * fixed[g + 7 * n]
                - q30 * fixed[g + 10 * n]
            )
            p02 = (
                w[(_P + 2) * n + i]
                - q00 * fixed[g + 2 * n]
                - q10 * fixed[g + 5 * n]
                - q20 * fixed[g + 8 * n]
                - q30 * fixed[g + 11 * n]
            )
            s0 = q00 + q10
            m0 = q00 - q10
            e0 = q20 + q30
            d0 = q20 - q30
            p10 = (
                w[(_P + 3) * n + i]
                - q01 * fixed[g]
                - q11 * fixed[g + 3 * n]
                - q21 * fixed[g + 6 * n]
                - q31 * fixed[g + 9 * n]
            )
            p11 = (
                w[(_P + 4) * n + i]
                - q01 * fixed[g + n]
                - q11 * fixed[g + 4 * n]
                - q21 * fixed[g + 7 * n]
                - q31 * fixed[g + 10 * n]
            )
            p12 = (
                w[(_P + 5) * n + i]
                - q01 * fixed[g + 2 * n]
                - q11 * fixed[g + 5 * n]
                - q21 * fixed[g + 8 * n]
                - q31 * fixed[g + 11 * n]
            )
            s1 = q01 + q11
            m1 = q01 - q11
            e1 = q21 + q31
            d1 = q21 - q31
            p20 = (
                w[(_P + 6) * n + i]
                - q02 * fixed[g]
                - q12 * fixed[g + 3 * n]
                - q22 * fixed[g + 6 * n]
                - q32 * fixed[g + 9 * n]
            )
            p21 = (
                w[(_P + 7) * n + i]
                - q02 * fixed[g + n]
                - q12 * fixed[g + 4 * n]
                - q22 * fixed[g + 7 * n]
                - q32 * fixed[g + 10 * n]
            )
            p22 = (
                w[(_P + 8) * n + i]
                - q02 * fixed[g + 2 * n]
                - q12 * fixed[g + 5 * n]
                - q22 * fixed[g + 8 * n]
                - q32 * fixed[g + 11 * n]
            )
            s2 = q02 + q12
            m2 = q02 - q12
            e2 = q22 + q32
            d2 = q22 - q32
            gx = GEO_B * n + i
            bx = fixed[gx]
            by = fixed[gx + 8 * n]
            bz = fixed[gx + 16 * n]
            forces[i] = (s0 + d0) + p00 * bx + p01 * by + p02 * bz
            forces[i + n] = (s1 + d1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 2 * n] = (s2 + d2) + p20 * bx + p21 * by + p22 * bz
            bx = fixed[gx + n]
            by = fixed[gx + 9 * n]
            bz = fixed[gx + 17 * n]
            forces[i + 3 * n] = (m0 - d0) + p00 * bx + p01 * by + p02 * bz
            forces[i + 4 * n] = (m1 - d1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 5 * n] = (m2 - d2) + p20 * bx + p21 * by + p22 * bz
            bx = fixed[gx + 2 * n]
            by = fixed[gx + 10 * n]
            bz = fixed[gx + 18 * n]
            forces[i + 6 * n] = (d0 - s0) + p00 * bx + p01 * by + p02 * bz
            forces[i + 7 * n] = (d1 - s1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 8 * n] = (d2 - s2) + p20 * bx + p21 * by + p22 * bz
            bx = fixed[gx + 3 * n]
            by = fixed[gx + 11 * n]
            bz = fixed[gx + 19 * n]
            forces[i + 9 * n] = (-m0 - d0) + p00 * bx + p01 * by + p02 * bz
            forces[i + 10 * n] = (-m1 - d1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 11 * n] = (-m2 - d2) + p20 * bx + p21 * by + p22 * bz
            bx = fixed[gx + 4 * n]
            by = fixed[gx + 12 * n]
            bz = fixed[gx + 20 * n]
            forces[i + 12 * n] = (e0 - s0) + p00 * bx + p01 * by + p02 * bz
            forces[i + 13 * n] = (e1 - s1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 14 * n] = (e2 - s2) + p20 * bx + p21 * by + p22 * bz
            bx = fixed[gx + 5 * n]
            by = fixed[gx + 13 * n]
            bz = fixed[gx + 21 * n]
            forces[i + 15 * n] = (-m0 - e0) + p00 * bx + p01 * by + p02 * bz
            forces[i + 16 * n] = (-m1 - e1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 17 * n] = (-m2 - e2) + p20 * bx + p21 * by + p22 * bz
            bx = fixed[gx + 6 * n]
            by = fixed[gx + 14 * n]
            bz = fixed[gx + 22 * n]
            forces[i + 18 * n] = (s0 + e0) + p00 * bx + p01 * by + p02 * bz
            forces[i + 19 * n] = (s1 + e1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 20 * n] = (s2 + e2) + p20 * bx + p21 * by + p22 * bz
            bx = fixed[gx + 7 * n]
            by = fixed[gx + 15 * n]
            bz = fixed[gx + 23 * n]
            forces[i + 21 * n] = (m0 - e0) + p00 * bx + p01 * by + p02 * bz
            forces[i + 22 * n] = (m1 - e1) + p10 * bx + p11 * by + p12 * bz
            forces[i + 23 * n] = (m2 - e2) + p20 * bx + p21 * by + p22 * bz
    worst = 1e30
    for i in range(n):
        worst = min(worst, w[_W * n + i])
    return worst
