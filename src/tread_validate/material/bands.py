"""Where the true moduli lie, and where a measured point may: 95 % bands about the rich curve."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .collocation import Collocation, collocate
from .fit import PronyFit
from .rich import RichCurve, Scatter
from .sign_control import non_negative

Array = NDArray[np.float64]

NORMAL_95 = 1.96
SELECTION = 1.05  # the spread that choosing the terms that are not zero adds: measured, see docs/material.md
LEAST_DEVIATION = 1e-4  # relative: no series and no file of five digits is better
WIDEST = 1.0  # relative half-width beyond which the data say nothing of a modulus
POINTS_PER_DECADE, FEWEST_POINTS, MOST_POINTS = 8, 60, 240


@dataclass(frozen=True)
class Band:
    """A curve with its 95 % band, (g,) each, Pa."""

    centre: Array
    lower: Array
    upper: Array


@dataclass(frozen=True)
class Bands:
    """95 % bands, pointwise, of moduli and terms.

    Attributes
    ----------
    angular_frequency : (g,) array, rad/s
    storage_modulus, loss_modulus : Band
        Where the true modulus lies, about the rich curve and not about the fit: a fit outside is one that misses.
    points_inside : (float, float)
        Share of the raw points (outliers counted) inside the bands for points, E' and E''.
    fit_inside : (float, float)
        Share of the frequencies at which the fit is inside the bands of the true moduli.
    long_term_modulus : (2,) array, Pa
    moduli : (n, 2) array, Pa
        2.5 and 97.5 percentiles of each term; neighbouring terms trade against each other, so these are wide.
    replicates : int
        Of the data, behind the bands of the terms.
    """

    angular_frequency: Array
    storage_modulus: Band
    loss_modulus: Band
    points_inside: tuple[float, float]
    fit_inside: tuple[float, float]
    long_term_modulus: Array
    moduli: Array
    replicates: int


def grid(w: Array) -> Array:
    """Return the frequencies at which bands are worked out, rad/s."""
    decades = float(np.log10(w.max() / w.min()))
    points = int(np.clip(round(POINTS_PER_DECADE * decades), FEWEST_POINTS, MOST_POINTS))
    return np.geomspace(float(w.min()), float(w.max()), points)


def bands(
    fit: PronyFit,
    raw: tuple[Array, Array, Array],
    everywhere: Array,
    rich: RichCurve,
    scatters: tuple[Scatter, Scatter],
    shift_deviation: Array | None = None,
    loss_weight: float = 1.0,
    replicates: int = 400,
    seed: int = 1,
) -> Bands:
    """Return the bands of a fit over its own frequencies.

    `raw` are frequency (rad/s), E' and E'' (Pa) of every point in the band, outliers too; `everywhere` the frequencies
    that `rich` was fitted at (its leverages are those of the fit's own points); `shift_deviation`, (2, g) on
    `grid`, is the relative standard deviation that fitted shift constants add. The band of a true modulus is 1.96 times
    the spread of the rich series' coefficients that are not zero, widened by 1.05 for their choice, and by the misfit
    that no noise explains; that of a point is the 95th percentile of the points' own distances,
    each divided by the root of one less its leverage.

    Raises `InputError` where a band is wider than the modulus itself.
    """
    w = grid(fit.angular_frequency)
    centre = rich.moduli(w)
    spread = SELECTION * _spread(everywhere, rich, scatters, w)
    variance = spread**2 + np.array([[s.misfit**2] for s in scatters]) + LEAST_DEVIATION**2
    if shift_deviation is not None:
        variance = variance + shift_deviation**2
    half = NORMAL_95 * np.sqrt(variance)
    for name, one in (("storage", half[0]), ("loss", half[1])):
        if not float(one.max()) <= WIDEST:
            at = int(np.argmax(~(one <= WIDEST)))
            raise InputError(
                f"bands: {name} modulus at {w[at]:.3g} rad/s",
                f"a 95 % band of +-{100 * one[at]:.3g} %",
                f"data that fix it to {100 * WIDEST:g} % (a narrower --band, more data, or --resamples 0 for no bands)",
            )
    inside = _points_inside(raw, rich, fit)
    low, high = centre * np.exp(-half), centre * np.exp(half)
    fitted = np.array([fit.series.storage_modulus(w), fit.series.loss_modulus(w)])
    held = np.mean((fitted >= low) & (fitted <= high), axis=1)
    terms = _terms(fit, scatters, loss_weight, replicates, seed)
    return Bands(
        angular_frequency=w,
        storage_modulus=Band(centre[0], low[0], high[0]),
        loss_modulus=Band(centre[1], low[1], high[1]),
        points_inside=inside,
        fit_inside=(float(held[0]), float(held[1])),
        long_term_modulus=terms[:, 0],
        moduli=terms[:, 1:].T,
        replicates=replicates,
    )


def _spread(data: Array, rich: RichCurve, scatters: tuple[Scatter, Scatter], w: Array) -> Array:
    """Return relative standard deviations of E' and E'' at w, (2, g), from the noise of the data at `data`."""
    fitted, wanted, active = rich.moduli(data), rich.moduli(w), rich.coefficients > 0
    matrix = collocate(data, fitted[0], fitted[1], rich.times).matrix[:, active]
    scale = 1.0 / np.linalg.norm(matrix, axis=0)
    turned, size, back = np.linalg.svd(matrix * scale, full_matrices=False)
    kept = size > 1e-9 * size[0]
    there = collocate(w, wanted[0], wanted[1], rich.times).matrix[:, active] * scale @ (back[kept].T / size[kept])
    noise = np.repeat([scatters[0].noise ** 2, scatters[1].noise ** 2], data.size)
    turned = turned[:, kept]
    covariance = (turned * noise[:, None]).T @ turned
    variance = np.einsum("ij,jk,ik->i", there, covariance, there)
    return np.asarray(np.sqrt(variance).reshape(2, -1), dtype=np.float64)


def _points_inside(raw: tuple[Array, Array, Array], rich: RichCurve, fit: PronyFit) -> tuple[float, float]:
    """Return the share of all raw points inside the bands for points, E' and E''."""
    w, *measured = raw
    curve, used = rich.moduli(w), rich.moduli(fit.angular_frequency)
    inside = []
    for k, data in enumerate((fit.storage_modulus, fit.loss_modulus)):
        alone = np.abs(np.log(data / used[k])) / np.sqrt(np.maximum(1.0 - rich.leverage[k], 0.1))
        reach = float(np.quantile(alone, 0.95, method="higher"))
        inside.append(float(np.mean(np.abs(np.log(measured[k] / curve[k])) <= reach)))
    return inside[0], inside[1]


def _terms(fit: PronyFit, scatters: tuple[Scatter, Scatter], loss_weight: float, replicates: int, seed: int) -> Array:
    """Return 2.5 and 97.5 percentiles, (2, n + 1), of E_inf and moduli fitted to data with other noise, Pa."""
    times = fit.series.relaxation_times
    system = collocate(fit.angular_frequency, fit.storage_modulus, fit.loss_modulus, times, loss_weight)
    if not replicates:
        return np.full((2, times.size + 1), np.nan)
    turned, square = np.linalg.qr(system.matrix)
    random = np.random.default_rng(seed)
    m = fit.angular_frequency.size
    deviation = np.repeat([scatters[0].noise, loss_weight * scatters[1].noise], m)
    found = np.empty((replicates, times.size + 1))
    for r in range(replicates):
        target = system.target + deviation * random.standard_normal(2 * m)
        found[r] = non_negative(Collocation(square, turned.T @ target))
    return np.asarray(np.percentile(found, [2.5, 97.5], axis=0), dtype=np.float64)
