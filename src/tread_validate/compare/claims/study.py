"""Claims that follow from the study's inputs alone: moduli, shifts, masses, curvatures; one value, no run."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ...geometry import path_of
from ...geometry.trace_curvature import three_point_curvature
from ...material import prony_series, relative_shift
from ...study import Case
from ...units import IN_GRAM, IN_KPA, IN_MPA, MILLI
from .claim import Compute, Computed, Evidence, nothing

GRAVITY = 9.80665  # m/s2
ESTIMATE_FORCE = 40.0  # N, the paper's inertia estimate
EDGE_HEIGHTS = (2e-5, 1e-4)  # m above the patch: next to it
FAR = 0.02  # m: the trace's last stretch


def mean_modulus(case: Case) -> float | None:
    """Return the mean of \\|E*\\| in Pa over the compound's band, 200 log-evenly spaced frequencies."""
    fit = getattr(case.compound, "fit", None)
    if fit is None:
        return None
    series = prony_series(case.compound, case.root)
    lowest, highest = fit.band_rad_s
    frequencies = np.geomspace(lowest, highest, 200)
    return float(np.mean(np.hypot(series.storage_modulus(frequencies), series.loss_modulus(frequencies))))


def _belt(evidence: Evidence) -> Case | None:
    return next(iter(evidence.belt_cases()), None)


def _compound(case: Case) -> tuple[str, ...]:
    name = f"compound {case.compound_name} "
    return tuple(item for item in case.assumed() if item.startswith(name))


def _average_modulus(evidence: Evidence, source: str) -> Computed:
    case = _belt(evidence)
    modulus = None if case is None else mean_modulus(case)
    if case is None or modulus is None:
        return nothing("the study has no tyre case with a compound fitted over a band")
    return Computed(IN_MPA * modulus, (case.case_id,), assumed=_compound(case))


def _band(end: int, scale: float) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        case = _belt(evidence)
        fit = None if case is None else getattr(case.compound, "fit", None)
        if case is None or fit is None:
            return nothing("the study has no tyre case with a compound fitted over a band")
        shift = float(relative_shift(case.temperature, case.compound.data_temperature_degC, case.compound.time_shift))
        return Computed(scale * fit.band_rad_s[end] / (2.0 * math.pi) / shift, (case.case_id,))

    return compute


def _mass(case: Case) -> float:
    return case.length * case.width * case.height * case.compound.density_kg_m3


def _from_belt(value: Callable[[Case], float]) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        case = _belt(evidence)
        return nothing("the study has no tyre case") if case is None else Computed(value(case), (case.case_id,))

    return compute


def _curvature(which: str) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        case = next((case for case in evidence.belt_cases() if case.path.is_measured), None)
        if case is None:
            return nothing("the study has no measured profile")
        if case.path.belt_file(case.root) is None:
            return nothing("the study's trace is not a belt file")
        x, height = next((ridge.x, ridge.height) for ridge in case.path.ridges(case.root) if ridge.used)
        curvature = three_point_curvature(x, height)
        known = np.isfinite(curvature)
        if which == "largest":
            value = float(np.max(curvature[known]))
        elif which == "edge":
            value = float(np.mean(curvature[known & (height > EDGE_HEIGHTS[0]) & (height < EDGE_HEIGHTS[1])]))
        else:
            value = float(np.mean(curvature[known & ((x < x[0] + FAR) | (x > x[-1] - FAR))]))
        marked = tuple(item for item in case.assumed() if item.startswith("path "))
        return Computed(value, (case.case_id,), assumed=marked)

    return compute


def _spring_angle(evidence: Evidence, source: str) -> Computed:
    cases = evidence.belt_cases()
    if not cases:
        return nothing("the study has no tyre case")
    largest = 0.0
    for case in cases:
        path = path_of(case)
        time = np.linspace(0.0, path.contact_duration, 2001)
        touching = path.indentation(0.0, time) >= -1e-9
        largest = max(largest, float(np.max(np.abs(path.at(0.0, time[touching]).theta))))
    marked = tuple(sorted({item for case in cases for item in case.assumed() if item.startswith("path ")}))
    return Computed(math.degrees(largest), tuple(case.case_id for case in cases), assumed=marked)


def _printed_mean(name: str) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        values = [evidence.published[f"table1_{name}_{shape}_rig"].value for shape in ("rectangle", "parallelogram")]
        known = [value for value in values if value is not None]
        return Computed(sum(known) / len(known)) if known else nothing("Table 1 is not there")

    return compute


STUDY: dict[str, Compute] = {
    "band_low_at_60": _band(0, 1.0),
    "band_high_at_60": _band(1, MILLI),
    "average_modulus": _average_modulus,
    "block_mass": _from_belt(lambda case: IN_GRAM * _mass(case)),
    "inertia_pressure": _from_belt(lambda case: IN_KPA * ESTIMATE_FORCE / (case.length * case.width)),
    "inertia_acceleration": _from_belt(lambda case: ESTIMATE_FORCE / _mass(case) / GRAVITY),
    "belt_speed_kmh": _from_belt(lambda case: 3.6 * case.speed),
    "unloaded_curvature": _curvature("unloaded"),
    "largest_curvature": _curvature("largest"),
    "edge_curvature": _curvature("edge"),
    "spring_angle_below": _spring_angle,
    "typical_a_v": _printed_mean("a_v"),
    "typical_a_theta": _printed_mean("a_theta"),
}
