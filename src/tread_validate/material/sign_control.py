"""Prony coefficients >= 0 by sign control, and by non-negative least squares as its check.

Sign control: R.D. Bradshaw, L.C. Brinson, Mech. Time-Dep. Mater. 1 (1997) 85-108, doi:10.1023/A:1009772018066.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .collocation import Collocation

Array = NDArray[np.float64]

MOST_ITERATIONS = 3000
TALL = 3  # rows a column from which a system is first reduced to a square one
ZERO = 1e-9  # of the largest scaled coefficient


def sign_control(system: Collocation, high_modulus: float, low_modulus: float) -> Array:
    """Return the coefficients [E_inf, E_1 .. E_n] >= 0 in Pa.

    The unconstrained least-squares solution is taken where it has no negative coefficient. Otherwise
    Levenberg-Marquardt with the relaxation times fixed, in which every trial coefficient is replaced by its absolute
    value, from the constant 4 XL and (0.8 XI - 4 XL)/(N - 1) for each modulus; XI = `high_modulus` and
    XL = `low_modulus` are |E*| in Pa at the highest and lowest frequency of the data.

    Two additions to the published method, without which it stalls with coefficients bouncing about zero: a trial in
    which negative coefficients are set to zero is taken where it fits better than the mirrored one, and a coefficient
    at zero whose gradient points below zero is held for that step. Columns are scaled to unit length, which moves
    neither the minimum nor a sign.
    """
    scale = 1.0 / np.linalg.norm(system.matrix, axis=0)
    matrix = system.matrix * scale
    free = np.linalg.lstsq(matrix, system.target, rcond=None)[0]
    if np.all(free >= 0):
        return np.asarray(free * scale, dtype=np.float64)

    def objective(c: Array) -> float:
        residual = matrix @ c - system.target
        return float(residual @ residual)

    hessian, right_side = matrix.T @ matrix, matrix.T @ system.target
    terms = matrix.shape[1] - 1
    c = np.full(terms + 1, abs(0.8 * high_modulus - 4.0 * low_modulus) / max(terms - 1, 1)) / scale
    c[0] = 4.0 * low_modulus / scale[0]
    value, damping, stalled = objective(c), 1e-3, 0
    for _ in range(MOST_ITERATIONS):
        gradient = hessian @ c - right_side
        moves = ~((c <= ZERO * c.max()) & (gradient >= 0))
        if not moves.any():
            break
        step = np.zeros_like(c)
        damped = hessian[np.ix_(moves, moves)] + damping * np.eye(int(moves.sum()))
        step[moves] = np.linalg.solve(damped, -gradient[moves])
        mirrored, clipped = np.abs(c + step), np.maximum(c + step, 0.0)
        trial = min(mirrored, clipped, key=objective)
        trial[trial <= ZERO * trial.max()] = 0.0
        found = objective(trial)
        if found < value:
            stalled = stalled + 1 if value - found < 1e-10 * value else 0
            c, value, damping = trial, found, max(damping / 3.0, 1e-13)
            if stalled > 5:
                break
        else:
            damping *= 4.0
            if damping > 1e8:
                break
    return np.asarray(c * scale, dtype=np.float64)


def non_negative(system: Collocation) -> Array:
    """Return the coefficients [E_inf, E_1 .. E_n] >= 0 in Pa by the active-set method of Lawson and Hanson."""
    scale = 1.0 / np.linalg.norm(system.matrix, axis=0)
    matrix, target = system.matrix * scale, system.target
    if matrix.shape[0] > TALL * matrix.shape[1]:
        turned, matrix = np.linalg.qr(matrix)
        target = turned.T @ target
    from scipy.optimize import nnls

    solution, _ = nnls(matrix, target, maxiter=50 * matrix.shape[1])
    return np.asarray(solution * scale, dtype=np.float64)
