"""What is compared, in which unit, and how large an error still passes.

The tolerances are this workbench's own: the paper prints none for the spring model. Ten per cent is what the paper
reports for the linear material model (section 2.3) and for its better FE comparison (18 and 10 %); everything else
follows from it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

ErrorType = Literal["relative", "absolute", "score"]
Scale = Literal["itself", "peak_normal_force", "normal_impulse", "contact_duration", "one"]

FORCE_TOLERANCE = 0.10
SMALL_SHARE = 0.20  # a tangential force below this share of the peak normal force is judged in newtons


@dataclass(frozen=True)
class Quantity:
    """One scalar of a run.

    Attributes
    ----------
    name, unit : str
        Name without unit; SI unit, ``1`` for a pure number.
    scale : str
        What the tolerance is a share of. ``itself``: the error is relative to the reference. Otherwise the error is
        absolute and the tolerance is `tolerance` times that scalar of the reference (``one``: times 1).
    tolerance : float
        Largest error that passes, as a share of the scale.
    small : str or None
        Scalar of the reference against which a reference value counts as small (below `SMALL_SHARE` of it) and is
        judged absolutely, with `SMALL_SHARE` times the tolerance of that scalar: the two rules meet without a jump.
    """

    name: str
    unit: str
    scale: Scale
    tolerance: float
    small: Scale | None = None

    @property
    def column(self) -> str:
        """Name with its unit, as the tables' headers have it."""
        return f"{self.name}_{self.unit.replace(' ', '_')}" if self.unit != "1" else self.name


SCALARS = (
    Quantity("peak_normal_force", "N", "itself", FORCE_TOLERANCE),
    Quantity("peak_positive_tangential_force", "N", "itself", FORCE_TOLERANCE, small="peak_normal_force"),
    Quantity("peak_negative_tangential_force", "N", "itself", FORCE_TOLERANCE, small="peak_normal_force"),
    Quantity("normal_impulse", "N s", "itself", FORCE_TOLERANCE),
    Quantity("net_tangential_impulse", "N s", "normal_impulse", FORCE_TOLERANCE * SMALL_SHARE),
    Quantity("contact_duration", "s", "itself", 0.05),
    Quantity("time_of_peak_normal_force", "s", "contact_duration", 0.05),
    Quantity("tangential_to_normal_ratio", "1", "itself", FORCE_TOLERANCE, small="one"),
    Quantity("late_sign_change", "1", "one", 0.5),
    Quantity("slipping_share", "1", "one", 0.10),
)
SCALAR = {quantity.name: quantity for quantity in SCALARS}

HISTORIES = ("normal_force", "tangential_force")


@dataclass(frozen=True)
class HistoryMetric:
    """One score of a pair of histories: how its error is expressed and what passes."""

    name: str
    error_type: ErrorType
    tolerance: float
    sensitivity: float


# sensitivity: largest change of the score per unit of relative amplitude error of the reference, to first order.
# ISO/TS 18571, x the difference and e the error sums over the reference: corridor 2 (1 + x)/(0.5 - 0.05) at x = 0.05,
# magnitude 2 (1 + e) at e = 0.5, slope (1 + e)/2 at e = 2, weighted 0.4, 0.2, 0.2; phase does not depend on amplitude.
HISTORY_METRICS = (
    HistoryMetric("relative_rms", "relative", FORCE_TOLERANCE, 1.0),
    HistoryMetric("sprague_geers_m", "relative", FORCE_TOLERANCE, 1.0),
    HistoryMetric("sprague_geers_p", "relative", 0.05, 0.0),
    HistoryMetric("sprague_geers_c", "relative", FORCE_TOLERANCE, 1.0),
    HistoryMetric("iso18571_r", "score", 0.20, 0.4 * 2.1 / 0.45 + 0.2 * 3.0 + 0.2 * 1.5),
    HistoryMetric("iso18571_corridor", "score", 0.20, 2.1 / 0.45),
    HistoryMetric("iso18571_phase", "score", 0.20, 0.0),
    HistoryMetric("iso18571_magnitude", "score", 0.20, 3.0),
    HistoryMetric("iso18571_slope", "score", 0.20, 1.5),
)
HISTORY_METRIC = {metric.name: metric for metric in HISTORY_METRICS}
