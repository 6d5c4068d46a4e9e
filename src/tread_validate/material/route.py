"""The whole route from sweeps to a Prony series: shift, set outliers aside, fit, judge."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..instrument import Reading
from ..study import TimeShift, Wlf
from .bands import bands, grid
from .collocation import relaxation_times
from .describe import describe, scatters
from .fit import PronyFit, fit_prony
from .kramers_kronig import kramers_kronig
from .master import MasterCurve, WlfFit, fit_wlf, shift
from .reduce import prune, refine_times
from .rich import rich_curve
from .route_result import MaterialRoute, RouteSettings
from .shifts import free_shifts, nearest_wlf, overlap, table_of
from .sweep import Sweep
from .sweeps import check_shifts, read_export
from .time_shift import log_relative_shift

Array = NDArray[np.float64]

ENOUGH_PER_DECADE = 2.5  # evenly spaced terms need no refinement above this


def material_route(
    sweeps: tuple[Sweep, ...],
    law: TimeShift,
    reference_temperature: float,
    settings: RouteSettings | None = None,
    source: str = "sweeps",
) -> MaterialRoute:
    """Shift, set outliers aside, fit and judge; `reference_temperature` in degC.

    Raises `InputError` for a sweep where `law` has no meaning (a WLF pole, the end of a table), a band outside the
    data, or too few points for the terms.
    """
    chosen = settings or RouteSettings()
    used, wlf_fit = _law(sweeps, law, reference_temperature, chosen, source)
    temperatures = np.array([sweep.temperature for sweep in sweeps])
    apart = 0.0
    logs = log_relative_shift(temperatures, reference_temperature, used)
    if not isinstance(used, Wlf):
        apart = nearest_wlf(temperatures, logs, reference_temperature)[1]
    vertical = None if wlf_fit is None else wlf_fit.vertical_factors
    master = shift(sweeps, logs, reference_temperature, vertical)
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
    law: TimeShift,
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
    return replace(material_route(sweeps, law, reference_temperature, settings, source), understood=notes)


def _law(
    sweeps: tuple[Sweep, ...], law: TimeShift, reference: float, settings: RouteSettings, source: str
) -> tuple[TimeShift, WlfFit | None]:
    """Return the law to shift by, and the fit where it was fitted."""
    if settings.free:
        temperatures = np.array([sweep.temperature for sweep in sweeps])
        return table_of(temperatures, free_shifts(sweeps, reference)), None
    check_shifts(sweeps, law, source)
    law.check(reference, f"{source}: reference temperature")
    if not settings.fit_wlf:
        return law, None
    if not isinstance(law, Wlf):
        raise InputError(source, "a law that is not WLF", "WLF constants to start the fit of C1 and C2 from")
    fitted = fit_wlf(sweeps, law, reference, settings.vertical)
    return fitted.wlf, fitted


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
            logs = log_relative_shift(np.array([s.temperature for s in sweeps]), master.reference_temperature, moved)
            other = shift(sweeps, logs, master.reference_temperature, wlf_fit.vertical_factors)
            same = np.isin(other.line * len(sweeps) + other.sweep, (master.line * len(sweeps) + master.sweep)[kept])
            w, *moduli = (values[same] for values in (other.angular_frequency, *other.moduli))
            curves.append(rich_curve(w, *moduli).moduli(wanted))
        total += (0.5 * np.log(curves[1] / curves[0])) ** 2
    return np.sqrt(total)
