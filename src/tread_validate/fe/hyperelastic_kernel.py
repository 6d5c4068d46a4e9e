"""The neo-Hookean law with Prony factors, as two stages around the recursion of the element kernels.

U = C10 (I1_bar - 3) + (J - 1)^2/D1, C10 = G/2, D1 = 2/K: instantaneous Kirchhoff stress G dev B_bar + K J (J - 1) 1,
relaxed by the Prony series with g_i in its deviator and k_i in its mean, in the frame turned by R. The recursion of the
kernels is linear; it is given the stress over 2 G and K in the place of the strain, and gives Kirchhoff stress.

ABAQUS documents the same law with the history carried along by the whole distortional deformation instead of its
rotation alone (Theory Guide, finite-strain viscoelasticity). Both agree where strain is held, and to first order.

Arguments are rows of a block, one number a lane: stretch (11, 22, 33, 12, 13, 23), strain and stress (deviator 11, 22,
12, 13, 23, then volume), volume ratio.
"""

from __future__ import annotations

from ..kernels import kernel

FAST = {"contract", "reassoc", "nsz", "arcp", "afn"}


@kernel(fastmath=FAST, boundscheck=False)
def stress_for_strain(stretch, jacobian, total, increment, kept):  # type: ignore[no-untyped-def]  # numba types it
    """Keep the strain `increment` in `kept`; put that of the instantaneous stress, over 2 G and K, in its place.

    `total` is the instantaneous stress at the end of the increment before, over 2 G and K.
    """
    n = jacobian.size
    for i in range(6 * n):
        kept[i] = increment[i]
    for i in range(n):
        u0, u1, u2 = stretch[i], stretch[n + i], stretch[2 * n + i]
        u3, u4, u5 = stretch[3 * n + i], stretch[4 * n + i], stretch[5 * n + i]
        half = 0.5 * jacobian[i] ** (-2.0 / 3.0)
        c0 = half * (u0 * u0 + u3 * u3 + u4 * u4)
        c1 = half * (u3 * u3 + u1 * u1 + u5 * u5)
        third = (c0 + c1 + half * (u4 * u4 + u5 * u5 + u2 * u2)) / 3.0
        increment[i] = c0 - third - total[i]
        increment[n + i] = c1 - third - total[n + i]
        increment[2 * n + i] = half * (u0 * u3 + u3 * u1 + u4 * u5) - total[2 * n + i]
        increment[3 * n + i] = half * (u0 * u4 + u3 * u5 + u4 * u2) - total[3 * n + i]
        increment[4 * n + i] = half * (u3 * u4 + u1 * u5 + u5 * u2) - total[4 * n + i]
        increment[5 * n + i] = jacobian[i] * (jacobian[i] - 1.0) - total[5 * n + i]


@kernel(fastmath=FAST, boundscheck=False)
def cauchy_and_strain(damp, jacobian, stress, increment, kept):  # type: ignore[no-untyped-def]  # numba types it
    """Turn Kirchhoff `stress` to Cauchy, damped by `damp` times the strain increment, and put that back."""
    n = jacobian.size
    for row in range(6):
        for i in range(n):
            at = row * n + i
            stress[at] = (stress[at] - damp * increment[at]) / jacobian[i] + damp * kept[at]
            increment[at] = kept[at]


@kernel()
def long_term_energy(u0, u1, u2, u3, u4, u5, two_g, bulk):  # type: ignore[no-untyped-def]  # numba types it
    """Return the strain energy at a stretch (11, 22, 33, 12, 13, 23), per reference volume."""
    jacobian = u0 * (u1 * u2 - u5 * u5) + u3 * (u4 * u5 - u3 * u2) + u4 * (u3 * u5 - u1 * u4)
    trace = u0 * u0 + u1 * u1 + u2 * u2 + 2.0 * (u3 * u3 + u4 * u4 + u5 * u5)
    return 0.25 * two_g * (jacobian ** (-2.0 / 3.0) * trace - 3.0) + 0.5 * bulk * (jacobian - 1.0) ** 2
