"""The rows of one force history: RMS, Sprague-Geers and ISO/TS 18571, each with its uncertainty and assessment."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ..quantities import HISTORY_METRIC, HISTORY_METRICS, ErrorType, HistoryMetric, Tolerances
from ..tables import MetricRow
from .align import AlignedPair
from .assessment import CANNOT_TELL, Parts, agreement, assessment
from .iso18571 import IsoRating, grade, iso18571
from .metrics import sprague_geers
from .uncertainty import Names, Uncertainties

TANGENTIAL = "tangential_force"
NOT_GIVEN = "one of the two does not give it"


@dataclass(frozen=True)
class _Score:
    reference: float
    predicted: float
    error: float
    error_type: ErrorType
    tolerance: float
    parts: Parts
    grade: str = ""


def history_rows(
    quantity: str, fine: AlignedPair, coarse: AlignedPair, names: Names, known: Uncertainties, judged: Tolerances
) -> list[MetricRow]:
    """Return a row for every score of ``normal_force`` or ``tangential_force``.

    The RMS of a tangential history is judged in newtons, against a share of the reference's largest magnitude but no
    less than the floor of its tolerance. A score that is relative to nothing is a row without an error.

    Parameters
    ----------
    fine, coarse : Pair
        The same pair of histories, resampled for RMS and Sprague-Geers and for ISO/TS 18571.
    names : tuple of str
        Case, reference source, predicted source.
    """
    amplitude = known.of_history(quantity)
    scores: dict[str, _Score] = {}
    why: dict[str, str] = {}
    scores["relative_rms"] = _rms(quantity, fine, amplitude, judged)
    try:
        scores.update(_sprague_geers(quantity, fine, amplitude, judged))
    except InputError as error:
        why["sprague"] = str(error)
    try:
        scores.update(_iso(iso18571(*coarse.forces(quantity)), amplitude, judged))
    except InputError as error:
        why["iso"] = str(error)
    rows = []
    for metric in HISTORY_METRICS:
        score = scores.get(metric.name)
        if score is None:
            note = why["iso" if metric.name.startswith("iso") else "sprague"]
            rows.append(_without(quantity, metric, names, judged, "undefined", note))
            continue
        parts, size = score.parts, score.error
        rows.append(
            MetricRow(
                names[0], quantity, metric.name, names[1], names[2], score.reference, score.predicted,
                metric_unit(metric), size, score.error_type, parts.numerical, parts.inputs, parts.data, parts.expanded,
                score.tolerance, judged[metric.name].criterion, abs(size) <= score.tolerance,
                agreement(size, parts.expanded), assessment(size, score.tolerance, parts.expanded), grade=score.grade,
            )
        )  # fmt: skip
    return rows


def not_given_rows(quantity: str, names: Names, judged: Tolerances) -> list[MetricRow]:
    """Return the rows of a history that one of the two does not give."""
    return [_without(quantity, metric, names, judged, "not_given", NOT_GIVEN) for metric in HISTORY_METRICS]


def _without(
    quantity: str, metric: HistoryMetric, names: Names, judged: Tolerances, status: str, note: str
) -> MetricRow:
    return MetricRow(
        names[0], quantity, metric.name, names[1], names[2], None, None, metric_unit(metric), None, metric.error_type,
        None, None, None, None, None, judged[metric.name].criterion, None, "cannot tell", CANNOT_TELL, status, note,
    )  # fmt: skip


def metric_unit(metric: HistoryMetric) -> str:
    """Return the unit of a score's reference and prediction."""
    return "1" if metric.error_type == "score" else "N"


def _times(parts: Parts, factor: float) -> Parts:
    return Parts(*(None if u is None else factor * u for u in (parts.numerical, parts.inputs, parts.data)))


def _rms(quantity: str, pair: AlignedPair, amplitude: Parts, judged: Tolerances) -> _Score:
    reference, predicted = pair.forces(quantity)
    scale = float(np.max(np.abs(reference)))
    rms = float(np.sqrt(np.mean((predicted - reference) ** 2)))
    own = judged["relative_rms"]
    if quantity == TANGENTIAL:
        tolerance = max(own.value * scale, own.floor or 0.0)
        return _Score(scale, rms, rms, "absolute", tolerance, _times(amplitude, scale))
    data = None if amplitude.data is None else amplitude.data * (1.0 + rms / scale)
    return _Score(scale, rms, rms / scale, "relative", own.value, Parts(amplitude.numerical, amplitude.inputs, data))


def _sprague_geers(quantity: str, pair: AlignedPair, amplitude: Parts, judged: Tolerances) -> dict[str, _Score]:
    reference, predicted = pair.forces(quantity)
    found = sprague_geers(pair.time, reference, predicted)
    sizes = (float(np.sqrt(np.mean(reference**2))), float(np.sqrt(np.mean(predicted**2))))
    errors = {
        "sprague_geers_m": found.magnitude,
        "sprague_geers_p": found.phase,
        "sprague_geers_c": found.comprehensive,
    }
    scores = {}
    for name, error in errors.items():
        moved = _times(amplitude, HISTORY_METRIC[name].sensitivity)
        data = None if moved.data is None else moved.data * (1.0 + abs(error))
        parts = Parts(moved.numerical, moved.inputs, data)
        scores[name] = _Score(*sizes, error, "relative", judged[name].value, parts)
    return scores


def _iso(rating: IsoRating, amplitude: Parts, judged: Tolerances) -> dict[str, _Score]:
    values = {
        "iso18571_r": rating.overall,
        "iso18571_corridor": rating.corridor,
        "iso18571_phase": rating.phase,
        "iso18571_magnitude": rating.magnitude,
        "iso18571_slope": rating.slope,
    }
    scores = {}
    for name, value in values.items():
        moved = _times(amplitude, HISTORY_METRIC[name].sensitivity)
        word = grade(value) if name == "iso18571_r" else ""
        scores[name] = _Score(1.0, value, value - 1.0, "score", judged[name].value, moved, word)
    return scores
