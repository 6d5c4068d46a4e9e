"""The whole route from sweeps to a Prony series, with everything that a reader needs to judge it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..instrument import Reading
from ..study import Wlf
from .bands import Bands, bands, grid
from .collocation import relaxation_times
from .describe import describe, scatters
from .fit import PronyFit, fit_prony
from .kramers_kronig import KramersKronig, kramers_kronig
from .master import MasterCurve, VerticalShift, WlfFit, fit_wlf, shift
from .reduce import prune, refine_times
from .rich import RichCurve, Scatter, rich_curve
from .shifts import Overlap, ShiftKind, arrhenius, free_shifts, nearest_wlf, overlap, read_shift_table
from .sweep import Sweep
from .sweeps import check_above_pole, read_export

Array = NDArray[np.float64]
Times = Literal["auto", "even", "refined"]

ENOUGH_PER_DECADE = 2.5  # evenly spaced terms need no refinement above this


@dataclass(frozen=True)
class RouteSettings:
    """How sweeps become a series.

    Attributes
    ----------
    terms : int
        Exponentials besides the long-term modulus.
    band : (float, float) or None, rad/s
        Reduced frequencies that the fit uses; None is all that were measured.
    low_margin, high_margin : float
        g2 and g1: times reach from 2 pi/(g1 w_max) to 2 pi g2/w_min.
    times : str
        ``even``, ``refined``, or ``auto``: refined below 2.5 terms a decade.
    loss_weight : float
        Weight of the relative errors of E'' against those of E'.
    largest_error : float or None
        Prune to the fewest terms with both RMS errors at most this.
    fit_wlf : bool
        Fit C1 and C2 instead of taking the given ones.
    shift : str
        ``wlf``; ``free``, neighbour on neighbour; ``arrhenius`` with `activation_energy` in kJ/mol; ``table``.
    replicates : int
        Resamples of the data behind the bands of the terms; 0 for no bands.
    """

    terms: int = 24
    band: tuple[float, float] | None = None
    low_margin: float = 5.0
    high_margin: float = 5.0
    times: Times = "auto"
    loss_weight: float = 1.0
    largest_error: float | None = None
    fit_wlf: bool = False
    vertical: VerticalShift = "none"
    shift: ShiftKind = "wlf"
    activation_energy: float = 0.0
    shift_table: Path | None = None
    replicates: int = 400
    seed: int = 1


@dataclass(frozen=True)
class MaterialRoute:
    """Sweeps, what was made of them at each stage, and how good it is. Every error is against the data as measured.

    Attributes
    ----------
    source : str
    sweeps : tuple of Sweep
    wlf : Wlf
        Constants used.
    wlf_fit : WlfFit or None
    master : MasterCurve
    band : (float, float), rad/s
    rich : RichCurve
        The curve that outliers and scatter are measured from.
    outlier : (m,) bool array
        Points of the master curve that were set aside.
    scatters : (Scatter, Scatter)
        Of E' and E''.
    fit : PronyFit
        Series and relative residuals in the band.
    consistency : KramersKronig
    bands : Bands or None
    overlap : Overlap or None
        How well neighbouring sweeps lie on each other.
    wlf_apart : float
        Largest distance of `wlf` from the shifts of the sweeps, decades; 0 where they were made by it.
    understood : tuple of str
        How the files were read.
    bands_refused : str
        Why there are no bands although they were asked for: a band is wider than its modulus.
    """

    source: str
    settings: RouteSettings
    sweeps: tuple[Sweep, ...]
    wlf: Wlf
    wlf_fit: WlfFit | None
    master: MasterCurve
    band: tuple[float, float]
    rich: RichCurve
    outlier: NDArray[np.bool_]
    scatters: tuple[Scatter, Scatter]
    fit: PronyFit
    consistency: KramersKronig
    bands: Bands | None
    understood: tuple[str, ...] = ()
    bands_refused: str = ""
    overlap: Overlap | None = None
    wlf_apart: float = 0.0

    @property
    def outliers(self) -> int:
        """Number of points set aside."""
        return int(self.outlier.sum())

    def curve(self, number: int) -> tuple[Array, Array]:
        """Return E' and E'' in Pa of the rich curve at the points of one sweep, (n,) each."""
        sweep, height = self.sweeps[number], float(self.master.vertical_factors[number])
        found = self.rich.moduli(sweep.angular_frequency * float(self.master.shift_factors[number])) / height
        return found[0], found[1]

    def set_aside(self, number: int) -> NDArray[np.bool_]:
        """Return which points of one sweep are outliers, (n,)."""
        return np.isin(self.sweeps[number].line, self.master.line[self.outlier & (self.master.sweep == number)])

    def quality(self) -> dict[str, float | int | str | bool]:
        """Return the figures that tell how good the series is, by name with unit."""
        fit, series = self.fit, self.fit.series
        rows: dict[str, float | int | str | bool] = {
            "points": int(fit.angular_frequency.size),
            "sweeps": len(self.sweeps),
            "outliers_set_aside": self.outliers,
            "lowest_frequency_rad_s": float(f"{self.band[0]:.6g}"),
            "highest_frequency_rad_s": float(f"{self.band[1]:.6g}"),
            "storage_rms_percent": round(100 * fit.storage_rms, 4),
            "loss_rms_percent": round(100 * fit.loss_rms, 4),
            "largest_storage_error_percent": round(100 * float(np.max(np.abs(fit.storage_residual))), 4),
            "largest_loss_error_percent": round(100 * float(np.max(np.abs(fit.loss_residual))), 4),
            "excess_of_sign_control_percent": round(100 * fit.excess, 6),
            "terms_asked": self.settings.terms,
            "terms_that_carry": int(np.sum(series.moduli > 1e-9 * series.instantaneous_modulus)),
            "kramers_kronig_mismatch_percent": round(100 * self.consistency.mismatch, 3),
            "kramers_kronig_dispersion_ratio": round(self.consistency.dispersion_ratio, 4),
            "kramers_kronig_consistent": self.consistency.consistent,
        }
        if self.wlf_fit is not None:
            c1, c2 = self.wlf_fit.deviations
            rows["wlf_c1_deviation"], rows["wlf_c2_deviation_K"] = round(c1, 4), round(c2, 3)
            rows["overlap_misfit_percent"] = round(100 * self.wlf_fit.misfit, 3)
        if self.overlap is not None and len(self.sweeps) > 1:
            rows["shift"] = self.settings.shift
            rows["overlap_of_neighbours_percent"] = round(100 * self.overlap.misfit, 3)
            rows["worst_overlap_percent"] = round(100 * self.overlap.worst, 3)
            rows["neighbours_apart"] = self.overlap.apart
        if self.wlf_apart:
            rows["wlf_misses_shifts_by_decades"] = round(self.wlf_apart, 4)
        for name, one in zip(("storage", "loss"), self.scatters, strict=True):
            rows[f"{name}_noise_percent"] = round(100 * one.noise, 3)
            rows[f"{name}_misfit_percent"] = round(100 * one.misfit, 3)
        if self.bands_refused:
            rows["bands_refused"] = self.bands_refused
        if self.bands is not None:
            b = self.bands
            for k, (name, band) in enumerate((("storage", b.storage_modulus), ("loss", b.loss_modulus))):
                half = 0.5 * np.max((band.upper - band.lower) / band.centre)
                rows[f"{name}_band_95_percent"] = round(100 * float(half), 3)
                rows[f"{name}_points_in_their_band_percent"] = round(100 * b.points_inside[k], 1)
                rows[f"{name}_fit_in_the_band_percent"] = round(100 * b.fit_inside[k], 1)
        return rows


def material_route(
    sweeps: tuple[Sweep, ...],
    wlf: Wlf,
    reference_temperature: float,
    settings: RouteSettings | None = None,
    source: str = "sweeps",
) -> MaterialRoute:
    """Shift, set outliers aside, fit and judge; `reference_temperature` in degC.

    Raises `InputError` for a sweep at or below the WLF pole, a band outside the data, or too few points for the terms.
    """
    chosen = settings or RouteSettings()
    if chosen.shift == "wlf":
        check_above_pole(sweeps, wlf, source)
    wlf_fit = fit_wlf(sweeps, wlf, reference_temperature, chosen.vertical) if chosen.fit_wlf else None
    used = wlf if wlf_fit is None else wlf_fit.wlf
    vertical = None if wlf_fit is None else wlf_fit.vertical_factors
    logs, apart = _shifts(sweeps, reference_temperature, chosen)
    if logs is not None:
        used, apart = nearest_wlf(np.array([sweep.temperature for sweep in sweeps]), logs, reference_temperature)
    master = shift(sweeps, used, reference_temperature, vertical, logs)
    band = _band(master, chosen, source)
    inside = (master.angular_frequency >= band[0] * (1 - 1e-9)) & (master.angular_frequency <= band[1] * (1 + 1e-9))
    if 2 * int(inside.sum()) < chosen.terms + 1:
        found = f"{int(inside.sum())} points between {band[0]:.4g} and {band[1]:.4g} rad/s"
        raise InputError(source, found, f"at least {(chosen.terms + 2) // 2} for {chosen.terms} terms")
    rich, outlier = describe(master)
    kept = inside & ~outlier
    both = scatters(master, rich, outlier, kept)
    w, storage, loss = (values[kept] for values in (master.angular_frequency, *master.moduli))
    fit = _fit(w, storage, loss, band, reference_temperature, chosen)
    raw = master.angular_frequency[inside], master.storage_modulus[inside], master.loss_modulus[inside]
    found_bands, refused = None, ""
    if chosen.replicates:
        shifted = None if wlf_fit is None else _shift_deviation(sweeps, wlf_fit, master, ~outlier, fit)
        behind = replace(rich, leverage=rich.leverage[:, kept[~outlier]])
        everywhere = master.angular_frequency[~outlier]
        try:
            found_bands = bands(
                fit, raw, everywhere, behind, both, shifted, chosen.loss_weight, chosen.replicates, chosen.seed
            )
        except InputError as error:  # the data say too little there; the fit stands, its bands do not
            refused = str(error)
    consistency = kramers_kronig(w, storage, loss)
    return MaterialRoute(
        source,
        chosen,
        sweeps,
        used,
        wlf_fit,
        master,
        band,
        rich,
        outlier,
        both,
        fit,
        consistency,
        found_bands,
        bands_refused=refused,
        overlap=overlap(sweeps, np.log10(master.shift_factors)),
        wlf_apart=apart,
    )


def read_route(
    path: Path | str | Sequence[Path | str],
    wlf: Wlf,
    reference_temperature: float,
    settings: RouteSettings | None = None,
    modulus_unit: str | None = None,
    confirm_units: bool = False,
    ready_master: bool = False,
    reading: Reading | None = None,
) -> MaterialRoute:
    """Read files of sweeps, or a ready master curve at `reference_temperature`, and go the whole route."""
    at = reference_temperature if ready_master else None
    sweeps, notes = read_export(path, modulus_unit, confirm_units, at, reading)
    source = str(path if isinstance(path, str | Path) else path[0])
    return replace(material_route(sweeps, wlf, reference_temperature, settings, source), understood=notes)


def _shifts(sweeps: tuple[Sweep, ...], reference: float, settings: RouteSettings) -> tuple[Array | None, float]:
    """Return log10 a_T of each sweep where they are not to be by WLF constants."""
    temperatures = np.array([sweep.temperature for sweep in sweeps])
    if settings.shift == "free":
        return free_shifts(sweeps, reference), 0.0
    if settings.shift == "arrhenius":
        return arrhenius(temperatures, reference, settings.activation_energy), 0.0
    if settings.shift == "table":
        assert settings.shift_table is not None
        return read_shift_table(settings.shift_table, temperatures, reference), 0.0
    return None, 0.0


def _band(master: MasterCurve, settings: RouteSettings, source: str) -> tuple[float, float]:
    measured = float(master.angular_frequency[0]), float(master.angular_frequency[-1])
    if settings.band is None:
        return measured
    low, high = settings.band
    if not measured[0] / 1.5 <= low < high <= measured[1] * 1.5:
        found = f"reduced frequencies of {measured[0]:.4g} to {measured[1]:.4g} rad/s"
        raise InputError(source, found, f"data over the band of {low:g} to {high:g} rad/s")
    return low, high


def _fit(
    w: Array, storage: Array, loss: Array, band: tuple[float, float], temperature: float, settings: RouteSettings
) -> PronyFit:
    times = relaxation_times(band, settings.terms, settings.low_margin, settings.high_margin)
    fit = fit_prony(w, storage, loss, times, temperature, settings.loss_weight)
    sparse = settings.terms < ENOUGH_PER_DECADE * np.log10(band[1] / band[0])
    if settings.times == "refined" or (settings.times == "auto" and sparse):
        fit = refine_times(fit, settings.loss_weight)
    if settings.largest_error is not None:
        fit = prune(fit, settings.largest_error, settings.loss_weight)
    if fit.method == "non_negative":  # searched for in floating point: once more, to the minimum on every machine
        fit = fit_prony(w, storage, loss, fit.series.relaxation_times, temperature, settings.loss_weight)
    return fit


def _shift_deviation(
    sweeps: tuple[Sweep, ...], wlf_fit: WlfFit, master: MasterCurve, kept: NDArray[np.bool_], fit: PronyFit
) -> Array:
    """Return relative standard deviations of E' and E'' on the bands' frequencies that fitted constants bring."""
    sizes, directions = np.linalg.eigh(wlf_fit.covariance)
    wanted = grid(fit.angular_frequency)
    total = np.zeros((2, wanted.size))
    lowest = max(master.reference_temperature - float(master.temperatures.min()), 0.0)
    place = np.array([wlf_fit.wlf.c1, wlf_fit.wlf.c2_K])
    for size, direction in zip(sizes, directions.T, strict=True):
        curves = []
        for sign in (-1.0, 1.0):
            c1, c2 = place + sign * np.sqrt(max(float(size), 0.0)) * direction
            moved = Wlf(
                c1=max(c1, 1e-3), c2_K=max(c2, lowest + 1.0), reference_temperature_degC=master.reference_temperature
            )
            other = shift(sweeps, moved, master.reference_temperature, wlf_fit.vertical_factors)
            same = np.isin(other.line * len(sweeps) + other.sweep, (master.line * len(sweeps) + master.sweep)[kept])
            w, *moduli = (values[same] for values in (other.angular_frequency, *other.moduli))
            curves.append(rich_curve(w, *moduli).moduli(wanted))
        total += (0.5 * np.log(curves[1] / curves[0])) ** 2
    return np.sqrt(total)
