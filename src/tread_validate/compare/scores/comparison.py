"""One run against its reference: a row for every scalar and every history score."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...history import History
from ..quantities import HISTORIES, HISTORY_METRICS, SCALARS, Quantity, Scalars, Scale, Tolerances, scalars
from ..quantities import tolerances as default_tolerances
from ..tables import MetricRow
from .align import AlignedPair, align, window
from .assessment import CANNOT_TELL, UNKNOWN, Parts, agreement, assessment
from .history_rows import NOT_GIVEN, history_rows, metric_unit, not_given_rows
from .iso18571 import SAMPLES as ISO_SAMPLES
from .uncertainty import Names, Uncertainties, Uncertainty

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
    numerical: Uncertainty = 0.0,
    inputs: Uncertainty = 0.0,
    tolerances: Tolerances | None = None,
    assumed: str = "",
) -> tuple[MetricRow, ...]:
    """Compare two histories of one pass.

    Parameters
    ----------
    reference, predicted : History
        Both on the clock whose zero is the first contact; nothing is shifted.
    uncertainty, numerical, inputs : float, mapping or None
        Standard uncertainties: of the reference's forces, of the prediction's from its mesh and step, and of the
        difference from inputs that the two do not share. Relative, for all forces or by quantity name; None where not
        known.
    tolerances : mapping, optional
        What is good enough, by quantity and score; the defaults of the catalogue if left out.

    Raises
    ------
    InputError
        For a history without contact, one that ends in contact, and two whose contacts do not overlap.
    """
    limits = window(reference, predicted)
    names = (case_id, reference_source, predicted_source)
    known = Uncertainties(uncertainty, numerical, inputs)
    judged = tolerances if tolerances is not None else default_tolerances()
    a, b = scalars(reference), scalars(predicted)
    rows = []
    for quantity in SCALARS:
        value, found = a.values.get(quantity.name), b.values.get(quantity.name)
        if value is None or found is None:
            rows.append(empty_row(quantity, value, found, names, judged, "not_given", NOT_GIVEN))
            continue
        rows.append(scalar_row(quantity, value, found, a.as_dict(), names, known.of_scalar(quantity, a, b), judged))
    fine = align(reference, predicted, limits=limits)
    coarse = align(reference, predicted, ISO_SAMPLES, limits)
    for name in HISTORIES:
        if name == "tangential_force" and not (reference.gives_tangential and predicted.gives_tangential):
            rows += not_given_rows(name, names, judged)
        else:
            rows += history_rows(name, fine, coarse, names, known, judged)
    hints = suspicions(reference, predicted, fine)
    return tuple(row.marked(assumed).hinted(hints.get((row.quantity, row.metric), "")) for row in rows)


def suspicions(reference: History, predicted: History, pair: AlignedPair) -> dict[tuple[str, str], str]:
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
    tolerances: Tolerances | None = None,
    assumed: str = "",
) -> tuple[MetricRow, ...]:
    """Return the rows of a comparison that cannot be made: every quantity and metric, without an error."""
    a = reference.as_dict() if reference is not None else {}
    b = predicted.as_dict() if predicted is not None else {}
    judged = tolerances if tolerances is not None else default_tolerances()
    names = (case_id, reference_source, predicted_source)
    rows = [
        empty_row(quantity, a.get(quantity.name), b.get(quantity.name), names, judged, status, note)
        for quantity in SCALARS
    ]
    for name in HISTORIES:
        for metric in HISTORY_METRICS:
            rows.append(
                MetricRow(
                    case_id, name, metric.name, reference_source, predicted_source, None, None, metric_unit(metric),
                    None, metric.error_type, None, None, None, None, None, judged[metric.name].criterion, None,
                    "cannot tell", CANNOT_TELL, status, note,
                )
            )  # fmt: skip
    return tuple(row.marked(assumed) for row in rows)


def empty_row(
    quantity: Quantity,
    reference: float | None,
    predicted: float | None,
    names: Names,
    judged: Tolerances,
    status: str,
    note: str,
) -> MetricRow:
    """Return the row of one scalar without an error, and why."""
    return MetricRow(
        names[0], quantity.name, "scalar", names[1], names[2], reference, predicted, quantity.unit, None,
        quantity.error_type, None, None, None, None, None, judged[quantity.name].criterion, None, "cannot tell",
        CANNOT_TELL, status, note,
    )  # fmt: skip


def scalar_row(
    quantity: Quantity,
    reference: float,
    predicted: float,
    scales: Mapping[str, float],
    names: Names,
    parts: Parts = UNKNOWN,
    judged: Tolerances | None = None,
) -> MetricRow:
    """Return the row of one scalar.

    Parameters
    ----------
    scales : mapping
        The reference's scalars, of which tolerances are shares.
    parts : Parts
        Standard uncertainties of predicted less reference, in the quantity's unit.
    """
    judged = judged if judged is not None else default_tolerances()
    own = judged[quantity.name]
    error, size = predicted - reference, 1.0
    if quantity.error_type == "relative":
        if reference == 0.0:
            note = "relative to a reference of zero"
            return empty_row(quantity, reference, predicted, names, judged, "undefined", note)
        size = abs(reference)
        error /= reference
        # the reference is in the denominator too: a relative error moves by u (1 + |E|)
        data = None if parts.data is None else parts.data * (1.0 + abs(error))
        parts = Parts(parts.numerical, parts.inputs, data)
        tolerance = own.value
    elif quantity.scale == "itself":
        tolerance = max(own.value * abs(reference), own.floor or 0.0)
    else:
        tolerance = own.value * _scale(quantity.scale, scales)
    parts = Parts(*(None if u is None else u / size for u in (parts.numerical, parts.inputs, parts.data)))
    return MetricRow(
        names[0], quantity.name, "scalar", names[1], names[2], reference, predicted, quantity.unit, error,
        quantity.error_type, parts.numerical, parts.inputs, parts.data, parts.expanded, tolerance, own.criterion,
        abs(error) <= tolerance, agreement(error, parts.expanded), assessment(error, tolerance, parts.expanded),
    )  # fmt: skip


def _scale(name: Scale, scales: Mapping[str, float]) -> float:
    return 1.0 if name == "one" else scales[name]
