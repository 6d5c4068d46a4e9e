"""Statistics of one quantity over all runs of a table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ..tables import Ensemble, MetricRow

NEGATIVE = ("peak_negative_tangential_force",)  # bias is that of the magnitude


@dataclass(frozen=True)
class BiasAndScatter:
    """Bias factor and relative scatters.

    Attributes
    ----------
    bias : float
        Factor by which the model exceeds the reference on average; 1 is none.
    model_scatter, total_scatter, reference_scatter : float
        sigma_M, u and sigma_E: standard deviations of ln(predicted/reference).
    """

    bias: float
    model_scatter: float
    total_scatter: float
    reference_scatter: float


def bias_and_scatter(
    reference: Sequence[float | None], predicted: Sequence[float | None], reference_scatter: float
) -> BiasAndScatter:
    """Return bias and scatter of predicted over reference values.

    Over ln(predicted/reference), mean m and standard deviation u (n - 1): sigma_M = sqrt(max(0, u^2 - sigma_E^2)),
    bias = exp(m + sigma_M^2/2 - sigma_E^2/2). McGrattan and Toman, Fire Mater. 35 (2011) 351-367; Fire Dynamics
    Simulator Technical Reference Guide vol. 3, NIST SP 1018-3.

    Raises
    ------
    InputError
        For fewer than two points and for any point that is missing or not positive: every point counts.
    """
    if len(reference) != len(predicted) or len(reference) < 2:
        raise InputError("bias", f"{len(reference)} and {len(predicted)} values", "two or more pairs")
    for index, pair in enumerate(zip(reference, predicted, strict=True)):
        for value in pair:
            if value is None or not math.isfinite(value) or value <= 0.0:
                raise InputError(f"bias: pair {index + 1}", value, "positive numbers: every point counts")
    ratios = np.log(np.asarray(predicted, dtype=float) / np.asarray(reference, dtype=float))
    total = float(np.std(ratios, ddof=1))
    model = math.sqrt(max(0.0, total**2 - reference_scatter**2))
    bias = math.exp(float(np.mean(ratios)) + 0.5 * model**2 - 0.5 * reference_scatter**2)
    return BiasAndScatter(bias, model, total, reference_scatter)


def summarise(group: str, rows: Sequence[MetricRow]) -> Ensemble:
    """Summarise the rows of one quantity, metric and pair of sources; missing ones are counted, never dropped.

    Mean and largest error mix units where small references were judged in newtons, so they are taken over the error
    type that most rows have and the note says how many were left to the other.
    """
    first = rows[0]
    compared = [row for row in rows if row.error is not None]
    kinds = sorted({row.error_type for row in compared}, key=lambda k: -sum(r.error_type == k for r in compared))
    kind = kinds[0] if kinds else first.error_type
    counted = [row for row in compared if row.error_type == kind]
    notes = []
    if len(counted) < len(compared):
        notes.append(f"{len(compared) - len(counted)} rows judged as another error type are not in mean and largest")
    if len(compared) < len(rows):
        notes.append(f"{len(rows) - len(compared)} of {len(rows)} runs cannot be compared")
    status = "current" if len(compared) == len(rows) else ("missing" if not compared else "incomplete")
    bias = None
    if compared and first.metric == "scalar" and kind == "relative":
        try:
            sign = -1.0 if first.quantity in NEGATIVE else 1.0
            bias = bias_and_scatter(
                [_times(sign, row.reference) for row in rows],
                [_times(sign, row.predicted) for row in rows],
                _reference_scatter(compared),
            )
        except InputError as error:
            notes.append(f"no bias: {error}")
    errors = [abs(row.error) for row in counted if row.error is not None]
    worst = max(counted, key=lambda row: abs(row.error or 0.0)) if counted else None
    return Ensemble(
        group=group,
        quantity=first.quantity,
        metric=first.metric,
        reference_source=first.reference_source,
        predicted_source=first.predicted_source,
        unit=first.unit if kind == "absolute" else "1",
        error_type=kind,
        cases=len(rows),
        compared=len(compared),
        passed=sum(bool(row.passed) for row in compared),
        mean_abs_error=float(np.mean(errors)) if errors else None,
        largest_abs_error=max(errors) if errors else None,
        largest_case_id=worst.case_id if worst is not None else "",
        bias=None if bias is None else bias.bias,
        model_scatter=None if bias is None else bias.model_scatter,
        total_scatter=None if bias is None else bias.total_scatter,
        reference_scatter=None if bias is None else bias.reference_scatter,
        status=status,
        note="; ".join(notes),
        assumed="; ".join(sorted({part for row in rows for part in row.assumed.split("; ") if part})),
    )


def _times(sign: float, value: float | None) -> float | None:
    return None if value is None else sign * value


def _reference_scatter(rows: Sequence[MetricRow]) -> float:
    """Return the references' relative uncertainty, root mean square; 0 where none is known."""
    known = [
        row.reference_uncertainty / (1.0 + abs(row.error))
        for row in rows
        if row.reference_uncertainty is not None and row.error is not None and row.error_type == "relative"
    ]
    return float(np.sqrt(np.mean(np.square(known)))) if known else 0.0
