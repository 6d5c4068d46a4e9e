"""Numbers that sum up one block pass."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...history import History

CONTACT_SHARE = 0.01  # in contact: normal force above this share of its peak
SIGN_SHARE = 0.01  # a tangential force below this share of its largest magnitude has no sign
SLIP_FLOOR = 0.01  # the block slips where more than this share of its touching area does
LATE_SHARE = 0.10  # the last part of the contact in which a change of sign is looked for


@dataclass(frozen=True)
class Scalars:
    """Scalars of one run, SI.

    Attributes
    ----------
    peak_normal_force : float, N
    peak_positive_tangential_force, peak_negative_tangential_force : float, N
        Largest and smallest tangential force; never below, never above 0.
    normal_impulse, net_tangential_impulse : float, N s
        Integrals of N and T over the contact.
    contact_duration : float, s
        Time from the first to the last passage of N through 1 % of its peak.
    time_of_peak_normal_force : float, s
        On the history's clock (t = 0 at first touch).
    tangential_to_normal_ratio : float
        Largest \\|T\\| over largest N.
    late_sign_change : float
        1 where T changes sign in the last tenth of the contact, else 0; values below 1 % of the largest \\|T\\| have no
        sign.
    slipping_share : float, 0..1
        Share of the contact duration in which more than 1 % of the touching area slips.
    """

    peak_normal_force: float
    peak_positive_tangential_force: float
    peak_negative_tangential_force: float
    normal_impulse: float
    net_tangential_impulse: float
    contact_duration: float
    time_of_peak_normal_force: float
    tangential_to_normal_ratio: float
    late_sign_change: float
    slipping_share: float

    def as_dict(self) -> dict[str, float]:
        """Return the scalars by name."""
        return {item.name: float(getattr(self, item.name)) for item in fields(self)}


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


def scalars(history: History) -> Scalars:
    """Return the scalars of one run; raises `InputError` for a history without contact."""
    start, end = contact_window(history)
    time = _grid(history.time, start, end)
    normal = np.interp(time, history.time, history.normal_force)
    tangential = np.interp(time, history.time, history.tangential_force)
    slipping = np.interp(time, history.time, history.slipping_fraction) > SLIP_FLOOR
    highest = int(np.argmax(history.normal_force))
    peak = float(history.normal_force[highest])
    positive = max(float(tangential.max()), 0.0)
    negative = min(float(tangential.min()), 0.0)
    slip_time = np.sum(np.diff(time) * 0.5 * (slipping[1:].astype(float) + slipping[:-1].astype(float)))
    return Scalars(
        peak_normal_force=peak,
        peak_positive_tangential_force=positive,
        peak_negative_tangential_force=negative,
        normal_impulse=float(np.trapezoid(normal, time)),
        net_tangential_impulse=float(np.trapezoid(tangential, time)),
        contact_duration=end - start,
        time_of_peak_normal_force=float(history.time[highest]),
        tangential_to_normal_ratio=max(positive, -negative) / peak,
        late_sign_change=float(_changes_sign(tangential[time >= end - LATE_SHARE * (end - start)], positive, negative)),
        slipping_share=float(slip_time / (end - start)),
    )


def _crossing(time: NDArray[np.float64], values: NDArray[np.float64], left: int, level: float) -> float:
    a, b = values[left], values[left + 1]
    return float(time[left] + (level - a) / (b - a) * (time[left + 1] - time[left]))


def _grid(time: NDArray[np.float64], start: float, end: float) -> NDArray[np.float64]:
    """Return the samples inside the window with its two ends added."""
    inside = time[(time > start) & (time < end)]
    return np.concatenate([[start], inside, [end]])


def _changes_sign(tail: NDArray[np.float64], positive: float, negative: float) -> bool:
    floor = SIGN_SHARE * max(positive, -negative)
    signs = np.sign(tail[np.abs(tail) > floor]) if floor > 0 else tail[:0]
    return bool(signs.size > 1 and np.any(signs[1:] != signs[:-1]))
