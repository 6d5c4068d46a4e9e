"""From a compound of the study to its Prony series."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..instrument import Reading
from ..provenance import sha256_file
from ..study import Compound, FractionalZener, PronyCompound, PronyFile, SpringPots, SweepFile
from ..units import MPA
from .collocation import relaxation_times
from .exact import geometric
from .fit import PronyFit, fit_prony
from .material_file import read_material
from .prony import PronySeries
from .route import read_route
from .route_result import MaterialRoute, RouteSettings
from .spring_pots import spring_pots
from .zener import fractional_zener

Array = NDArray[np.float64]

SURROGATE_POINTS_PER_DECADE = 20
TURN = 6.283185307179586  # rad
DIGITS = 7  # of a fitted number, so that decks and digests do not hang on the last bits of a library


def prony_series(compound: Compound, root: Path | str | None = None) -> PronySeries:
    """Return the Prony series of a compound at its data temperature.

    A file name in the compound is relative to `root` (the study's root; the working directory where it is None). Fits
    are remembered, by the compound's values and the file's SHA-256, so that many cases cost one fit.

    Raises `InputError` for a file that is missing or wrong.
    """
    if isinstance(compound, PronyCompound):
        terms = sorted(compound.terms, key=lambda term: term.relaxation_time_s)
        return PronySeries(
            compound.long_term_modulus_MPa * MPA,
            np.array([term.modulus_MPa * MPA for term in terms]),
            np.array([term.relaxation_time_s for term in terms]),
            compound.data_temperature_degC,
        )
    if isinstance(compound, FractionalZener | SpringPots):
        return rounded(fit_surrogate(compound).series)
    path = (Path(root) if root is not None else Path()) / compound.file
    digest = sha256_file(path) if path.is_file() else ""
    return _from_file(compound, path, digest)


@lru_cache(maxsize=64)
def fit_surrogate(compound: FractionalZener | SpringPots) -> PronyFit:
    """Fit the Prony series of a fractional law, sampled over the compound's band at 20 points a decade."""
    low, high = compound.fit.band_rad_s
    points = max(round(SURROGATE_POINTS_PER_DECADE * np.log10(high / low)), compound.fit.terms) + 1
    w = geometric(low, high, points)
    modulus = surrogate_modulus(compound, w)
    times = relaxation_times((low, high), compound.fit.terms, compound.fit.low_margin, compound.fit.high_margin)
    return fit_prony(w, modulus.real, modulus.imag, times, compound.data_temperature_degC)


def surrogate_modulus(compound: FractionalZener | SpringPots, angular_frequency: Array) -> NDArray[np.complex128]:
    """Return E*(w) in Pa of a compound given by a fractional law, at its data temperature; w in rad/s, any shape."""
    if isinstance(compound, SpringPots):
        branches = [[(pot.modulus_MPa * MPA, pot.phase_deg / 90.0) for pot in branch] for branch in compound.branches]
        return spring_pots(angular_frequency, TURN * compound.reference_frequency_Hz, branches)
    return fractional_zener(
        angular_frequency,
        compound.long_term_modulus_MPa * MPA,
        compound.modulus_rise_MPa * MPA,
        compound.corner_frequency_rad_s,
        compound.exponent,
    )


@lru_cache(maxsize=64)
def _from_file(compound: PronyFile | SweepFile, path: Path, digest: str) -> PronySeries:
    """Read once per content: `digest` is there for the cache."""
    if isinstance(compound, SweepFile):
        return rounded(sweep_route(compound, path).fit.series)
    return read_material(path).series_at(compound.data_temperature_degC, compound.time_shift, str(path))


def compound_route(compound: Compound, root: Path | str | None = None) -> MaterialRoute | None:
    """Return the route from raw sweeps to the series for a ``sweeps`` compound; None for every other kind.

    For a report: raw and smoothed sweeps, master curve, fit, residuals, bands and quality.
    """
    if not isinstance(compound, SweepFile):
        return None
    path = (Path(root) if root is not None else Path()) / compound.file
    return _route(compound, path, sha256_file(path) if path.is_file() else "")


@lru_cache(maxsize=16)
def _route(compound: SweepFile, path: Path, digest: str) -> MaterialRoute:
    return sweep_route(compound, path, replicates=400)


def sweep_route(compound: SweepFile, path: Path, replicates: int = 0) -> MaterialRoute:
    """Go from the sweeps in `path` to the series with the compound's settings."""
    fit = compound.fit
    settings = RouteSettings(
        terms=fit.terms,
        band=fit.band_rad_s,
        low_margin=fit.low_margin,
        high_margin=fit.high_margin,
        times="even",
        replicates=replicates,
    )
    reading = Reading(
        compound.columns.model_dump(exclude_none=True),
        {f"--{name}-unit": unit for name, unit in compound.units.model_dump(exclude_none=True).items()},
    )
    return read_route(path, compound.time_shift, compound.data_temperature_degC, settings, reading=reading)


def rounded(series: PronySeries) -> PronySeries:
    """Return the series with 7 significant digits and without terms that carry nothing."""
    keep = series.moduli > 1e-9 * series.instantaneous_modulus
    return PronySeries(
        _round(np.array([series.long_term_modulus]))[0],
        _round(series.moduli[keep]),
        _round(series.relaxation_times[keep]),
        series.reference_temperature,
    )


def _round(values: Array) -> Array:
    return np.array([float(f"{value:.{DIGITS - 1}e}") for value in values])
