"""When each revolution starts: triggers, with missed and false ones told, or the wheel's angle."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .rig_record import RigRecord

Array = NDArray[np.float64]

LEAST_PULSE = 0.2  # V
FALSE = 0.5  # of a revolution: a trigger sooner than this after another is false
LIKE = 0.2  # departure of a revolution from the usual duration, relative, with which it counts as one


class RevolutionMarks(NamedTuple):
    """Times in s at which revolutions start, and how many triggers were missed and false."""

    times: Array
    missed: int
    false: int


def revolution_marks(record: RigRecord) -> RevolutionMarks:
    """Return the marks, to a fraction of a sample.

    Raises `InputError` for a trigger without pulses and for fewer than two whole revolutions.
    """
    if record.trigger is None:
        return RevolutionMarks(_by_angle(record), 0, 0)
    found = _by_trigger(record.trigger, record.sampling_rate, record.source)
    if found.size < 3:
        raise InputError(record.source, f"{found.size} trigger(s)", "at least 3: two whole revolutions")
    usual = float(np.median(np.diff(found)))
    kept = [float(found[0])]
    missed = false = 0
    for time in found[1:].tolist():
        turns = (time - kept[-1]) / usual
        whole = round(turns)
        if turns < FALSE:
            false += 1
            continue
        if whole >= 2 and abs(turns / whole - 1.0) < LIKE / whole:
            missed += whole - 1
            before = kept[-1]
            kept += [before + (time - before) * k / whole for k in range(1, whole)]
        kept.append(time)
    if len(kept) < 3:
        raise InputError(record.source, f"{len(kept)} trigger(s)", "at least 3: two whole revolutions")
    return RevolutionMarks(np.array(kept), missed, false)


def _by_trigger(trigger: Array, rate: float, source: str) -> Array:
    low, high = float(trigger.min()), float(trigger.max())
    middle, tenth = 0.5 * (low + high), 0.1 * (high - low)
    if high - low < LEAST_PULSE:
        raise InputError(source, f"a trigger between {low:.3g} and {high:.3g} V", f"pulses of {LEAST_PULSE} V or more")
    # above the middle, or a tenth below it; in between whatever it was before: noise on a flank counts once
    up, down = trigger >= middle, trigger < middle - tenth
    known = np.flatnonzero(up | down)
    state = up[known]
    turned = np.flatnonzero(~state[:-1] & state[1:])
    after = known[turned + 1]
    rises = after - 1
    first, last = trigger[rises], trigger[after]
    return np.asarray((rises + (middle - first) / (last - first)) / rate, dtype=np.float64)


def _by_angle(record: RigRecord) -> Array:
    assert record.wheel_angle is not None
    angle = np.unwrap(record.wheel_angle)
    if angle[-1] < angle[0]:
        angle = -angle
    whole = np.arange(np.ceil(angle[0] / (2 * np.pi)), np.floor(angle[-1] / (2 * np.pi)) + 1) * 2 * np.pi
    found = np.interp(whole, np.maximum.accumulate(angle), np.arange(angle.size)) / record.sampling_rate
    if found.size < 3:
        raise InputError(record.source, f"{found.size} whole turn(s) of the wheel", "at least 2 revolutions")
    return np.asarray(found, dtype=np.float64)
