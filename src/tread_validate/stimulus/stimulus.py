"""Normal and tangential force of the whole patch: every block's history, at its own time, added up.

Blocks do not feel each other and the wheel turns steadily, so the patch force is periodic in one revolution:
F(t) = sum over blocks k and revolutions m of f_k(t - t_k - m T), with t_k = position / V and T = circumference / V.
Its Fourier coefficients are exact for histories that are linear between samples:
F_n = (1/T) sum over k of exp(-2 pi i n t_k / T) int f_k(t) exp(-2 pi i n t / T) dt.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..history import History
from .piecewise import integral, transform
from .pitch import PitchSequence, RibBlocks

LONGEST_STEP = 50e-6  # s, of the written time signal
OPEN_END = 0.05  # of the peak: above it a history has been cut off; corners of a mesh touch a little before t = 0
FORCES = ("normal_force", "tangential_force")


@dataclass(frozen=True)
class Stimulus:
    """The periodic force of the road on the tread, over one revolution.

    Attributes
    ----------
    label : str
        Which model the block histories come from.
    period : float, s
        One revolution.
    time : (n,) array, s
        0 <= t < period, uniform; t = 0 is when the block at the tyre's mark touches.
    normal_force, tangential_force : (n,) arrays, N
        Sums over all blocks in contact.
    frequency : (m,) array, Hz
        Multiples of the revolution's frequency, from 0.
    normal_lines, tangential_lines : (m,) complex arrays, N
        Fourier coefficients: F(t) = Re(F_0 + 2 sum F_n exp(2 pi i f_n t)).
    block_rates : mapping of rib name to Hz
        Block-passing frequency of each rib (mean, where pitches differ).
    impulses : mapping of rib name to (normal, tangential), N s
        Sum over the rib's blocks.
    """

    label: str
    period: float
    time: NDArray[np.float64]
    normal_force: NDArray[np.float64]
    tangential_force: NDArray[np.float64]
    frequency: NDArray[np.float64]
    normal_lines: NDArray[np.complex128]
    tangential_lines: NDArray[np.complex128]
    block_rates: Mapping[str, float]
    impulses: Mapping[str, tuple[float, float]]
    provenance: Mapping[str, str] = field(default_factory=dict)

    @property
    def mean_normal_force(self) -> float:
        """Mean over the revolution, N."""
        return float(self.normal_lines[0].real)

    @property
    def mean_tangential_force(self) -> float:
        """Mean over the revolution, N."""
        return float(self.tangential_lines[0].real)

    def block_passing(self) -> tuple[str, ...]:
        """Name, for every line, the ribs whose block-passing frequency (or which harmonic of it) it is."""
        marks = [""] * self.frequency.size
        for rib, rate in self.block_rates.items():
            blocks = round(rate * self.period)
            for harmonic, line in enumerate(range(blocks, self.frequency.size, blocks), start=1):
                marks[line] += ("; " if marks[line] else "") + f"{rib} x{harmonic}"
        return tuple(marks)


def amplitude(lines: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return peak amplitudes of the lines: the mean as it is, every other line twice its coefficient's modulus."""
    size = 2.0 * np.abs(lines)
    size[0] = abs(lines[0])
    return size


def superpose(
    sequence: PitchSequence,
    speed: float,
    history_of: Callable[[RibBlocks], History],
    *,
    label: str = "",
    highest_frequency: float = 1000.0,
    longest_step: float = LONGEST_STEP,
    provenance: Mapping[str, str] | None = None,
) -> Stimulus:
    """Add up the blocks of a pitch sequence.

    Parameters
    ----------
    sequence : PitchSequence
    speed : float, m/s
        Belt speed, > 0.
    history_of : function of a `RibBlocks` to a `History`
        The block's forces on a clock that begins at its first contact.
    highest_frequency : float, Hz
        Lines are given up to here.
    longest_step : float, s
        The time signal's step is the largest that divides the period and is not longer.

    Raises
    ------
    InputError
        A speed or frequency that is not positive, or a history that is cut off at either end.
    """
    for name, value in (("speed", speed), ("highest_frequency", highest_frequency), ("longest_step", longest_step)):
        if not (math.isfinite(value) and value > 0.0):
            raise InputError(f"stimulus: {name}", value, "a finite number > 0")
    period = sequence.circumference / speed
    samples = math.ceil(period / longest_step)
    time: NDArray[np.float64] = np.arange(samples, dtype=np.float64) * (period / samples)
    frequency = np.arange(math.floor(highest_frequency * period * (1.0 + 1e-12)) + 1) / period
    signal = np.zeros((2, samples))
    lines = np.zeros((2, frequency.size), dtype=np.complex128)
    impulses = {rib.name: (0.0, 0.0) for rib in sequence.ribs}
    for placement in sequence.placements():
        history = history_of(placement)
        check_whole(history)
        touch = np.asarray(placement.positions) / speed
        phases = _phase_sum(touch, frequency)
        rows = [history.normal_force, history.tangential_force]
        signal += _tiled(history.time, rows, touch, time, period)
        for row, force in enumerate(rows):
            lines[row] += transform(history.time, force, 2.0 * np.pi * frequency) * phases / period
        before = impulses[placement.rib]
        own = [len(touch) * integral(history.time, force) for force in rows]
        impulses[placement.rib] = (before[0] + own[0], before[1] + own[1])
    return Stimulus(
        label=label,
        period=period,
        time=time,
        normal_force=signal[0],
        tangential_force=signal[1],
        frequency=frequency,
        normal_lines=lines[0],
        tangential_lines=lines[1],
        block_rates={rib.name: sequence.blocks_on(rib) / period for rib in sequence.ribs},
        impulses=impulses,
        provenance=dict(provenance or {}),
    )


def check_whole(history: History) -> None:
    """Raise `InputError` for a history without contact, or with contact at its first or last sample."""
    peak = float(np.max(np.abs(history.normal_force)))
    name = history.provenance.get("case_id", "history")
    if peak == 0.0:
        raise InputError(f"{name}: normal_force", "0 N throughout", "a block that touches the road")
    for where, value in (("first", history.normal_force[0]), ("last", history.normal_force[-1])):
        if abs(value) > OPEN_END * peak:
            raise InputError(
                f"{name}: normal_force, {where} sample",
                f"{value:.4g} N",
                f"a whole pass: at most {OPEN_END:.0%} of the peak, {peak:.4g} N, at both ends",
            )


def _phase_sum(touch: NDArray[np.float64], frequency: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return sum over blocks of exp(-2 pi i f t_k)."""
    return np.array([np.exp(-2j * np.pi * f * touch).sum() for f in frequency])


def _tiled(
    own_time: NDArray[np.float64],
    forces: list[NDArray[np.float64]],
    touch: NDArray[np.float64],
    time: NDArray[np.float64],
    period: float,
) -> NDArray[np.float64]:
    """Return the sum of the shifted copies of each force at the times of one period."""
    total = np.zeros((len(forces), time.size))
    first, last = own_time[0], own_time[-1]
    step = period / time.size
    for start in touch:
        begin = math.ceil((start + first) / step)
        end = math.floor((start + last) / step)
        index = np.arange(begin, end + 1)  # grid points under this copy, before folding into the period
        own = index * step - start
        for row, force in enumerate(forces):
            np.add.at(total[row], index % time.size, np.interp(own, own_time, force, left=0.0, right=0.0))
    return total
