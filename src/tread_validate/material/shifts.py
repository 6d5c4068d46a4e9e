"""Time-temperature shifts of sweeps: free ones from overlap, tables from files; their quality."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..columns import read_columns
from ..errors import InputError
from ..model_file import as_model
from ..study import ShiftTable, Wlf
from .sweep import Sweep

Array = NDArray[np.float64]

FEWEST_SHARED = 3  # points of each of two sweeps in their common band
STEP = 0.02  # decades, of the search for a free shift


@dataclass(frozen=True)
class Overlap:
    """How well sweeps of neighbouring temperatures lie on each other.

    Attributes
    ----------
    misfit : float
        Root mean square relative difference of E' and E'' where neighbours share a band; NaN where none do.
    worst : float
        Of the worst pair.
    apart : int
        Pairs that share no band: nothing holds their shift.
    """

    misfit: float
    worst: float
    apart: int


def overlap(sweeps: tuple[Sweep, ...], log_factors: Array) -> Overlap:
    """Return the quality of shifts, log10 a_T of each sweep."""
    order = np.argsort([sweep.temperature for sweep in sweeps], kind="stable")
    found, apart = [], 0
    for a, b in pairwise(order):
        one = _difference(sweeps[a], sweeps[b], float(log_factors[b] - log_factors[a]))
        if one is None:
            apart += 1
        else:
            found.append(one)
    if not found:
        return Overlap(float("nan"), float("nan"), apart)
    return Overlap(float(np.sqrt(np.mean(found))), float(np.sqrt(max(found))), apart)


def _difference(cold: Sweep, warm: Sweep, shift: float) -> float | None:
    """Return the mean squared difference of log moduli over the common band; None where there is none."""
    x, y = np.log10(cold.angular_frequency), np.log10(warm.angular_frequency) + shift
    inside = (y >= x[0]) & (y <= x[-1])
    back = (x >= y[0]) & (x <= y[-1])
    if min(int(inside.sum()), int(back.sum())) < FEWEST_SHARED:
        return None
    total, count = 0.0, 0
    for one, other in ((cold.storage_modulus, warm.storage_modulus), (cold.loss_modulus, warm.loss_modulus)):
        away = np.log(other[inside]) - np.interp(y[inside], x, np.log(one))
        again = np.log(one[back]) - np.interp(x[back], y, np.log(other))
        total += float(away @ away + again @ again)
        count += away.size + again.size
    return total / count


def free_shifts(sweeps: tuple[Sweep, ...], reference: float) -> Array:
    """Return log10 a_T of each sweep, neighbour laid on neighbour; 0 at `reference` (degC) by interpolation.

    Raises `InputError` where two neighbours cannot be laid on each other.
    """
    order = np.argsort([sweep.temperature for sweep in sweeps], kind="stable")
    total = np.zeros(len(sweeps))
    for a, b in pairwise(order):
        cold, warm = sweeps[a], sweeps[b]
        reach = float(np.log10(cold.angular_frequency[-1] / warm.angular_frequency[0]))
        trials = np.arange(-reach, reach, STEP)
        values = [_difference(cold, warm, -float(shift)) for shift in trials]
        known = [(value, k) for k, value in enumerate(values) if value is not None]
        if not known:
            where = f"sweeps at {cold.temperature:.4g} and {warm.temperature:.4g} degC"
            raise InputError(where, "no common band at any shift", f"{FEWEST_SHARED} points in common")
        k = min(known)[1]
        total[b] = total[a] - float(trials[k])
    temperatures = np.array([sweep.temperature for sweep in sweeps])[order]
    if not temperatures[0] <= reference <= temperatures[-1]:
        found = f"sweeps from {temperatures[0]:.4g} to {temperatures[-1]:.4g} degC"
        raise InputError("--reference-degC", found, f"{reference:g} degC among them for free shifts")
    return np.asarray(total - np.interp(reference, temperatures, total[order]), dtype=np.float64)


def read_shift_table(path: Path | str) -> ShiftTable:
    """Read a table temperature_degC, log10_shift_factor; it may refer to any temperature and stand in any order."""
    table = read_columns(path, ("temperature_degC", "log10_shift_factor"))
    order = np.argsort(table["temperature_degC"], kind="stable")
    points = [(float(table["temperature_degC"][k]), float(table["log10_shift_factor"][k])) for k in order]
    law: ShiftTable = as_model({"kind": "table", "points": points}, ShiftTable, path)
    return law


def table_of(temperatures: Array, log_factors: Array) -> ShiftTable:
    """Return the shifts of sweeps as a table; sweeps of one temperature share their mean."""
    known = np.unique(temperatures)
    means = [float(f"{np.mean(log_factors[temperatures == one]):.7g}") for one in known]
    return ShiftTable(kind="table", points=tuple(zip(known.tolist(), means, strict=True)))


def nearest_wlf(temperatures: Array, log_factors: Array, reference: float) -> tuple[Wlf, float]:
    """Return the WLF law at `reference` (degC) that comes closest to shifts, and its largest distance in decades."""
    from scipy.optimize import least_squares

    above = temperatures - reference
    lowest = max(-float(above.min()), 0.0)

    def misfit(q: Array) -> Array:
        return np.asarray(-q[0] * above / (lowest + np.exp(q[1]) + above) - log_factors, dtype=np.float64)

    found = least_squares(misfit, [8.0, np.log(60.0)], bounds=([1e-3, -3.0], [1e3, 9.0]))
    wlf = Wlf(c1=float(found.x[0]), c2_K=float(lowest + np.exp(found.x[1])), reference_temperature_degC=reference)
    return wlf, float(np.max(np.abs(misfit(found.x))))
