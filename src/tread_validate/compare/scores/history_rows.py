"""The rows of one force history: RMS, Sprague-Geers and ISO/TS 18571, each with its uncertainty and verdict."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ..quantities import FORCE_TOLERANCE, HISTORY_METRICS, SMALL_SHARE, ErrorType, HistoryMetric
from ..tables import MetricRow
from .align import Pair
from .iso18571 import IsoRating, grade, iso18571
from .metrics import sprague_geers
from .verdict import CANNOT_TELL, verdict

Uncertainty = float | Mapping[str, float] | None
Names = tuple[str, str, str]
TANGENTIAL_PEAKS = ("peak_positive_tangential_force", "peak_negative_tangential_force")


@dataclass(frozen=True)
class _Score:
    reference: float
    predicted: float
    error: float
    error_type: ErrorType
    tolerance: float
    moved: float | None
    note: str = ""
    grade: str = ""


def history_rows(quantity: str, fine: Pair, coarse: Pair, names: Names, uncertainty: Uncertainty) -> list[MetricRow]:
    """Return a row for every score of ``normal_force`` or ``tangential_force``.

    A tangential reference whose largest magnitude is below `SMALL_SHARE` of the peak normal force is judged in newtons:
    the RMS of the difference against 2 % of that peak. The shape scores stay what they are and say so. A score
    that is relative to nothing is a row without an error.

    Parameters
    ----------
    fine, coarse : Pair
        The same pair of histories, resampled for RMS and Sprague-Geers and for ISO/TS 18571.
    names : tuple of str
        Case, reference source, predicted source.
    """
    amplitude = _amplitude(uncertainty, quantity)
    reference = fine.forces(quantity)[0]
    peak = float(np.max(fine.reference_normal))
    small = quantity == "tangential_force" and float(np.max(np.abs(reference))) < SMALL_SHARE * peak
    scores = {"relative_rms": _rms(quantity, fine, peak, small, amplitude)}
    why: dict[str, str] = {}
    try:
        scores.update(_sprague_geers(quantity, fine, amplitude, small))
    except InputError as error:
        why["sprague"] = str(error)
    try:
        scores.update(_iso(iso18571(*coarse.forces(quantity)), amplitude))
    except InputError as error:
        why["iso"] = str(error)
    rows = []
    for metric in HISTORY_METRICS:
        score = scores.get(metric.name)
        if score is None:
            note = why["iso" if metric.name.startswith("iso") else "sprague"]
            rows.append(
                MetricRow(
                    names[0], quantity, metric.name, names[1], names[2], None, None, metric_unit(metric), None,
                    metric.error_type, None, metric.tolerance, None, CANNOT_TELL, "undefined", note,
                )
            )  # fmt: skip
            continue
        rows.append(
            MetricRow(
                names[0], quantity, metric.name, names[1], names[2], score.reference, score.predicted,
                metric_unit(metric), score.error, score.error_type, score.moved, score.tolerance,
                abs(score.error) <= score.tolerance, verdict(score.error, score.tolerance, score.moved), "current",
                score.note,
                grade=score.grade,
            )
        )  # fmt: skip
    return rows


def metric_unit(metric: HistoryMetric) -> str:
    """Return the unit of a score's reference and prediction."""
    return "1" if metric.error_type == "score" else "N"


def _rms(quantity: str, pair: Pair, peak: float, small: bool, amplitude: float | None) -> _Score:
    reference, predicted = pair.forces(quantity)
    scale = float(np.max(np.abs(reference)))
    rms = float(np.sqrt(np.mean((predicted - reference) ** 2)))
    if small:
        moved = None if amplitude is None else amplitude * scale
        note = "small reference: judged in N"
        return _Score(scale, rms, rms, "absolute", FORCE_TOLERANCE * SMALL_SHARE * peak, moved, note)
    moved = None if amplitude is None else amplitude * (1.0 + rms / scale)
    return _Score(scale, rms, rms / scale, "relative", FORCE_TOLERANCE, moved)


def _sprague_geers(quantity: str, pair: Pair, amplitude: float | None, small: bool) -> dict[str, _Score]:
    reference, predicted = pair.forces(quantity)
    found = sprague_geers(pair.time, reference, predicted)
    sizes = (float(np.sqrt(np.mean(reference**2))), float(np.sqrt(np.mean(predicted**2))))
    errors = {
        "sprague_geers_m": found.magnitude,
        "sprague_geers_p": found.phase,
        "sprague_geers_c": found.comprehensive,
    }
    note = "small reference: see the RMS in N" if small else ""
    scores = {}
    for metric in HISTORY_METRICS:
        if metric.name in errors:
            error = errors[metric.name]
            moved = None if amplitude is None else metric.sensitivity * amplitude * (1.0 + abs(error))
            scores[metric.name] = _Score(*sizes, error, "relative", metric.tolerance, moved, note)
    return scores


def _iso(rating: IsoRating, amplitude: float | None) -> dict[str, _Score]:
    values = {
        "iso18571_r": rating.overall,
        "iso18571_corridor": rating.corridor,
        "iso18571_phase": rating.phase,
        "iso18571_magnitude": rating.magnitude,
        "iso18571_slope": rating.slope,
    }
    scores = {}
    for metric in HISTORY_METRICS:
        if metric.name in values:
            value = values[metric.name]
            moved = None if amplitude is None else metric.sensitivity * amplitude
            word = grade(value) if metric.name == "iso18571_r" else ""
            scores[metric.name] = _Score(1.0, value, value - 1.0, "score", metric.tolerance, moved, grade=word)
    return scores


def _amplitude(uncertainty: Uncertainty, quantity: str) -> float | None:
    """Return the relative amplitude error of a force history: its own, or that of its peaks."""
    if not isinstance(uncertainty, Mapping):
        return uncertainty
    if quantity in uncertainty:
        return uncertainty[quantity]
    peaks = ("peak_normal_force",) if quantity == "normal_force" else TANGENTIAL_PEAKS
    known = [uncertainty[name] for name in peaks if name in uncertainty]
    return max(known) if known else None
