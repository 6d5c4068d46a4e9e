"""What is left to compare of a history whose course is one of many: means, scatter, frequency."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...history import History
from .contact import contact_of

Array = NDArray[np.float64]

SMOOTH = 0.05
"""Share of the contact over which the course of T is averaged; what is left is its scatter."""
SAMPLES = 4000
LEAST_SCATTER = 0.002
"""Of the peak of N: below it scatter has no frequency. Passes that slide steadily stay below."""


@dataclass(frozen=True)
class Statistics:
    """Means over the contact, N, and what T does about its smoothed course.

    Attributes
    ----------
    scatter : float, N
        Root mean square of T less its running mean.
    frequency : float or None, Hz
        Upward passages of that through zero, per time; None where it hardly scatters.
    """

    mean_normal: float
    mean_tangential: float
    rms_tangential: float
    scatter: float
    frequency: float | None


def statistics(history: History) -> Statistics:
    """Return the statistics of a history that gives T; raises `InputError` for one without contact."""
    contact = contact_of(history)
    time = np.linspace(contact.start, contact.end, SAMPLES)
    tangential = np.interp(time, contact.time, contact.tangential)
    half = max(int(0.5 * SMOOTH * SAMPLES), 1)
    rest = (tangential - _running_mean(tangential, half))[half:-half]
    scatter = float(np.sqrt(np.mean(rest**2)))
    up = int(np.count_nonzero((rest[1:] > 0.0) & (rest[:-1] <= 0.0)))
    length = (1.0 - SMOOTH) * contact.duration
    return Statistics(
        mean_normal=float(np.trapezoid(contact.normal, contact.time)) / contact.duration,
        mean_tangential=float(np.mean(tangential)),
        rms_tangential=float(np.sqrt(np.mean(tangential**2))),
        scatter=scatter,
        frequency=up / length if scatter > LEAST_SCATTER * contact.peak else None,
    )


def _running_mean(values: Array, half: int) -> Array:
    """Return the mean over `half` values on either side; ends are not meant to be used."""
    width = 2 * half + 1
    return np.asarray(np.convolve(values, np.full(width, 1.0 / width), mode="same"), dtype=np.float64)
