"""What an error and its uncertainty allow to be said, after ASME V&V 20.

Comparison error E = S - D of a simulation S and its reference D; u_val, its standard uncertainty, from the model's
numerical errors, the spread of its inputs and the uncertainty of the reference. Two questions, two answers:

- Do the two agree? |E| <= k u_val: whatever model error there is, it is not told from the uncertainty.
- Is the model good enough for the stated purpose? |E| + k u_val <= tolerance, and not if |E| - k u_val > tolerance.

ASME V&V 20-2009; the 95 % interval of a standard uncertainty that is taken as normal has k = 2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..tables import Agreement, Assessment

ADEQUATE: Assessment = "adequate"
INADEQUATE: Assessment = "inadequate"
CANNOT_TELL: Assessment = "cannot tell"
COVERAGE = 2.0


@dataclass(frozen=True)
class Parts:
    """Standard uncertainties of a comparison error, in its unit; None where one is not known."""

    numerical: float | None
    inputs: float | None
    data: float | None

    @property
    def expanded(self) -> float | None:
        """k u_val; None where a part is not known."""
        if self.numerical is None or self.inputs is None or self.data is None:
            return None
        return COVERAGE * math.hypot(self.numerical, self.inputs, self.data)


UNKNOWN = Parts(None, None, None)


def assessment(error: float | None, tolerance: float | None, uncertainty: float | None) -> Assessment:
    """Say whether the error is good enough whatever the expanded uncertainty makes of it."""
    if error is None or tolerance is None or uncertainty is None:
        return CANNOT_TELL
    if not (math.isfinite(error) and math.isfinite(tolerance) and math.isfinite(uncertainty)):
        return CANNOT_TELL
    if abs(error) + uncertainty <= tolerance:
        return ADEQUATE
    if abs(error) - uncertainty > tolerance:
        return INADEQUATE
    return CANNOT_TELL


def agreement(error: float | None, uncertainty: float | None) -> Agreement:
    """Say whether the error is within the expanded uncertainty."""
    if error is None or uncertainty is None or not (math.isfinite(error) and math.isfinite(uncertainty)):
        return "cannot tell"
    return "agrees" if abs(error) <= uncertainty else "differs"
