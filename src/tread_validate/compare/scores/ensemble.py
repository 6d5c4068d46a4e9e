"""Statistics of one quantity over all runs of a table."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import InputError
from ..tables import Ensemble, MetricRow

WITHOUT_BIAS = ("net_tangential_impulse", "late_sign_change", "slipping_share")  # of either sign, or zero
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

    Mean and largest error are over the rows that could be compared, all of one kind of error.
    """
    first = rows[0]
    compared = [row for row in rows if row.error is not None]
    kind = first.error_type if not compared else compared[0].error_type
    notes = []
    if len(compared) < len(rows):
        notes.append(f"{len(rows) - len(compared)} of {len(rows)} runs cannot be compared")
    status = "current" if len(compared) == len(rows) else ("missing" if not compared else "incomplete")
    bias = None
    if compared and first.metric == "scalar" and first.quantity not in WITHOUT_BIAS:
        try:
            sign = -1.0 if first.quantity in NEGATIVE else 1.0
            bias = bias_and_scatter(
                [_times(sign, row.reference) for row in rows],
                [_times(sign, row.predicted) for row in rows],
                _reference_scatter(compared),
            )
        except InputError as error:
            notes.append(f"no bias: {error}")
    if bias is not None and bias.model_scatter == 0.0 and bias.total_scatter > 0.0:
        notes.append(f"the scatter, {100 * bias.total_scatter:.2g} %, is within that of the reference")
    errors = [abs(row.error) for row in compared if row.error is not None]
    worst = max(compared, key=lambda row: abs(row.error or 0.0)) if compared else None
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
        adequate=sum(row.assessment == "adequate" for row in rows),
        inadequate=sum(row.assessment == "inadequate" for row in rows),
        agrees=sum(row.agreement == "agrees" for row in rows),
        criterion=first.criterion,
        mean_uncertainty=_mean([row.uncertainty for row in compared]),
        mean_abs_error=float(np.mean(errors)) if errors else None,
        largest_abs_error=max(errors) if errors else None,
        largest_case_id=worst.case_id if worst is not None else "",
        bias=None if bias is None else bias.bias,
        model_scatter=None if bias is None else bias.model_scatter,
        total_scatter=None if bias is None else bias.total_scatter,
        area_metric=_area(compared) if first.metric == "scalar" else None,
        reference_scatter=None if bias is None else bias.reference_scatter,
        status=status,
        note="; ".join(notes),
        assumed="; ".join(sorted({part for row in rows for part in row.assumed.split("; ") if part})),
    )


def _times(sign: float, value: float | None) -> float | None:
    return None if value is None else sign * value


def _reference_scatter(rows: Sequence[MetricRow]) -> float:
    """Return the references' relative standard uncertainty, root mean square; 0 where none is known."""
    known = []
    for row in rows:
        if row.u_data is not None and row.error is not None and row.reference:
            relative = row.error_type == "relative"
            known.append(row.u_data / (1.0 + abs(row.error)) if relative else row.u_data / abs(row.reference))
    return float(np.sqrt(np.mean(np.square(known)))) if known else 0.0


def _mean(values: Sequence[float | None]) -> float | None:
    known = [value for value in values if value is not None]
    return float(np.mean(known)) if known else None


def _area(rows: Sequence[MetricRow]) -> float | None:
    """Return the area between the distributions of predicted and reference values, over the mean |reference|.

    Ferson, Oberkampf and Ginzburg, Comput. Methods Appl. Mech. Eng. 197 (2008) 2408-2430,
    doi:10.1016/j.cma.2007.07.030: the Wasserstein distance of the two samples.
    """
    from scipy.stats import wasserstein_distance  # late: a quarter of a second

    pairs = [(row.reference, row.predicted) for row in rows if row.reference is not None and row.predicted is not None]
    scale = float(np.mean([abs(a) for a, _ in pairs])) if pairs else 0.0
    if scale == 0.0:
        return None
    return float(wasserstein_distance([a for a, _ in pairs], [b for _, b in pairs])) / scale
