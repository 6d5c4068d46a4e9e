"""How sweeps become a Prony series, and all that was found on the way, with the figures that judge it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..study import ArrheniusShift, ShiftTable, TimeShift, Wlf
from .bands import Bands
from .fit import PronyFit
from .kramers_kronig import KramersKronig
from .master import MasterCurve, VerticalShift, WlfFit
from .rich import RichCurve, Scatter
from .shifts import Overlap
from .sweep import Sweep

Array = NDArray[np.float64]
Times = Literal["auto", "even", "refined"]

KINDS: dict[type, str] = {Wlf: "wlf", ArrheniusShift: "arrhenius", ShiftTable: "table"}


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
        Fit C1 and C2 instead of taking the given law.
    free : bool
        Lay each sweep on its neighbour instead; the shifts become a table.
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
    free: bool = False
    replicates: int = 400
    seed: int = 1


@dataclass(frozen=True)
class MaterialRoute:
    """Sweeps, what was made of them at each stage, and how good it is. Every error is against the data as measured.

    Attributes
    ----------
    source : str
    sweeps : tuple of Sweep
    law : Wlf, ArrheniusShift or ShiftTable
        By which times shift: the law that was given, unless it was fitted.
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
        Largest distance of the nearest WLF law from the shifts of the sweeps, decades; 0 where they are by WLF.
    understood : tuple of str
        How the files were read.
    bands_refused : str
        Why there are no bands although they were asked for: a band is wider than its modulus.
    """

    source: str
    settings: RouteSettings
    sweeps: tuple[Sweep, ...]
    law: TimeShift
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
            "excess_of_sign_control_percent": round(100 * fit.excess, 6) + 0.0,
            "terms_asked": self.settings.terms,
            "terms_that_carry": int(np.sum(series.moduli > 1e-9 * series.instantaneous_modulus)),
            "kramers_kronig_mismatch_percent": round(100 * self.consistency.mismatch, 3),
            "kramers_kronig_dispersion_ratio": round(self.consistency.dispersion_ratio, 4),
            "kramers_kronig_ratio_deviation": round(self.consistency.ratio_deviation, 4),
            "kramers_kronig_consistent": self.consistency.consistent,
        }
        if self.wlf_fit is not None:
            c1, c2 = self.wlf_fit.deviations
            rows["wlf_c1_deviation"], rows["wlf_c2_deviation_K"] = round(c1, 4), round(c2, 3)
            rows["overlap_misfit_percent"] = round(100 * self.wlf_fit.misfit, 3)
        if self.overlap is not None and len(self.sweeps) > 1:
            rows["shift"] = "free" if self.settings.free else KINDS[type(self.law)]
            rows["overlap_of_neighbours_percent"] = round(100 * self.overlap.misfit, 3)
            rows["worst_overlap_percent"] = round(100 * self.overlap.worst, 3)
            rows["neighbours_apart"] = self.overlap.apart
        if self.wlf_apart:
            rows["nearest_wlf_misses_shifts_by_decades"] = round(self.wlf_apart, 4)
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
