"""Amplitudes: tables of a factor against time, and their exact integrals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..inp import KeywordBlock
from ..inp.amplitude import amplitude_table
from ..kernels import kernel

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Amplitude:
    """A factor as a function of time; constant outside the table.

    Attributes
    ----------
    times, values : (n,)
    smooth : bool
        Whether each piece is the fifth-order smooth step; else linear.
    total_time : bool
        Whether the clock is the total time; else the step's.
    """

    name: str
    times: Floats
    values: Floats
    smooth: bool
    total_time: bool

    def integrals(self) -> Floats:
        """Return the integral from the first time to each time; both shapes have the mean of their ends."""
        pieces = 0.5 * (self.values[1:] + self.values[:-1]) * np.diff(self.times)
        return np.concatenate([[0.0], np.cumsum(pieces)])


def read_amplitudes(blocks: list[KeywordBlock]) -> dict[str, Amplitude]:
    """Read the amplitudes: pairs time, value, up to four a line.

    Raises
    ------
    InputError
        No pairs, or times that do not increase.
    """
    amplitudes: dict[str, Amplitude] = {}
    for block in blocks:
        if block.keyword != "AMPLITUDE":
            continue
        pairs = amplitude_table(block)
        name = block.value("NAME")
        if name in amplitudes:
            raise InputError(block.where, f"amplitude {name} twice", "each amplitude once")
        smooth = block.parameters.get("DEFINITION") == "SMOOTH STEP"
        total = block.parameters.get("TIME") == "TOTAL TIME"
        amplitudes[name] = Amplitude(name, pairs[:, 0].copy(), pairs[:, 1].copy(), smooth, total)
    return amplitudes


@kernel()
def amplitude_at(times, values, integrals, first, last, smooth, guess, t):  # type: ignore[no-untyped-def]  # numba types it
    """Return (value, integral from the first time, piece) of the amplitude in rows `first`..`last`-1 at time `t`.

    `guess` is the piece of the call before; time only moves on.
    """
    if t <= times[first]:
        return values[first], (t - times[first]) * values[first], first
    if t >= times[last - 1]:
        return values[last - 1], integrals[last - 1] + (t - times[last - 1]) * values[last - 1], last - 1
    row = guess if first <= guess < last - 1 and times[guess] <= t else first
    while times[row + 1] < t:
        row += 1
    width = times[row + 1] - times[row]
    x = (t - times[row]) / width
    rise = values[row + 1] - values[row]
    if smooth:
        x3 = x * x * x
        value = values[row] + rise * x3 * (10.0 - 15.0 * x + 6.0 * x * x)
        area = values[row] * x + rise * x3 * x * (2.5 - 3.0 * x + x * x)
    else:
        value = values[row] + rise * x
        area = (values[row] + 0.5 * rise * x) * x
    return value, integrals[row] + area * width, row
