"""One block pass cut to its contact: what every scalar is computed from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...history import History

CONTACT_SHARE = 0.01  # in contact: normal force above this share of its peak

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Contact:
    """A history inside its contact, the two ends added as samples.

    Attributes
    ----------
    history : History
        The whole pass, on the clock whose zero is the first contact.
    start, end : float, s
        Passages of N through 1 % of its peak.
    time : (n,) array, s
    normal, tangential : (n,) arrays, N
    slipping : (n,) array, 0..1
        Share of the touching area that slips.
    """

    history: History
    start: float
    end: float
    time: Array
    normal: Array
    tangential: Array
    slipping: Array

    @property
    def duration(self) -> float:
        """Length of the contact, s."""
        return self.end - self.start

    @property
    def peak(self) -> float:
        """Largest normal force, N."""
        return float(self.history.normal_force.max())


def contact_of(history: History) -> Contact:
    """Cut a history to its contact; raises `InputError` for a history without contact."""
    start, end = contact_window(history)
    inside = history.time[(history.time > start) & (history.time < end)]
    time = np.concatenate([[start], inside, [end]])

    def at(values: Array) -> Array:
        return np.asarray(np.interp(time, history.time, values), dtype=np.float64)

    return Contact(
        history, start, end, time, at(history.normal_force), at(history.tangential_force), at(history.slipping_fraction)
    )


def contact_window(history: History) -> tuple[float, float]:
    """Return when contact begins and ends, s: passages of N through 1 % of its peak, linear between samples.

    Raises `InputError` where N is never positive, or where the history ends while the block still touches.
    """
    time, normal = history.time, history.normal_force
    peak = float(normal.max())
    if peak <= 0.0:
        raise InputError("history: normal_force", f"largest value {peak:g} N", "a contact: some value above 0")
    level = CONTACT_SHARE * peak
    above = np.flatnonzero(normal > level)
    first, last = int(above[0]), int(above[-1])
    if last == normal.size - 1 and normal[last] > 2.0 * level:
        raise InputError(
            "history: normal_force", f"{normal[last]:g} N at the last sample", "a pass that ends out of contact"
        )
    start = float(time[0]) if first == 0 else _crossing(time, normal, first - 1, level)
    end = float(time[-1]) if last == normal.size - 1 else _crossing(time, normal, last, level)
    return start, end


def _crossing(time: Array, values: Array, left: int, level: float) -> float:
    a, b = values[left], values[left + 1]
    return float(time[left] + (level - a) / (b - a) * (time[left + 1] - time[left]))
