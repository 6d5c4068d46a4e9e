"""How far a result on one mesh is from the mesh-converged one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from ...errors import InputError
from ...history import History
from ..quantities import SCALARS, scalars

LEAST_ORDER, LARGEST_ORDER = 0.5, 4.0


@dataclass(frozen=True)
class Convergence:
    """A quantity on three meshes, and what follows from it.

    Attributes
    ----------
    sizes : (3,) tuple, m or mm
        Element sizes, coarse to fine.
    values : (3,) tuple
        The quantity on them, in its unit.
    order : float or None
        Observed order of convergence; None where the values do not converge monotonically at an order between
        0.5 and 4, so that no extrapolation is made.
    limit : float
        Extrapolated value; the finest mesh's where `order` is None.
    errors : (3,) tuple, >= 0
        Relative distance of each mesh's value from the limit. Where `order` is None, each is at least the largest
        difference between any two meshes: a bound from the scatter, not an extrapolation.
    """

    sizes: tuple[float, float, float]
    values: tuple[float, float, float]
    order: float | None
    limit: float
    errors: tuple[float, float, float]


def richardson(sizes: Sequence[float], values: Sequence[float]) -> Convergence:
    """Extrapolate a quantity from three meshes to element size 0.

    Solves ``(f1 - f2) / (f2 - f3) = (h1^p - h2^p) / (h2^p - h3^p)`` for the order p (Richardson's extrapolation with
    unequal ratios; Celik et al., J. Fluids Eng. 130 (2008) 078001, doi:10.1115/1.2960953), coarse to fine.

    Raises `InputError` unless three sizes fall and three finite values are given.
    """
    if len(sizes) != 3 or len(values) != 3 or not sizes[0] > sizes[1] > sizes[2] > 0.0:
        raise InputError("mesh study: sizes", list(sizes), "three element sizes, coarse to fine")
    if not np.all(np.isfinite(values)):
        raise InputError("mesh study: values", list(values), "three finite values")
    coarse, medium, fine = (float(size) for size in sizes)
    f1, f2, f3 = (float(value) for value in values)
    order = _order((coarse, medium, fine), f1 - f2, f2 - f3)
    if order is None:
        limit = f3
        scatter = max(f1, f2, f3) - min(f1, f2, f3)
        distances = (scatter, scatter, scatter)
    else:
        limit = f3 - (f2 - f3) * fine**order / (medium**order - fine**order)
        distances = (abs(f1 - limit), abs(f2 - limit), abs(f3 - limit))
    scale = abs(limit) or 1.0
    one, two, three = (distance / scale for distance in distances)
    return Convergence((coarse, medium, fine), (f1, f2, f3), order, limit, (one, two, three))


def convergence(sizes: Sequence[float], histories: Sequence[History]) -> Mapping[str, Convergence]:
    """Extrapolate every scalar of a pass and return them by name; those that are yes or no are left out."""
    tables = [scalars(history).as_dict() for history in histories]
    return {
        quantity.name: richardson(sizes, [table[quantity.name] for table in tables])
        for quantity in SCALARS
        if not quantity.flag
    }


def history_errors(sizes: Sequence[float], histories: Sequence[History], used: float) -> dict[str, float]:
    """Return the error of the histories on the mesh in use, relative to their largest value, by quantity.

    The root mean square difference from the finest mesh, times ``h / (h - h_fine)``: Richardson's factor for an order
    of 1, which is cautious because scalars converge faster. Histories are interpolated to the finest one's clock.

    Raises `InputError` where `used` is not one of the sizes or is the finest.
    """
    fine = min(sizes)
    if used not in sizes or used == fine:
        raise InputError("mesh study: size in use", used, f"one of {list(sizes)} but the finest")
    mine, best = histories[list(sizes).index(used)], histories[list(sizes).index(fine)]
    errors = {}
    for name in ("normal_force", "tangential_force"):
        finest = getattr(best, name)
        difference = np.interp(best.time, mine.time, getattr(mine, name)) - finest
        span = best.time[-1] - best.time[0]
        rms = float(np.sqrt(np.trapezoid(difference**2, best.time) / span))
        errors[name] = rms / float(np.abs(finest).max()) * used / (used - fine)
    return errors


def _order(sizes: tuple[float, float, float], first: float, second: float) -> float | None:
    """Return the observed order of convergence, None outside its sensible range."""
    if first == 0.0 or second == 0.0 or first / second <= 0.0:
        return None
    h1, h2, h3 = sizes

    def mismatch(order: float) -> float:
        return float((h1**order - h2**order) / (h2**order - h3**order) - first / second)

    if mismatch(LEAST_ORDER) * mismatch(LARGEST_ORDER) > 0.0:
        return None
    return float(brentq(mismatch, LEAST_ORDER, LARGEST_ORDER, xtol=1e-12))


def mesh_study(sizes: Sequence[float], histories: Sequence[History], used: float) -> dict[str, dict[str, Any]]:
    """Return a mesh study as plain numbers, for a file: what each quantity is on each mesh and how far from its limit.

    Parameters
    ----------
    sizes : (3,) sequence, mm
        Coarse to fine.
    histories : (3,) sequence of History
    used : float, mm
        The size whose error is wanted.

    Returns
    -------
    dict
        ``mesh_error``: relative error at `used` by quantity; ``quantities``: values, limit and order of each scalar.
    """
    at = list(sizes).index(used)
    scalar = convergence(sizes, histories)
    whole = history_errors(sizes, histories, used)
    return {
        "mesh_error": {
            **{name: float(f"{item.errors[at]:.4g}") for name, item in scalar.items()},
            **{name: float(f"{value:.4g}") for name, value in whole.items()},
        },
        "quantities": {
            name: {
                "values": [float(f"{value:.7g}") for value in item.values],
                "limit": float(f"{item.limit:.7g}"),
                "order": None if item.order is None else round(item.order, 3),
            }
            for name, item in scalar.items()
        },
    }
