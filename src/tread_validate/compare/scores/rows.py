"""One comparison, one row; and the verdict that a row's uncertainty allows."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal

from ..quantities import ErrorType

Verdict = Literal["agrees", "disagrees", "cannot tell"]
AGREES: Verdict = "agrees"
DISAGREES: Verdict = "disagrees"
CANNOT_TELL: Verdict = "cannot tell"

METRIC_COLUMNS = (
    "case_id", "quantity", "metric", "reference_source", "predicted_source", "reference", "predicted", "unit", "error",
    "error_type", "reference_uncertainty", "tolerance", "passed", "verdict", "status", "note", "assumed",
)  # fmt: skip


@dataclass(frozen=True)
class MetricRow:
    """One declared comparison.

    Attributes
    ----------
    reference, predicted : float or None
        In `unit`. For a history score: ``relative_rms``: largest \\|reference\\| and RMSE;
        ``sprague_geers_*``: the two root mean squares; ``iso18571_*``: 1 and the score.
    error : float or None
        Signed; (predicted - reference)/reference, or predicted - reference in `unit`, or score - 1.
    reference_uncertainty : float or None
        What the reference's uncertainty makes of the error, in the error's unit; None where it is not known.
    tolerance : float
        Largest \\|error\\| that passes.
    passed : bool or None
        \\|error\\| <= tolerance; None where there is no error.
    verdict : str
        ``agrees``: the error passes whatever the reference's uncertainty makes of it; ``disagrees``: it fails
        whatever; ``cannot tell``: in between, or the uncertainty is not known, or there is no error.
    status : str
        ``current``, ``missing``, ``stale``, ``corrupt``, ``no_contact`` or ``undefined``.
    """

    case_id: str
    quantity: str
    metric: str
    reference_source: str
    predicted_source: str
    reference: float | None
    predicted: float | None
    unit: str
    error: float | None
    error_type: ErrorType
    reference_uncertainty: float | None
    tolerance: float | None
    passed: bool | None
    verdict: Verdict
    status: str = "current"
    note: str = ""
    assumed: str = ""

    def marked(self, assumed: str) -> MetricRow:
        """Return the row with the assumed and synthetic inputs it rests on."""
        return replace(self, assumed=assumed)


def verdict(error: float | None, tolerance: float | None, uncertainty: float | None) -> Verdict:
    """Judge an error that the reference's uncertainty may have moved by up to `uncertainty` either way."""
    if error is None or tolerance is None or uncertainty is None:
        return CANNOT_TELL
    if not (math.isfinite(error) and math.isfinite(tolerance) and math.isfinite(uncertainty)):
        return CANNOT_TELL
    if abs(error) + uncertainty <= tolerance:
        return AGREES
    if abs(error) - uncertainty > tolerance:
        return DISAGREES
    return CANNOT_TELL
