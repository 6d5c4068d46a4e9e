"""Peak normal force on the rig as a linear functional of the relaxation spectrum, for any linear compound.

A column's indentation depends on its place alone, so a term exp(-t/tau) of the modulus acts through the one number
tau v: force over place x is N(x) = sum_i E_i n(x; tau_i v a_T). Time-temperature superposition makes temperature a
factor on speed. Both hold for the block in three dimensions as for independent springs; the shape of n hardly differs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..geometry import Path, path_of
from ..material import relative_shift
from ..study import Case, TimeShift

Array = NDArray[np.float64]

PLACES = 600
TEMPERATURES = (22.0, 45.0)


@dataclass(frozen=True)
class Coefficients:
    """Rate and temperature coefficients of all sets and their gradients with respect to the moduli.

    Attributes
    ----------
    a_v : (sets,) array, s/m
    a_theta : (interferences,) array, 1/degC
    a_v_gradient, a_theta_gradient : (sets, terms + 1), (interferences, terms + 1) arrays
    """

    a_v: Array
    a_theta: Array
    a_v_gradient: Array
    a_theta_gradient: Array

    @property
    def pair(self) -> tuple[float, float]:
        """The means over the sets, as Table 1 prints them."""
        return float(self.a_v.mean()), float(self.a_theta.mean())

    @property
    def spread(self) -> float:
        """Sample standard deviation of a_v over the sets, s/m."""
        return float(self.a_v.std(ddof=1))


@dataclass(frozen=True)
class RigTable:
    """The runs behind one row of Table 1: temperatures x interferences x speeds, all of one block shape.

    Attributes
    ----------
    speeds : (n,) array, m/s
    basis : (temperatures, interferences, n, places, terms + 1) array
        Force over place (m2 m/m, per Pa) of unit modulus: the last column is the elastic term.
    """

    speeds: Array
    temperatures: tuple[float, ...]
    basis: Array

    def peaks(self, moduli: Array) -> Array:
        """Return peak forces (temperatures, interferences, speeds) in N for moduli in Pa."""
        return np.asarray((self.basis @ moduli).max(axis=-1))

    def coefficients(self, moduli: Array) -> Coefficients:
        """Return a_v and a_theta of every set, as in Table 1, for moduli (terms + 1,), the elastic one last.

        a_v is slope over intercept of the least-squares line over the speeds of each (temperature, interference);
        a_theta compares speed-averaged forces at the two temperatures. Gradients are with respect to the moduli: the
        peak's place moves, but the force is flat there (envelope theorem).
        """
        over_place = self.basis @ moduli
        at = over_place.argmax(axis=-1)
        force = np.take_along_axis(over_place, at[..., None], axis=-1)[..., 0]
        slopes = np.take_along_axis(self.basis, at[..., None, None], axis=-2)[..., 0, :]
        centred = self.speeds - self.speeds.mean()
        line = centred / (centred @ centred)
        base = 1.0 / self.speeds.size - self.speeds.mean() * line
        rise, rest = force @ line, force @ base
        rise_g, rest_g = np.einsum("abvm,v->abm", slopes, line), np.einsum("abvm,v->abm", slopes, base)
        a_v = rise / rest
        a_v_gradient = (rise_g - a_v[..., None] * rest_g) / rest[..., None]
        mean, mean_g = force.mean(axis=2), slopes.mean(axis=2)
        span = self.temperatures[-1] - self.temperatures[0]
        ratio = mean[-1] / mean[0]
        ratio_g = (mean_g[-1] - ratio[:, None] * mean_g[0]) / mean[0][:, None]
        terms = moduli.size
        return Coefficients(a_v.ravel(), (ratio - 1.0) / span, a_v_gradient.reshape(-1, terms), ratio_g / span)


def rig_table(cases: Sequence[Case], times: Array, law: TimeShift, reference: float) -> RigTable:
    """Return the table of rig `cases` (one shape) for terms of relaxation `times` (s) at `reference` (degC).

    Cases at 0.3 mm are left out, as the paper does.
    """
    cases = [case for case in cases if case.interference < 0.25e-3]
    speeds = sorted({case.speed for case in cases})
    interferences = sorted({case.interference for case in cases})
    temperatures = sorted({case.temperature for case in cases})
    by_key = {(case.temperature, case.interference, case.speed): case for case in cases}
    basis = np.empty((len(temperatures), len(interferences), len(speeds), PLACES, times.size + 1))
    for j, depth in enumerate(interferences):
        path = path_of(by_key[temperatures[0], depth, speeds[0]])
        for i, temperature in enumerate(temperatures):
            shift = float(relative_shift(temperature, reference, law))
            for k, speed in enumerate(speeds):
                basis[i, j, k] = _responses(path, times * shift * speed)
    return RigTable(np.array(speeds), tuple(temperatures), basis)


def _responses(path: Path, lengths: Array) -> Array:
    """Return the block's force over place for unit moduli and relaxation lengths tau v (m), (places, terms + 1)."""
    from scipy.signal import lfilter  # late: it takes half a second to load, and a report runs no level

    total = path.contact_duration * path.speed
    x = np.linspace(0.0, total, PLACES)
    step = x[1] - x[0]
    column = np.maximum(path.indentation(0.0, x / path.speed), 0.0) / path.columns.height
    # the whole block is the column's record against the width profile
    width = path.profile.cell_areas(np.append(x, x[-1] + step) - 0.5 * step)
    rate = np.diff(column, prepend=0.0)
    out = np.empty((PLACES, lengths.size + 1))
    contact = column > 0.0
    for i, length in enumerate(lengths):
        decay = np.exp(-step / length)
        weight = -length / step * np.expm1(-step / length)
        record = lfilter([weight], [1.0, -decay], rate)
        out[:, i] = np.convolve(np.where(contact, record, 0.0), width)[:PLACES]
    out[:, -1] = np.convolve(column, width)[:PLACES]
    return out
