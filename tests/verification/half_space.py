"""A rigid cylinder on a viscoelastic half-space in plane strain: Hertz, and Ting for what relaxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import cumulative_trapezoid
from scipy.optimize import brentq

Floats = NDArray[np.float64]

RADIUS = 0.1  # m
DATUM = 0.02  # m: depths are measured against a point this far away on the surface
MODULUS, RELAXED, SLOW = 10e6, 4e6, 0.02  # E/(1 - nu^2) at once and after long, Pa; relaxation time, s


@dataclass(frozen=True)
class Cylinder:
    """Hertz' contact of a rigid cylinder and a half-space of E/(1 - nu^2) = 1, SI, per width."""

    radius: float = RADIUS
    datum: float = DATUM

    def load(self, half_width: Floats | float) -> Floats | float:
        """pi a^2/(4 R)."""
        return np.pi * np.asarray(half_width) ** 2 / (4.0 * self.radius)

    def depth(self, half_width: float) -> float:
        """a^2/(2 R) (ln(2 D/a) + 1/2): the middle's displacement against a point of the surface at the distance D."""
        return float(half_width**2 / (2.0 * self.radius) * (np.log(2.0 * self.datum / half_width) + 0.5))

    def half_width(self, depth: float) -> float:
        """Inverse of `depth`."""
        if depth <= 0.0:
            return 0.0
        return float(brentq(lambda a: self.depth(a) - depth, 1e-12, 0.5 * self.datum))


def relaxation(time: Floats, slow: float = SLOW) -> Floats:
    """E(t)/(1 - nu^2), Pa."""
    return RELAXED + (MODULUS - RELAXED) * np.exp(-time / slow)


def ting(time: Floats, depth: Floats, load: Floats | None = None, slow: float = SLOW) -> tuple[Floats, float]:
    """Return the force at each time and when contact ends, for a depth that rises to one peak and falls again.

    `load` is the elastic force at evenly spaced depths from 0 to the largest for a modulus of 1; by default that of the
    cylinder on a half-space. `slow` is the relaxation time, s.
    """
    fine = np.linspace(time[0], time[-1], 8001)
    deep = _smooth(time, depth, fine)
    elastic = (
        np.array([Cylinder().load(Cylinder().half_width(d)) for d in np.linspace(0.0, deep.max(), 401)])
        if load is None
        else np.asarray(load)
    )
    grid = np.linspace(0.0, deep.max(), elastic.size)
    top = int(np.argmax(deep))
    rate, push = np.gradient(deep, fine), np.gradient(np.interp(deep, grid, elastic), fine)
    force, lost = np.zeros(time.size), float(time[-1])
    ended = False
    for row, now in enumerate(time):
        last = int(np.searchsorted(fine, now))
        if last < 2 or ended:
            continue
        kernel = relaxation(now - fine[: last + 1], slow)
        until = last
        if last > top:
            # the contact is as wide as it was at t1: from there to now the depth's history cancels
            whole = cumulative_trapezoid(kernel * rate[: last + 1], fine[: last + 1], initial=0.0)
            rest = whole[-1] - whole
            below = np.flatnonzero(rest[: top + 1] >= 0.0)
            if below.size == 0:
                lost, ended = float(now), True
                continue
            until = int(below[-1])
        force[row] = np.trapezoid(kernel[: until + 1] * push[: until + 1], fine[: until + 1])
    return force, lost


def _smooth(time: Floats, depth: Floats, fine: Floats) -> Floats:
    from scipy.interpolate import CubicSpline

    return np.maximum(CubicSpline(time, depth)(fine), 0.0)
