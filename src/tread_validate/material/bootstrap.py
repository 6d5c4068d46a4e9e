"""Uncertainty of moduli and terms by resampling the residuals of the sweeps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..study import Wlf
from .collocation import collocate
from .fit import PronyFit
from .master import MasterCurve, SmoothedSweep, WlfFit
from .sign_control import non_negative
from .wlf import relative_shift

Array = NDArray[np.float64]

RICH_REACH = 30.0  # the rich series' times reach this factor beyond the data on both sides
RICH_PER_DECADE = 4


@dataclass(frozen=True)
class Band:
    """A curve with its 95 % band, (g,) each, Pa."""

    centre: Array
    lower: Array
    upper: Array


@dataclass(frozen=True)
class Bands:
    """95 % bands of a fitted series.

    Attributes
    ----------
    angular_frequency : (g,) array, rad/s
    storage_modulus, loss_modulus : Band
        Simultaneous: in 95 of 100 repeats of the laboratory work the whole true curve lies inside.
    long_term_modulus : (2,) array, Pa
    moduli : (n, 2) array, Pa
        2.5 and 97.5 percentiles of each term; neighbouring terms trade against each other, so these are wide.
    replicates : int
    """

    angular_frequency: Array
    storage_modulus: Band
    loss_modulus: Band
    long_term_modulus: Array
    moduli: Array
    replicates: int


def bootstrap(
    sweeps: tuple[SmoothedSweep, ...],
    master: MasterCurve,
    fit: PronyFit,
    band: tuple[float, float],
    wlf: Wlf,
    wlf_fit: WlfFit | None = None,
    loss_weight: float = 1.0,
    replicates: int = 400,
    points: int = 60,
    seed: int = 1,
) -> Bands:
    """Resample, smooth, shift and fit again `replicates` times; return the bands over `band` in rad/s.

    Residuals of log moduli about the smoothed sweeps (outliers left out, scaled for the smoother's freedom) are drawn
    with replacement; fitted WLF constants are drawn from their covariance. Each replicate is fitted twice: with the
    terms of `fit`, for the bands of the terms, and with a rich series (four terms a decade to 30-fold beyond the
    data). The half-width of a modulus' band is the spread of the rich series times the factor that makes the band
    simultaneous, plus the distance of `fit` from the rich series: what the terms of `fit` cannot follow.
    """
    random = np.random.default_rng(seed)
    grid = np.geomspace(float(fit.angular_frequency.min()), float(fit.angular_frequency.max()), points)
    storage_residual, loss_residual = _residuals(sweeps, "storage"), _residuals(sweeps, "loss")
    samples = np.empty((replicates, 2, points))
    terms = np.empty((replicates, fit.series.moduli.size + 1))
    times = fit.series.relaxation_times
    rich_times = _rich_times(fit.angular_frequency)
    for r in range(replicates):
        factors = master.shift_factors
        if wlf_fit is not None:
            factors = _drawn_shifts(random, wlf_fit, master)
        w, storage, loss = [], [], []
        for k, sweep in enumerate(sweeps):
            n = sweep.raw.line.size
            w.append(sweep.raw.angular_frequency * factors[k])
            noise = random.choice(storage_residual, n)
            storage.append(np.exp(sweep.storage.operator @ (sweep.storage.values + noise)) * master.vertical_factors[k])
            noise = random.choice(loss_residual, n)
            loss.append(np.exp(sweep.loss.operator @ (sweep.loss.values + noise)) * master.vertical_factors[k])
        ws = np.concatenate(w)
        inside = (ws >= band[0] * (1 - 1e-9)) & (ws <= band[1] * (1 + 1e-9))
        data = ws[inside], np.concatenate(storage)[inside], np.concatenate(loss)[inside]
        terms[r] = non_negative(collocate(*data, times, loss_weight))
        samples[r] = _moduli(grid, rich_times, non_negative(collocate(*data, rich_times, loss_weight)))
    data = fit.angular_frequency, fit.storage_modulus, fit.loss_modulus
    rich = _moduli(grid, rich_times, non_negative(collocate(*data, rich_times, loss_weight)))
    centres = np.array([fit.series.storage_modulus(grid), fit.series.loss_modulus(grid)])
    bands = _simultaneous(samples, rich, centres)
    low, high = np.percentile(terms, [2.5, 97.5], axis=0)
    return Bands(
        angular_frequency=grid,
        storage_modulus=bands[0],
        loss_modulus=bands[1],
        long_term_modulus=np.array([low[0], high[0]]),
        moduli=np.column_stack([low[1:], high[1:]]),
        replicates=replicates,
    )


def _residuals(sweeps: tuple[SmoothedSweep, ...], which: str) -> Array:
    parts = []
    for sweep in sweeps:
        smoothed = sweep.storage if which == "storage" else sweep.loss
        moduli = sweep.raw.storage_modulus if which == "storage" else sweep.raw.loss_modulus
        residual = (np.log(moduli) - smoothed.values)[~smoothed.outliers]
        freedom = max(smoothed.values.size - smoothed.freedom, 1.0)
        parts.append(residual * np.sqrt(smoothed.values.size / freedom))
    pooled = np.concatenate(parts)
    return np.asarray(pooled - pooled.mean(), dtype=np.float64)


def _drawn_shifts(random: np.random.Generator, wlf_fit: WlfFit, master: MasterCurve) -> Array:
    centre = np.array([wlf_fit.wlf.c1, wlf_fit.wlf.c2_K])
    lowest = master.reference_temperature - float(master.temperatures.min())
    for _ in range(100):
        c1, c2 = random.multivariate_normal(centre, wlf_fit.covariance, method="eigh")
        if c1 > 0 and c2 > max(lowest, 0.0) + 1.0:
            drawn = Wlf(c1=c1, c2_K=c2, reference_temperature_degC=master.reference_temperature)
            return relative_shift(master.temperatures, master.reference_temperature, drawn)
    return master.shift_factors


def _rich_times(w: Array) -> Array:
    low, high = 1.0 / (RICH_REACH * float(w.max())), RICH_REACH / float(w.min())
    return np.geomspace(low, high, max(round(RICH_PER_DECADE * np.log10(high / low)), 4))


def _moduli(w: Array, times: Array, coefficients: Array) -> Array:
    """Return E' and E'' in Pa at w, (2, g), of coefficients [E_inf, E_1 .. E_n]."""
    x = w[:, None] * times
    storage = coefficients[0] + (x**2 / (1.0 + x**2)) @ coefficients[1:]
    return np.array([storage, (x / (1.0 + x**2)) @ coefficients[1:]])


def _simultaneous(samples: Array, rich: Array, centres: Array) -> tuple[Band, Band]:
    """Return the bands about `centres`; replicates are compared with `rich`, so that smoothing's bias counts too."""
    deviation = np.sqrt(np.mean((samples - rich) ** 2, axis=0))
    largest = np.max(np.abs(samples - rich) / np.maximum(deviation, 1e-12 * rich), axis=(1, 2))
    half = float(np.percentile(largest, 95.0)) * deviation + np.abs(centres - rich)
    storage, loss = (Band(centres[k], centres[k] - half[k], centres[k] + half[k]) for k in (0, 1))
    return storage, loss
