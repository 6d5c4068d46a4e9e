"""One run against its reference: a row for every scalar and every history score."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...history import History
from ..quantities import HISTORIES, HISTORY_METRICS, SCALARS, SMALL_SHARE, ErrorType, Quantity, Scalars, Scale, scalars
from ..tables import MetricRow
from .align import Pair, align, window
from .history_rows import Names, Uncertainty, history_rows, metric_unit
from .iso18571 import SAMPLES as ISO_SAMPLES
from .verdict import CANNOT_TELL, verdict

THOUSAND = (500.0, 2000.0)
MIRRORED = -0.9
"""Cosine between two tangential histories below which one looks like the other with its sign turned."""


def compare(
    reference: History,
    predicted: History,
    *,
    case_id: str = "",
    reference_source: str = "reference",
    predicted_source: str = "predicted",
    uncertainty: Uncertainty = None,
    assumed: str = "",
) -> tuple[MetricRow, ...]:
    """Compare two histories of one pass.

    Parameters
    ----------
    reference, predicted : History
        Both on the clock whose zero is the first touch; nothing is shifted.
    uncertainty : float, mapping or None
        Relative uncertainty of the reference's forces, or by quantity name; None where it is not known.

    Raises
    ------
    InputError
        For a history without contact, one that ends in contact, and two whose contacts do not overlap.
    """
    limits = window(reference, predicted)
    names = (case_id, reference_source, predicted_source)
    a, b = scalars(reference), scalars(predicted)
    rows = [_scalar_row(quantity, a, b, names, uncertainty) for quantity in SCALARS]
    fine = align(reference, predicted, limits=limits)
    coarse = align(reference, predicted, ISO_SAMPLES, limits)
    for quantity in HISTORIES:
        if quantity == "tangential_force" and not (reference.gives_tangential and predicted.gives_tangential):
            rows += [_not_given(quantity, m.name, names, metric_unit(m), m.error_type) for m in HISTORY_METRICS]
        else:
            rows += history_rows(quantity, fine, coarse, names, uncertainty)
    hints = suspicions(reference, predicted, fine)
    return tuple(row.marked(assumed).hinted(hints.get((row.quantity, row.metric), "")) for row in rows)


def suspicions(reference: History, predicted: History, pair: Pair) -> dict[tuple[str, str], str]:
    """Return what looks like a mistake of units or sign, by quantity and metric: pointed out, never corrected."""
    found = {}
    ratio = float(predicted.normal_force.max()) / float(reference.normal_force.max())
    factor = max(ratio, 1.0 / ratio)
    if THOUSAND[0] <= factor <= THOUSAND[1]:
        found["peak_normal_force", "scalar"] = (
            f"{'more' if ratio > 1.0 else 'less'} than the reference by a factor of {factor:.4g}: N taken for kN?"
        )
    if reference.gives_tangential and predicted.gives_tangential:
        a, b = pair.forces("tangential_force")
        norm = float(np.sqrt(np.sum(a * a) * np.sum(b * b)))
        if norm > 0.0 and float(np.sum(a * b)) < MIRRORED * norm:
            found["tangential_force", "relative_rms"] = "the reference's mirror image: is T positive towards -x?"
    return found


def empty_rows(
    case_id: str,
    reference_source: str,
    predicted_source: str,
    status: str,
    note: str,
    *,
    reference: Scalars | None = None,
    predicted: Scalars | None = None,
    assumed: str = "",
) -> tuple[MetricRow, ...]:
    """Return the rows of a comparison that cannot be made: every quantity and metric, without an error."""
    a = reference.as_dict() if reference is not None else {}
    b = predicted.as_dict() if predicted is not None else {}
    rows = []
    for quantity in SCALARS:
        kind: ErrorType = "relative" if quantity.scale == "itself" else "absolute"
        rows.append((quantity.name, "scalar", a.get(quantity.name), b.get(quantity.name), quantity.unit, kind))
    for name in HISTORIES:
        for metric in HISTORY_METRICS:
            rows.append((name, metric.name, None, None, metric_unit(metric), metric.error_type))
    return tuple(
        MetricRow(
            case_id, quantity_name, metric_name, reference_source, predicted_source, ref, pred, unit, None, error_type,
            None, None, None, CANNOT_TELL, status, note, assumed,
        )
        for quantity_name, metric_name, ref, pred, unit, error_type in rows
    )  # fmt: skip


def scalar_row(
    quantity: Quantity,
    reference: float,
    predicted: float,
    scales: Mapping[str, float],
    names: Names,
    spread: float | None,
) -> MetricRow:
    """Return the row of one scalar.

    Parameters
    ----------
    scales : mapping
        The reference's scalars, of which tolerances are shares.
    spread : float or None
        Uncertainty of the reference value, in the quantity's unit; None where it is not known.
    """
    small = quantity.small is not None and abs(reference) < SMALL_SHARE * _scale(quantity.small, scales)
    case_id, reference_source, predicted_source = names
    kind: ErrorType
    if quantity.scale == "itself" and not small and reference != 0.0:
        kind = "relative"
        error = (predicted - reference) / reference
        moved = None if spread is None else spread / abs(reference) * (1.0 + abs(error))
        tolerance = quantity.tolerance
    else:
        kind = "absolute"
        error = predicted - reference
        moved = spread
        if quantity.scale != "itself":
            tolerance = quantity.tolerance * _scale(quantity.scale, scales)
        else:
            tolerance = quantity.tolerance * SMALL_SHARE * (_scale(quantity.small, scales) if quantity.small else 0.0)
    note = f"small reference: judged in {quantity.unit}" if small and quantity.unit != "1" else ""
    return MetricRow(
        case_id, quantity.name, "scalar", reference_source, predicted_source, reference, predicted, quantity.unit,
        error, kind, moved, tolerance, abs(error) <= tolerance, verdict(error, tolerance, moved), "current", note,
    )  # fmt: skip


def _not_given(quantity: str, metric: str, names: Names, unit: str, error_type: ErrorType) -> MetricRow:
    case_id, reference_source, predicted_source = names
    return MetricRow(
        case_id, quantity, metric, reference_source, predicted_source, None, None, unit, None, error_type, None, None,
        None, CANNOT_TELL, "not_given", "one of the two does not give it",
    )  # fmt: skip


def _scalar_row(quantity: Quantity, a: Scalars, b: Scalars, names: Names, uncertainty: Uncertainty) -> MetricRow:
    scales, values = a.as_dict(), b.as_dict()
    if quantity.name not in scales or quantity.name not in values:
        kind: ErrorType = "relative" if quantity.scale == "itself" else "absolute"
        return _not_given(quantity.name, "scalar", names, quantity.unit, kind)
    reference, predicted = scales[quantity.name], values[quantity.name]
    return scalar_row(quantity, reference, predicted, scales, names, _spread(quantity, a, uncertainty))


def _spread(quantity: Quantity, reference: Scalars, uncertainty: Uncertainty) -> float | None:
    """Return what the uncertainty means for one scalar, in its unit.

    One number is a relative error of all forces: the catalogue says what each quantity makes of it.
    """
    if uncertainty is None:
        return None
    scales = reference.as_dict()
    if not isinstance(uncertainty, Mapping):
        return quantity.spread(uncertainty, quantity.name, scales)
    known = uncertainty.get(quantity.name)
    if known is None:
        return 0.0 if quantity.flag else None
    return known * abs(scales[quantity.name])


def _scale(name: Scale, scales: Mapping[str, float]) -> float:
    return 1.0 if name == "one" else scales[name]
