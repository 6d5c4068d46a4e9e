"""What a compound's series is worth where a study uses it: band needed against band measured, errors, consistency."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..geometry import path_of
from ..study import Case, Compound, FractionalZener, PronyFile, SpringPots, SweepFile, TimeShift
from .compound import compound_route, fit_surrogate
from .material_file import read_material
from .route_result import MaterialRoute
from .time_shift import relative_shift, told

Array = NDArray[np.float64]

WARN_ABOVE = 0.05  # RMS relative error of E' or E'' over the used band
REFUSE_ABOVE = 0.15
LOADED = 0.9  # of its largest compression: until then a point of the block counts as being loaded


@dataclass(frozen=True)
class Worth:
    """One compound as a study uses it.

    Attributes
    ----------
    name : str
    needed : (float, float), rad/s
        Frequencies of the runs, at the compound's data temperature.
    known : (float, float) or None, rad/s
        What the series was fitted to; None where the study writes it out.
    storage_error, loss_error : float or None
        RMS relative errors over the part of `needed` that is `known`; None where they are not known.
    errors_over : str
        Over what the errors were taken.
    consistent : bool or None
        Kramers-Kronig assessment.
    shift : str
        Where the shift constants come from.
    defaults : tuple of str
        Keys that the study leaves to their default values.
    """

    name: str
    needed: tuple[float, float]
    known: tuple[float, float] | None
    storage_error: float | None
    loss_error: float | None
    errors_over: str
    consistent: bool | None
    shift: str
    defaults: tuple[str, ...]

    @property
    def largest_error(self) -> float | None:
        """The larger of the two errors; None where they are not known."""
        if self.storage_error is None or self.loss_error is None:
            return None
        return max(self.storage_error, self.loss_error)

    def lines(self) -> list[str]:
        """Return the assessment in lines of text, warnings marked."""
        low, high = self.needed
        found = [f"compound {self.name}: the runs need {low:.3g} to {high:.3g} rad/s at the data's temperature"]
        if self.known is None:
            found[0] += "; what the series was fitted to is not said"
        else:
            found[0] += f"; fitted to {self.known[0]:.3g} to {self.known[1]:.3g} rad/s"
            if self.known[0] > 1.01 * low or self.known[1] < 0.99 * high:
                found.append(f"warning: compound {self.name}: the runs go beyond what was measured")
        if self.storage_error is None or self.loss_error is None:
            found.append(f"compound {self.name}: errors of the fit are not known")
        else:
            mark = "warning: " if (self.largest_error or 0.0) > WARN_ABOVE else ""
            e1, e2 = 100 * self.storage_error, 100 * self.loss_error
            found.append(
                f"{mark}compound {self.name}: RMS error of E' {e1:.2g} %, of E'' {e2:.2g} % {self.errors_over}"
            )
        if self.consistent is not None:
            assessment = "consistent" if self.consistent else "NOT consistent"
            found.append(f"compound {self.name}: E' and E'' are {assessment} with each other (Kramers-Kronig)")
        found.append(f"compound {self.name}: shift {self.shift}")
        if self.defaults:
            found.append(f"compound {self.name}: not given, so the paper's: {', '.join(self.defaults)}")
        return found

    def refuse(self, where: str) -> None:
        """Raise `InputError` where the error over the used band is above 15 %."""
        error = self.largest_error
        if error is not None and error > REFUSE_ABOVE:
            raise InputError(
                f"{where}: compound {self.name}",
                f"a fit that misses E' by {100 * (self.storage_error or 0):.3g} % and E'' by "
                f"{100 * (self.loss_error or 0):.3g} % {self.errors_over}",
                f"{100 * REFUSE_ABOVE:g} % at most (more terms, another band; --accept-fit insists)",
            )


def worths(cases: Sequence[Case]) -> tuple[Worth, ...]:
    """Return what each compound of the cases is worth, by name."""
    by_name: dict[str, list[Case]] = {}
    for case in cases:
        by_name.setdefault(case.compound_name, []).append(case)
    return tuple(_worth(name, members) for name, members in sorted(by_name.items()))


def _worth(name: str, cases: list[Case]) -> Worth:
    compound = cases[0].compound
    needed = _needed(cases, compound.data_temperature_degC, compound.time_shift)
    left = tuple(key for key in ("wlf", "poissons_ratio", "density_kg_m3") if key not in compound.model_fields_set)
    if compound.shift is not None:
        left = tuple(key for key in left if key != "wlf")
    known, errors, over, consistent, shift = _fitted(compound, cases[0], needed)
    if "wlf" in left and not isinstance(compound, PronyFile):
        shift = "by the paper's constants, not given in the study"
    return Worth(name, needed, known, errors[0], errors[1], over, consistent, shift, left)


def worth_for(cases: Sequence[Case], route: MaterialRoute, name: str) -> Worth:
    """Return what a fitted series is worth for the cases, whatever compounds they have."""
    needed = _needed(cases, route.fit.series.reference_temperature, route.law)
    errors, over = _used(route.fit.angular_frequency, route.fit.storage_residual, route.fit.loss_residual, needed)
    return Worth(name, needed, route.band, *errors, over, route.consistency.consistent, told(route.law), ())


def _needed(cases: Sequence[Case], reference: float, law: TimeShift) -> tuple[float, float]:
    """Return the frequencies of all runs at the `reference` temperature of the data in degC, rad/s.

    From one over the time in contact of a point at half the block's length to one over the time in which it takes up
    90 % of its largest compression: what relaxes faster has relaxed while it is loaded.
    """
    shifts = relative_shift(np.array([case.temperature for case in cases]), reference, law)
    bands = np.array([rates_of_loading(case) for case in cases]) * shifts[:, None]
    return float(bands[:, 0].min()), float(bands[:, 1].max())


def rates_of_loading(case: Case) -> tuple[float, float]:
    """Return the frequencies that a run needs at its own temperature, rad/s: over its contact, and while it loads."""
    built = path_of(case)
    t = np.linspace(0.0, built.contact_duration, 2001)
    depth = built.indentation(0.5 * built.columns.extent, t)
    touching = np.flatnonzero(depth > 0)
    if touching.size < 2:
        return 1.0 / built.contact_duration, 10.0 / built.contact_duration
    loaded = int(np.argmax(depth >= LOADED * depth.max()))
    rise = max(float(t[loaded] - t[touching[0]]), float(t[1]))
    return 1.0 / float(t[touching[-1]] - t[touching[0]]), 1.0 / rise


def _fitted(
    compound: Compound, case: Case, needed: tuple[float, float]
) -> tuple[tuple[float, float] | None, tuple[float | None, float | None], str, bool | None, str]:
    given = f"as given in the study: {told(compound.time_shift)}"
    if isinstance(compound, FractionalZener | SpringPots):
        fit = fit_surrogate(compound)
        used = _used(fit.angular_frequency, fit.storage_residual, fit.loss_residual, needed)
        return compound.fit.band_rad_s, *used, None, given
    if isinstance(compound, SweepFile):
        route = compound_route(compound, case.root)
        assert route is not None
        fit = route.fit
        used = _used(fit.angular_frequency, fit.storage_residual, fit.loss_residual, needed)
        return route.band, *used, route.consistency.consistent, given
    if isinstance(compound, PronyFile):
        quality = read_material(case.root / compound.file).quality
        low, high = quality.get("lowest_frequency_rad_s"), quality.get("highest_frequency_rad_s")
        known = (float(low), float(high)) if low is not None and high is not None else None
        found = [quality.get(key) for key in ("storage_rms_percent", "loss_rms_percent")]
        errors = [None if value is None else 0.01 * float(value) for value in found]
        assessment = quality.get("kramers_kronig_consistent")
        by = told(compound.time_shift)
        said = f"fitted by fit-prony: {by}" if "wlf_c1_deviation" in quality else f"as in the material file: {by}"
        return (
            known,
            (errors[0], errors[1]),
            "over all that was fitted",
            None if assessment is None else bool(assessment),
            said,
        )
    return None, (None, None), "", None, given


def _used(
    w: Array, storage: Array, loss: Array, needed: tuple[float, float]
) -> tuple[tuple[float | None, float | None], str]:
    """Return RMS errors over the needed band, or over all where fewer than five points lie in it, and which."""
    inside = (w >= needed[0]) & (w <= needed[1])
    over = "over the used band"
    if int(inside.sum()) < 5:
        inside, over = np.ones(w.size, dtype=np.bool_), "over all that was fitted"
    return (float(np.sqrt(np.mean(storage[inside] ** 2))), float(np.sqrt(np.mean(loss[inside] ** 2)))), over
