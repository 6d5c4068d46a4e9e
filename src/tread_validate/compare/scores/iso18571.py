"""The objective rating of ISO/TS 18571, by the package `objective-rating-metrics`."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError

SAMPLES = 401
INTERVAL = 1e-4  # s: the standard's 10 kHz clock
WEIGHTS = (0.4, 0.2, 0.2, 0.2)
GRADES = ((0.94, "excellent"), (0.80, "good"), (0.58, "fair"))


@dataclass(frozen=True)
class IsoRating:
    """Scores from 0 to 1 and the grade of the overall one."""

    corridor: float
    phase: float
    magnitude: float
    slope: float

    @property
    def overall(self) -> float:
        """R = 0.4 Z + 0.2 (EP + EM + ES)."""
        parts = (self.corridor, self.phase, self.magnitude, self.slope)
        return float(sum(weight * part for weight, part in zip(WEIGHTS, parts, strict=True)))

    @property
    def grade(self) -> str:
        """Published grade: excellent above 0.94, good above 0.80, fair above 0.58, else poor."""
        return grade(self.overall)


def grade(score: float) -> str:
    """Return the standard's word for an overall score."""
    return next((name for least, name in GRADES if score > least), "poor")


def iso18571(reference: NDArray[np.float64], predicted: NDArray[np.float64]) -> IsoRating:
    """Rate `predicted` against `reference`, two (n,) arrays on one uniform clock that spans one block pass.

    The score is a matter of samples, not of seconds: the standard takes them as 10 kHz data and smooths slopes over
    9 of them. A pass lasts 6 to 30 ms, so 10 kHz would be 60 to 300 samples and the score would depend on the speed;
    every pass is therefore brought to `SAMPLES` samples, the length of a 40 ms record. Raises `InputError` for a
    constant history (it has no correlation) and for fewer than 21 samples.
    """
    if reference.size < 21:
        raise InputError("histories", f"{reference.size} samples", "at least 21 for the slope's moving average")
    for name, values in (("reference", reference), ("prediction", predicted)):
        if np.ptp(values) <= 1e-9 * max(float(np.max(np.abs(values))), 1.0):
            raise InputError(name, "a constant history", "one that varies: it has no correlation otherwise")
    clock = np.arange(reference.size) * INTERVAL
    rating = _iso_class()(
        reference_curve=np.column_stack([clock, reference]),
        comparison_curve=np.column_stack([clock, predicted]),
        dt=INTERVAL,
    )
    return IsoRating(
        corridor=float(rating.corridor_rating(-1)),
        phase=float(rating.phase_rating(-1)),
        magnitude=float(rating.magnitude_rating(-1)),
        slope=float(rating.slope_rating(-1)),
    )


@cache
def _iso_class() -> Any:
    """Import late: the package draws in a plotting library (2 s), and its kernels take 7 s to compile each time."""
    from dtwalign import backtrack, cost  # type: ignore[import-untyped]  # the package has no types
    from objective_rating_metrics.rating import ISO18571

    for kernel in (cost._calc_cumsum_matrix_jit, backtrack._get_local_path, backtrack._backtrack_jit):
        if not kernel.signatures:
            with contextlib.suppress(RuntimeError):  # nowhere to keep compiled code: compile each time
                kernel.enable_caching()
    return ISO18571
