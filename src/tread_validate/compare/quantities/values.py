"""How each scalar is computed from a contact, and what an uncertainty of the forces makes of it; SI."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from .contact import Contact

NEAR_PEAK = 1e-3  # of the peak: what counts as its flat top
SIGN_SHARE = 0.01  # a tangential force below this share of its largest magnitude has no sign
LATE_SHARE = 0.10  # the last part of the contact in which a change of sign is looked for

Compute = Callable[[Contact], float]
Spread = Callable[[float, str, Mapping[str, float]], float | None]


def peak_normal(contact: Contact) -> float:
    """Return the largest normal force, N."""
    return contact.peak


def peak_positive(contact: Contact) -> float:
    """Return the largest tangential force towards the leading edge, N; never below 0."""
    return max(float(contact.tangential.max()), 0.0)


def peak_negative(contact: Contact) -> float:
    """Return the largest tangential force towards the trailing edge, N; never above 0."""
    return min(float(contact.tangential.min()), 0.0)


def normal_impulse(contact: Contact) -> float:
    """Return the integral of N over the contact, N s."""
    return float(np.trapezoid(contact.normal, contact.time))


def net_tangential_impulse(contact: Contact) -> float:
    """Return the integral of T over the contact, N s."""
    return float(np.trapezoid(contact.tangential, contact.time))


def duration(contact: Contact) -> float:
    """Return the time from the first to the last passage of N through 1 % of its peak, s."""
    return contact.duration


def time_of_peak(contact: Contact) -> float:
    """Return the middle of the time in which N is within 0.1 % of its peak, s, on the history's clock.

    t = 0 at first contact. Which sample of a flat top is the largest is round-off, and differs between processors.
    """
    time, force = contact.history.time, contact.history.normal_force
    level = (1.0 - NEAR_PEAK) * float(force.max())
    above = np.flatnonzero(force >= level)
    first, last = int(above[0]), int(above[-1])
    begin, end = float(time[first]), float(time[last])
    if first > 0:
        begin = float(np.interp(level, force[first - 1 : first + 1], time[first - 1 : first + 1]))
    if last + 1 < time.size:
        end = float(np.interp(-level, -force[last : last + 2], time[last : last + 2]))
    return 0.5 * (begin + end)


def peak_ratio(contact: Contact) -> float:
    """Return the largest \\|T\\| over the largest N."""
    return max(peak_positive(contact), -peak_negative(contact)) / contact.peak


def late_sign_change(contact: Contact) -> float:
    """Return 1 where T changes sign in the last tenth of the contact, else 0.

    Values below 1 % of the largest \\|T\\| have no sign.
    """
    if np.isnan(contact.tangential).any():  # a history that does not give it
        return math.nan
    tail = contact.tangential[contact.time >= contact.end - LATE_SHARE * contact.duration]
    floor = SIGN_SHARE * max(peak_positive(contact), -peak_negative(contact))
    signs = np.sign(tail[np.abs(tail) > floor]) if floor > 0 else tail[:0]
    return float(signs.size > 1 and np.any(signs[1:] != signs[:-1]))


def slipping_share(contact: Contact) -> float:
    """Return the share of the touching area that slips, 0..1, averaged over the contact with N as weight.

    The share of the time in which anything slips would not do: a corner of one node is enough for it, and it falls
    with the mesh without end.
    """
    if np.isnan(contact.slipping).any():
        return math.nan
    return float(np.trapezoid(contact.slipping * contact.normal, contact.time)) / normal_impulse(contact)


# One number for the relative error of all forces moves forces and impulses alike. Each returns what it means for a
# scalar, in its unit, from that number, the scalar's name and the reference's scalars; None where it is not known.
def as_force(uncertainty: float, name: str, scalars: Mapping[str, float]) -> float | None:
    """Take the scalar as proportional to the forces."""
    return uncertainty * abs(scalars[name])


def as_difference(uncertainty: float, name: str, scalars: Mapping[str, float]) -> float | None:
    """Take the scalar as a difference of two impulses of the size of the ratio of forces times the normal one."""
    return uncertainty * scalars["tangential_to_normal_ratio"] * scalars["normal_impulse"]


def untouched(uncertainty: float, name: str, scalars: Mapping[str, float]) -> float | None:
    """Take the scalar as one that the size of the forces does not change."""
    return 0.0


def not_known(uncertainty: float, name: str, scalars: Mapping[str, float]) -> float | None:
    """Say nothing: the size of the forces tells nothing of this scalar."""
    return None
