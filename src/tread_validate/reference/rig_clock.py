"""Channels on one even clock: sampling checked, other clocks interpolated, gaps marked."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

UNEVEN = 0.01  # largest departure of a time step from the median, relative
LARGEST_TIME = 1e9  # s
MOST_MISSING = 0.5  # share of a record that gaps may take
ANGLES = ("wheel_angle_rad", "wheel_angle_deg")


class Clock(NamedTuple):
    """Sample k is at first + k step, s."""

    first: float
    step: float


def on_one_clock(
    values: dict[str, Array], clocks: dict[str, Clock], base: str, source: str
) -> tuple[float, Flags | None]:
    """Bring all channels to the clock of channel `base`, in place; return its step in s and where something is missing.

    Channels with another increment, offset or start are interpolated (angles unwrapped); where they do not reach, the
    record has a gap.
    """
    clock = clocks[base]
    size = values[base].size
    missing: Flags | None = None
    for name in list(values):
        own = clocks.get(name)
        if own is None:
            if values[name].size != size:
                found = f"{values[name].size} samples and no wf_increment"
                raise InputError(f"{source}: {name}", found, f"{size} samples, as in {base}, or a clock of its own")
            continue
        if own == clock and values[name].size == size:
            continue
        here = clock.first + clock.step * np.arange(size)
        there = own.first + own.step * np.arange(values[name].size)
        signal = np.unwrap(values[name]) if name in ANGLES else values[name]
        outside = (here < there[0] - 0.5 * own.step) | (here > there[-1] + 0.5 * own.step)
        if outside.mean() > MOST_MISSING:
            found = f"samples from {there[0]:g} to {there[-1]:g} s"
            raise InputError(f"{source}: {name}", found, f"the time of {base}, {here[0]:g} to {here[-1]:g} s")
        values[name] = np.interp(here, there, signal)
        missing = outside if missing is None else missing | outside
    return clock.step, missing if missing is not None and missing.any() else None


def from_times(values: dict[str, Array], time: Array, source: str, first_line: int) -> tuple[float, Flags | None]:
    """Check the times, (n,) s, fill gaps by straight lines, in place; return the step in s and where they are.

    A gap is a step of a whole number of samples, or a row without a number. Raises `InputError` for uneven sampling.
    """

    def where(row: int) -> str:
        return f"{source}:{first_line + row}: time_s"

    if not np.isfinite(time).all():
        raise InputError(where(int(np.argmin(np.isfinite(time)))), "an empty cell", "a time")
    if np.abs(time).max() > LARGEST_TIME:
        row = int(np.argmax(np.abs(time)))
        raise InputError(where(row), f"{time[row]:.6g} s", f"at most {LARGEST_TIME:g} s")
    steps = np.diff(time)
    step = float(np.median(steps))
    if step <= 0:
        row = int(np.argmax(steps <= 0))
        raise InputError(where(row + 1), f"a step of {steps[row]:.6g} s", "times that rise")
    slack = max(UNEVEN * step, 1.1 * _last_digit(time))  # rounded times may jitter by their last digit
    count = np.maximum(np.rint(steps / step), 1.0)
    wrong = np.abs(steps - count * step) > slack * np.maximum(count, 1.0) ** 0.5
    wrong |= steps <= 0
    if wrong.any():
        row = int(np.argmax(wrong))
        raise InputError(where(row + 1), f"a step of {steps[row]:.6g} s", f"even sampling, {step:.6g} s a sample")
    even = (time[-1] - time[0]) / count.sum()
    jumps = bool((count > 1).any())
    empty = np.zeros(time.size, dtype=np.bool_)
    for signal in values.values():
        empty |= np.isnan(signal)
    if not jumps and not empty.any():
        return float(even), None
    place = np.concatenate([[0], np.cumsum(count)]).astype(np.int64)
    size = int(place[-1]) + 1
    missing = np.ones(size, dtype=np.bool_)
    missing[place[~empty]] = False
    if missing.mean() > MOST_MISSING:
        raise InputError(
            source, f"gaps over {100 * missing.mean():.0f} % of the record", f"{100 * MOST_MISSING:g} % at most"
        )
    for name, signal in values.items():
        good = ~np.isnan(signal)
        kept = np.unwrap(signal[good]) if name in ANGLES else signal[good]
        values[name] = np.interp(np.arange(size), place[good], kept)
    return float(even), missing


def _last_digit(time: Array) -> float:
    """Return the resolution of rounded times, s; 0 where the samples fall on it anyway."""
    for digits in range(4, 10):
        if np.allclose(time[:50], np.round(time[:50], digits), rtol=0, atol=1e-12):
            steps = (time[: min(50, time.size)][-1] - time[0]) / (min(50, time.size) - 1) * 10.0**digits
            return 0.0 if abs(steps - round(steps)) < 1e-6 else float(10.0**-digits)
    return 0.0
