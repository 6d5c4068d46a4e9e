"""Forces in axes fixed to the axle, from a load cell that turns with the wheel."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .rig_marks import revolution_marks
from .rig_record import RigRecord


def wheel_angles(record: RigRecord) -> NDArray[np.float64]:
    """Return the wheel's angle at every sample, (n,) rad: as measured, or even between triggers."""
    if record.wheel_angle is not None:
        return np.asarray(np.unwrap(record.wheel_angle), dtype=np.float64)
    marks = revolution_marks(record).times
    time = np.arange(record.normal_force.size) / record.sampling_rate
    turns = np.interp(time, marks, np.arange(marks.size))
    period = float(np.median(np.diff(marks)))
    turns = np.where(time < marks[0], (time - marks[0]) / period, turns)
    turns = np.where(time > marks[-1], marks.size - 1 + (time - marks[-1]) / period, turns)
    return np.asarray(2.0 * np.pi * turns, dtype=np.float64)


def axle_fixed(record: RigRecord, zero: float, direction: int = 1) -> RigRecord:
    """Return the record with its forces turned into axes fixed to the axle.

    The cell's own axes are the normal one, which points through the middle of the block, and the tangential one a
    quarter turn ahead of it in the sense of rising angle. At the wheel angle `zero` (rad) the normal axis points at the
    contact. With t = direction (angle - zero), N = N' cos t - T' sin t and T = N' sin t + T' cos t; `direction` is -1
    where the tangential axis points the other way. Drift of the cell turns too, so each of the cell's signals is first
    freed of its level over the free running, half a turn away from the contact, which may change from
    revolution to revolution.
    """
    if direction not in (1, -1):
        raise InputError("direction", direction, "1 or -1")
    angle = wheel_angles(record)
    turn = np.mod(angle - zero + np.pi, 2.0 * np.pi) - np.pi
    free = np.abs(turn) > 0.5 * np.pi
    normal = record.normal_force - _baseline(record.normal_force, free)
    tangential = record.tangential_force - _baseline(record.tangential_force, free)
    cosine, sine = np.cos(turn), direction * np.sin(turn)
    return replace(record, normal_force=normal * cosine - tangential * sine,
                   tangential_force=normal * sine + tangential * cosine)  # fmt: skip


def _baseline(signal: NDArray[np.float64], free: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return the level of the free running at every sample: the median of each stretch of it, straight in between."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], free, [False]]).astype(np.int8)))
    starts, ends = edges[::2], edges[1::2]
    levels = [float(np.median(signal[a:b])) for a, b in zip(starts, ends, strict=True)]
    return np.asarray(np.interp(np.arange(signal.size), 0.5 * (starts + ends), levels), dtype=np.float64)
