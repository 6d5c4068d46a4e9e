"""The verdict that a row's uncertainty allows."""

from __future__ import annotations

import math

from ..tables import Verdict

AGREES: Verdict = "agrees"
DISAGREES: Verdict = "disagrees"
CANNOT_TELL: Verdict = "cannot tell"


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
