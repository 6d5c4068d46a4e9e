"""One sub-step of slip: the lumped mass under spring and friction, by an L-stable implicit method.

``m lambda'' + F_l = sign(V1 - lambda') mu_k F_r`` (Eq. (12) of the paper) is stiff, for the friction law alone relaxes
within a microsecond, and it must not ring. Alexander's two-stage SDIRK method (SIAM J. Numer. Anal. 14 (1977)
1006-1021; order 2, L-stable, stiffly accurate) is used, with one scalar solve a stage (Newton, or bisection where it
strays); the springs' memory in it is that of the sticking element. With m = 0 a stage is the massless balance
|F_l| = mu_k F_r.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..friction import kinetic_kernel
from ..kernels import kernel
from .inputs import KernelLaw, Motion, Rubber
from .kinematics import MountPoint, sliding

Array = NDArray[np.float64]
Stage = tuple[bool, float, float, float, float, float, float, float, float]

NEWTON_STEPS = 50


@kernel()
def kinetic(law: KernelLaw, pressure: float, slip_speed: float) -> float:
    """Return the kinetic friction coefficient at a pressure (Pa) and slip speed (m/s)."""
    return kinetic_kernel(
        law.code,
        law.parameters,
        law.pressures,
        law.slip_speeds,
        law.table,
        max(pressure, 0.0),
        max(slip_speed, 0.0),
    )


@kernel()
def slip_stage(
    motion: Motion,
    rubber: Rubber,
    law: KernelLaw,
    at: MountPoint,
    height: float,
    direction: float,
    implicit: float,
    deflection_base: float,
    momentum_base: float,
    guess: float,
    radial: Array,
    longitudinal: Array,
) -> Stage:
    """Solve one implicit stage for the rate of lambda.

    Parameters
    ----------
    implicit : float, s
        Weight of the stage's own rates.
    deflection_base, momentum_base : float, m and kg/(m s)
        lambda and m lambda' without the stage's own rates.
    radial, longitudinal : (4,) arrays
        The memory of each spring as a function of its input u and rate r at the stage:
        ``E_inf u + [0] + [1] r + [2] (u - [3])``, in Pa m.

    Returns
    -------
    converged, rate of lambda (m/s), lambda (m), pressure p (Pa), shear q (Pa), slip speed (m/s, negative once past
    zero), rate of the radial input (m/s), delta (m), friction less spring force (Pa)
    """
    rate = guess
    modulus = rubber.long_term_modulus
    gain = (implicit * (modulus + radial[2]) + radial[1]) / height
    low, high = -np.inf, np.inf
    for step in range(NEWTON_STEPS):
        deflection = deflection_base + implicit * rate
        delta, _c, stick_rate, slope, drift = sliding(motion, at, deflection)
        u, du = height - delta, -(slope * rate + drift)
        p = (modulus * u + radial[0] + radial[1] * du + radial[2] * (u - radial[3])) / height
        q = (
            modulus * deflection
            + longitudinal[0]
            + longitudinal[1] * rate
            + longitudinal[2] * (deflection - longitudinal[3])
        )
        q *= rubber.shear_ratio / height
        w = direction * (stick_rate - rate)
        mu = kinetic(law, p, w)
        push = direction * mu * max(p, 0.0) - q
        residual = rubber.mass * rate - momentum_base - implicit * push
        dw = 1e-9 + 1e-6 * max(w, 0.0)
        mu_slope = (kinetic(law, p, w + dw) - mu) / dw if w > 0.0 else 0.0
        stiffness = gain * (rubber.shear_ratio + direction * mu * slope) + mu_slope * max(p, 0.0)
        tangent = rubber.mass + implicit * stiffness
        # the law's floors are kinks on which plain Newton steps can go round in circles: keep the root between bounds
        if residual < 0.0:
            low = rate
        else:
            high = rate
        change = -residual / tangent if tangent > 0.0 else np.nan
        if abs(change) <= 1e-8 + 1e-7 * abs(w):
            return True, rate, deflection, p, q, w, du, delta, push
        bounded = high - low < np.inf
        if not low < rate + change < high or (bounded and step > 5):
            if not bounded:
                return False, rate, deflection, p, q, w, du, delta, push
            change = 0.5 * (low + high) - rate
            if abs(change) <= 1e-9:
                return True, rate, deflection, p, q, w, du, delta, push
        rate += change
    return False, rate, deflection, p, q, w, du, delta, push
