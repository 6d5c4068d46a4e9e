"""The objective rating of ISO/TS 18571, by the package `objective-rating-metrics`."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...later import lazily

SAMPLES = 401
INTERVAL = 1e-4  # s: the standard's 10 kHz clock
WEIGHTS = (0.4, 0.2, 0.2, 0.2)
LEAST_SPREAD, ROUNDING = 1e-6, 1e-9  # of a piece that running sums tell of; of a correlation from those
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
    rating = _rating_class()(
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


def best_shift(reference: NDArray[np.float64], predicted: NDArray[np.float64], shifts: int) -> tuple[int, float]:
    """Return by how many samples the prediction correlates best with the reference, and that correlation.

    Shifts to the left count as positive, to the right as negative; `shifts` is the first that is not tried. As the
    standard has it, the least shift wins where two are equal, and the left one where these are equal too. Shifts that
    can be the best are found from running sums and one convolution; `numpy.corrcoef` of those decides.
    """
    n = reference.size
    a, b = reference - reference.mean(), predicted - predicted.mean()
    products = np.correlate(b, a, mode="full")
    k = np.arange(shifts)
    rough = np.full((shifts, 2), np.nan)
    for column, (first, last, product) in enumerate(((a, b, products[n - 1 + k]), (b, a, products[n - 1 - k]))):
        # all but the last k of one, all but the first k of the other
        sums = [(_running(first**power)[n - k], _running(last[::-1] ** power)[n - k]) for power in (1, 2)]
        (sum_f, sum_l), (square_f, square_l) = sums
        spread_f, spread_l = square_f - sum_f**2 / (n - k), square_l - sum_l**2 / (n - k)
        known = np.minimum(spread_f / square_f[0], spread_l / square_l[0]) > LEAST_SPREAD
        rough[known, column] = ((product - sum_f * sum_l / (n - k)) / np.sqrt(np.abs(spread_f * spread_l)))[known]
    shift, best = 0, float(np.corrcoef(reference, predicted)[0, 1])
    candidates = np.isnan(rough) | (rough >= max(np.nanmax(rough, initial=-1.0), best) - ROUNDING)
    for row, column in np.argwhere(candidates[1:]):
        moved = int(row) + 1
        pair = (reference[:-moved], predicted[moved:]) if column == 0 else (reference[moved:], predicted[:-moved])
        with np.errstate(divide="ignore", invalid="ignore"):  # a constant piece correlates with nothing
            found = float(np.corrcoef(*pair)[0, 1])
        if found > best:
            shift, best = (-moved if column else moved), found
    return shift, best


def _running(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the sums of the first 0, 1, ... n values."""
    return np.concatenate([[0.0], np.cumsum(values)])


@cache
def _rating_class() -> Any:
    """Return the package's rating, with the same result in a third of the time.

    Imported late: the compiled kernels of the package take 7 s where they cannot be kept. Its search for the best shift
    takes one `numpy.corrcoef` for each of 160 shifts; here only those are taken that can be the best one. Its window of
    the warping path and its steps are the same for every pair of one length.
    """
    with lazily("matplotlib.pyplot", "seaborn", "networkx"):  # they draw what is not drawn here; 1 s
        from dtwalign import backtrack, cost  # type: ignore[import-untyped]  # the package has no types
        from objective_rating_metrics import rating

    for kernel in (cost._calc_cumsum_matrix_jit, backtrack._get_local_path, backtrack._backtrack_jit):
        if not kernel.signatures:
            with contextlib.suppress(RuntimeError):  # nowhere to keep compiled code: compile each time
                kernel.enable_caching()
    rating.SakoechibaWindow = lru_cache(maxsize=8)(rating.SakoechibaWindow)

    class Rating(rating.ISO18571):  # type: ignore[misc]  # the package has no types
        def _get_shifted_curve_and_pr(self) -> tuple[NDArray[np.float64], NDArray[np.float64], int, float]:
            a, b = self.reference_curve, self.comparison_curve
            shift, correlation = best_shift(a[:, 1], b[:, 1], int(np.floor(len(b) * self._max_shift) + 1))
            if shift > 0:
                a, b = a[:-shift], b[shift:]
            elif shift < 0:
                a, b = a[-shift:], b[:shift]
            return b.copy(), a.copy(), abs(shift), correlation

    return Rating
