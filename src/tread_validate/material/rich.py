"""The curve behind the data: a series rich enough to follow any linear material, with the scatter about it.

It takes the place of smoothing. A sum of exponentials >= 0 at closely spaced times can follow every modulus of a
linear, passive solid and nothing else, whatever the width of the data in decades; how far it bends is left to the data.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .collocation import Collocation, collocate
from .sign_control import non_negative

Array = NDArray[np.float64]

REACH = 30.0  # relaxation times reach this factor beyond the data on both sides
PER_DECADE = 6
REFINEMENTS = 3
FEW = 4  # times a coefficient that is not zero: a spectrum of lines
SIGNIFICANT = 3.0  # standard deviations by which the total scatter must exceed that between neighbours


@dataclass(frozen=True)
class RichCurve:
    """The curve and what lies about it.

    Attributes
    ----------
    times : (k,) array, s
    coefficients : (k + 1,) array, Pa
        E_inf and a modulus for each time, >= 0.
    leverage : (2, m) array, 0..1
        How far each datum (E', E'') draws the curve towards itself.
    """

    times: Array
    coefficients: Array
    leverage: Array

    @property
    def freedom(self) -> int:
        """Number of coefficients that are not zero."""
        return int(np.sum(self.coefficients > 0))

    def moduli(self, angular_frequency: Array) -> Array:
        """Return E' and E'' in Pa at w in rad/s, (2, g)."""
        return moduli(angular_frequency, self.times, self.coefficients)


@dataclass(frozen=True)
class Scatter:
    """How the points of one modulus lie about the rich curve, as relative standard deviations.

    Attributes
    ----------
    noise : float
        From point to point; all of the scatter where no misfit is significant.
    misfit : float
        What no noise explains: the part of the scatter that neighbours share; 0 where it is not significant.
    """

    noise: float
    misfit: float


def rich_times(w: Array) -> Array:
    """Return six relaxation times a decade, in s, to 30-fold beyond the data at w in rad/s."""
    low, high = 1.0 / (REACH * float(w.max())), REACH / float(w.min())
    return np.geomspace(low, high, max(round(PER_DECADE * np.log10(high / low)), 4))


def moduli(w: Array, times: Array, coefficients: Array) -> Array:
    """Return E' and E'' in Pa at w, (2, g), of coefficients [E_inf, E_1 .. E_n]."""
    x = w[:, None] * times
    storage = coefficients[0] + (x * x / (1.0 + x * x)) @ coefficients[1:]
    return np.array([storage, (x / (1.0 + x * x)) @ coefficients[1:]])


def rich_curve(w: Array, storage: Array, loss: Array) -> RichCurve:
    """Fit the rich series to moduli in Pa at w in rad/s, (m,) each.

    Rows are first divided by the data and then by the fitted moduli, which takes away the bias of a few variances
    that the first has. A spectrum of few lines gets closer times about them, three rounds of them: a line between two
    of six times a decade would be missed by 4 %.
    """
    times = rich_times(w)
    coefficients = non_negative(collocate(w, storage, loss, times))
    for _ in range(REFINEMENTS):
        if int(np.sum(coefficients[1:] > 0)) * FEW > times.size:
            break
        times = closer(times, coefficients[1:] > 0)
        coefficients = non_negative(collocate(w, storage, loss, times))
    fitted = moduli(w, times, coefficients)
    if not np.all(fitted > 0):
        fitted = np.array([storage, loss])
    system = collocate(w, fitted[0], fitted[1], times)
    target = np.concatenate([storage / fitted[0], loss / fitted[1]])
    coefficients = non_negative(Collocation(system.matrix, target))
    active = system.matrix[:, coefficients > 0]
    turned = np.linalg.qr(active / np.linalg.norm(active, axis=0))[0]
    return RichCurve(times, coefficients, np.sum(turned**2, axis=1).reshape(2, -1))


def closer(times: Array, active: NDArray[np.bool_]) -> Array:
    """Return the active times with the old spacing about each divided by three."""
    logs = np.log(times)
    found = [logs]
    for step in (-2, -1, 1, 2):
        toward = np.gradient(logs)[active] * step / 3.0
        found.append(logs[active] + toward)
    kept = np.unique(np.round(np.concatenate(found), 9))
    near = np.abs(kept[:, None] - logs[active][None, :]).min(axis=1) <= 1.01 * float(np.median(np.diff(logs)))
    ends = np.isin(kept, np.round(logs[[0, -1]], 9))
    return np.asarray(np.exp(kept[near | ends]), dtype=np.float64)


def scatter(w: Array, residual: Array, freedom: float) -> Scatter:
    """Return noise and misfit of relative residuals, (m,), at w; `freedom` parameters were spent on them.

    The noise is the scatter of each point about the mean of its two neighbours in frequency, 2/3 of that variance (von
    Neumann, Ann. Math. Stat. 12 (1941) 367-395, doi:10.1214/aoms/1177731677, in its second-difference form).
    """
    m = residual.size
    ordered = residual[np.argsort(w, kind="stable")]
    total = float(ordered @ ordered) / max(m - freedom, 1.0)
    bend = ordered[1:-1] - 0.5 * (ordered[:-2] + ordered[2:])
    noise = float(bend @ bend) / (1.5 * max(m - 2 - freedom * (m - 2) / m, 1.0)) if m > 2 else total
    if total - noise <= SIGNIFICANT * noise * np.sqrt(2.0 / m):
        return Scatter(float(np.sqrt(total)), 0.0)
    return Scatter(float(np.sqrt(noise)), float(np.sqrt(total - noise)))
