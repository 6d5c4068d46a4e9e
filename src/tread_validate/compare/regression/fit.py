"""A peak, a fitted line through peaks, and the confidence interval of a ratio."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit


@dataclass(frozen=True)
class Peak:
    """Peak normal force of one run with what it is regressed on.

    Attributes
    ----------
    shape : str
    temperature : float, degC
    interference : float, mm
    speed : float, m/s
    force : float or None, N
        None where the run is missing.
    """

    case_id: str
    shape: str
    temperature: float
    interference: float
    speed: float
    force: float | None


@dataclass(frozen=True)
class Fit:
    """F = F0 (1 + a x) through one set of runs.

    Attributes
    ----------
    coefficient : float
        a = slope/intercept of the ordinary least-squares line.
    low, high : float
        Ends of its confidence interval by Fieller's theorem; infinite where the intercept is not distinguishable
        from zero or no degree of freedom is left.
    fitted : (n,) array, N
    """

    coefficient: float
    low: float
    high: float
    fitted: NDArray[np.float64]


def fieller(
    a: float, b: float, var_a: float, var_b: float, cov_ab: float, freedom: int, level: float
) -> tuple[float, float]:
    """Return the confidence interval of a/b, or (-inf, inf) where b is not distinguishable from zero."""
    t2 = float(stdtrit(freedom, 0.5 + 0.5 * level)) ** 2
    qa = b * b - t2 * var_b
    qb = a * b - t2 * cov_ab
    qc = a * a - t2 * var_a
    if qa <= 0.0:
        return -math.inf, math.inf
    root = math.sqrt(max(0.0, qb * qb - qa * qc))
    return (qb - root) / qa, (qb + root) / qa
