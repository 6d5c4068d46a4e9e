"""Putting two histories on one clock, without shifting either."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...history import History
from ..quantities import contact_window

SAMPLES = 2001


@dataclass(frozen=True)
class AlignedPair:
    """Two histories on a common, uniform clock over the union of both contacts.

    Attributes
    ----------
    time : (n,) array, s
    reference_normal, predicted_normal, reference_tangential, predicted_tangential : (n,) arrays, N
    """

    time: NDArray[np.float64]
    reference_normal: NDArray[np.float64]
    predicted_normal: NDArray[np.float64]
    reference_tangential: NDArray[np.float64]
    predicted_tangential: NDArray[np.float64]

    def forces(self, quantity: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return reference and prediction of ``normal_force`` or ``tangential_force``."""
        if quantity == "normal_force":
            return self.reference_normal, self.predicted_normal
        return self.reference_tangential, self.predicted_tangential


def window(reference: History, predicted: History) -> tuple[float, float]:
    """Return the union of both contacts, s.

    Raises `InputError` for a history without contact and for two contacts that do not overlap: then the clocks
    differ (another zero or another unit), and no score of the pair means anything.
    """
    a = contact_window(reference)
    b = contact_window(predicted)
    if a[1] <= b[0] or b[1] <= a[0]:
        raise InputError(
            "histories: time",
            f"contact {a[0]:.6g}..{a[1]:.6g} s in the reference, {b[0]:.6g}..{b[1]:.6g} s in the prediction",
            "contacts that overlap on one clock",
        )
    return min(a[0], b[0]), max(a[1], b[1])


def align(
    reference: History,
    predicted: History,
    samples: int = SAMPLES,
    limits: tuple[float, float] | None = None,
) -> AlignedPair:
    """Resample both histories linearly to `samples` uniform times over `limits` (default: the union of contacts).

    Outside its own record a history is out of contact, so its forces are 0 there; `window` has made sure that no
    record ends in contact.
    """
    start, end = window(reference, predicted) if limits is None else limits
    time = np.linspace(start, end, samples)

    def resampled(history: History, values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.interp(time, history.time, values, left=0.0, right=0.0)

    return AlignedPair(
        time,
        resampled(reference, reference.normal_force),
        resampled(predicted, predicted.normal_force),
        resampled(reference, reference.tangential_force),
        resampled(predicted, predicted.tangential_force),
    )
