"""Speed and temperature fitted together, where the speeds of a set differ between its temperatures.

One line over the temperatures with the speeds grouped, as the paper fits it, takes the effect of the speeds for one of
temperature there.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.special import stdtrit

from ...errors import InputError
from .fit import Fit, Peak

SAME_SPEED = 0.005  # relative: measured speeds closer than this are repeats of one setting
NOTE = "speed and temperature fitted together: the speeds differ between the temperatures"


def levels(values: Sequence[float]) -> dict[float, int]:
    """Return the level of each value; values within 0.5 % of a level's smallest belong to it."""
    found: dict[float, int] = {}
    first, level = -math.inf, -1
    for value in sorted(set(values)):
        if value > first + SAME_SPEED * abs(first) or level < 0:
            first, level = value, level + 1
        found[value] = level
    return found


def balanced(members: Sequence[Peak]) -> bool:
    """Whether every temperature has the same speeds, as often."""
    level = levels([peak.speed for peak in members])
    of_temperature: dict[float, list[int]] = {}
    for peak in members:
        of_temperature.setdefault(peak.temperature, []).append(level[peak.speed])
    return len({tuple(sorted(speeds)) for speeds in of_temperature.values()}) == 1


def fit_together(members: Sequence[Peak], zero: float, level: float) -> Fit:
    """Fit F = F0 (1 + a_v v)(1 + a_theta (T - zero)) and return a_theta with its interval (Student, linearised).

    For a balanced set without noise this is the paper's slope over intercept. Raises `InputError` where the speeds
    change with the temperature alone.
    """
    theta = np.array([peak.temperature - zero for peak in members])
    speed = np.array([peak.speed for peak in members])
    force = np.array([peak.force for peak in members], dtype=np.float64)
    design = np.column_stack([np.ones_like(theta), theta, speed])
    if np.linalg.matrix_rank(design / np.maximum(np.linalg.norm(design, axis=0), 1e-300), tol=1e-6) < 3:
        raise InputError("regression", "speeds that change with the temperature alone", "two speeds at one temperature")
    start = np.linalg.lstsq(design, force, rcond=None)[0]
    base = start[0] if start[0] != 0 else float(force.mean())

    def law(q: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(q[0] * (1.0 + q[1] * theta) * (1.0 + q[2] * speed), dtype=np.float64)

    scale = np.array([abs(base), 1.0 / max(np.ptp(theta), 1.0), 1.0 / max(np.ptp(speed), 1e-3)])

    def misfit(q: NDArray[np.float64]) -> NDArray[np.float64]:
        return law(q) - force

    found = least_squares(misfit, [base, start[1] / base, start[2] / base], x_scale=scale, xtol=1e-14, ftol=1e-14)
    freedom = force.size - 3
    fitted = law(found.x)
    if freedom < 1:
        return Fit(float(found.x[1]), -math.inf, math.inf, fitted)
    jacobian = found.jac * scale
    inverse = np.linalg.inv(jacobian.T @ jacobian)
    variance = float(np.sum((fitted - force) ** 2)) / freedom * inverse[1, 1] * scale[1] ** 2
    half = float(stdtrit(freedom, 0.5 + 0.5 * level)) * math.sqrt(variance)
    return Fit(float(found.x[1]), float(found.x[1]) - half, float(found.x[1]) + half, fitted)
