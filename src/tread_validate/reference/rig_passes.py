"""From a rig record to passes: cut at the trigger, drift removed, low-pass without phase shift, mean and spread."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from ..errors import InputError
from ..units import RPM
from .rig_marks import revolution_marks
from .rig_record import RigRecord

Array = NDArray[np.float64]

CUTOFF = 1000.0  # Hz
ORDER = 4
MOST_FOR_SHAPE = 400  # revolutions that tell where the contact is
CONTACT = 0.05  # of the peak: above it the block is in contact, when the baseline is looked for
ONSET = 0.03, 0.3  # of the mean peak: the part of the rise that first contact is extrapolated from
NOISE_LIMIT = 5.0  # standard deviations of the free running
MARGIN = 0.5  # of the contact's duration, kept before and after it
LARGEST_SPEED_CHANGE = 0.2
TOUCHED = 0.5  # of the usual peak: a pass with less has missed the road


@dataclass(frozen=True)
class Spread:
    """Mean, least and largest over the passes, and their sample standard deviation, N."""

    mean: float
    least: float
    largest: float
    deviation: float


@dataclass(frozen=True)
class RigPasses:
    """The passes of one record on one clock.

    Attributes
    ----------
    time : (n,) array, s
        0 at first contact, extrapolated from the rise of the mean normal force.
    normal_force, tangential_force : (passes, n) arrays, N
        Filtered, drift removed; tangential as recorded in sign.
    peak_normal_force, largest_tangential_force, least_tangential_force : Spread
        Of the passes' own extremes: the error bars.
    rotational_speed : float, rad/s
        Of the small wheel, from the triggers.
    speed_change : float
        Largest departure of a revolution's duration from their mean, relative.
    cutoff : float, Hz
        Where the filter, run forth and back, halves the power.
    noise : float, N
        Standard deviation of the normal force while running free, after filtering.
    drift : float, N
        Range of the baseline that was taken off the normal force.
    raw_time, raw_normal_force : (m,) arrays
        First pass as recorded, on the same clock, for a picture.
    missed_triggers, false_triggers : int
        Put in between their neighbours; left out.
    passes_in_gaps, passes_without_contact : int
        Left out.
    """

    time: Array
    normal_force: Array
    tangential_force: Array
    peak_normal_force: Spread
    largest_tangential_force: Spread
    least_tangential_force: Spread
    rotational_speed: float
    speed_change: float
    cutoff: float
    noise: float
    drift: float
    contact_duration: float
    raw_time: Array
    raw_normal_force: Array
    source: str
    missed_triggers: int = 0
    false_triggers: int = 0
    passes_in_gaps: int = 0
    passes_without_contact: int = 0

    def half_width(self, spread: Spread, calibration: float = 0.0) -> float:
        """Return the 95 % half-width in N of a mean peak: scatter of the passes (Student), noise, cell.

        `calibration` is the cell's own 95 % half-width, relative. The noise counts once, as a peak picked from noise
        lies too high by up to about its deviation.
        """
        scatter = float(stdtrit(self.count - 1, 0.975)) * spread.deviation / np.sqrt(self.count)
        return float(np.sqrt(scatter**2 + self.noise**2 + (calibration * spread.mean) ** 2))

    @property
    def count(self) -> int:
        """Number of passes."""
        return int(self.normal_force.shape[0])

    @property
    def speed_rpm(self) -> float:
        """Rotational speed of the small wheel, 1/min."""
        return self.rotational_speed / RPM


def low_pass(signal: Array, sampling_rate: float, cutoff: float, order: int = ORDER) -> Array:
    """Return `signal` filtered by a Butterworth filter forth and back: no phase shift.

    Both ways together the power is halved (-3 dB) at `cutoff` in Hz; the single filter's corner is moved up for that.
    """
    from scipy.signal import butter, sosfiltfilt  # late: takes half a second

    bent = np.tan(np.pi * cutoff / sampling_rate) / (np.sqrt(2.0) - 1.0) ** (1.0 / (2 * order))
    corner = sampling_rate * np.arctan(bent) / np.pi  # the digital filter bends the frequency axis
    sections = butter(order, corner, fs=sampling_rate, output="sos")
    return np.asarray(sosfiltfilt(sections, signal), dtype=np.float64)


def cut_passes(record: RigRecord, cutoff: float = CUTOFF, order: int = ORDER) -> RigPasses:
    """Cut a record into passes, one a revolution, and put them on one clock.

    Revolutions are counted from trigger to trigger and cut half a revolution away from the contact; each is stretched
    to the mean duration, so that small changes of speed do not blur the mean. From each pass the straight line through
    its free running is taken off.

    Raises `InputError` for a record without a trigger or with fewer than two whole passes, a cut-off that the sampling
    cannot carry, a contact lost in noise, or a speed that changes by more than 20 %.
    """
    if not 0 < cutoff < 0.4 * record.sampling_rate:
        raise InputError("cut-off", f"{cutoff:g} Hz", f"0 to {0.4 * record.sampling_rate:g} Hz for this sampling rate")
    marks, missed_triggers, false_triggers = revolution_marks(record)
    periods = np.diff(marks)
    period = float(periods.mean())
    change = float(np.max(np.abs(periods / period - 1.0)))
    if change > LARGEST_SPEED_CHANGE:
        raise InputError(record.source, f"a speed that changes by {100 * change:.0f} %", "a steady speed")
    normal = low_pass(record.normal_force, record.sampling_rate, cutoff, order)
    samples = int(np.floor(period * record.sampling_rate))
    phase = np.arange(samples) / samples
    shape = np.median(_fold(normal, marks[:MOST_FOR_SHAPE], phase, record.sampling_rate), axis=0)
    shape = shape - np.median(shape)
    centre = phase[int(np.argmax(shape))]
    # cut half a revolution from the contact
    places = np.arange(marks.size) + centre - 0.5
    starts = np.interp(places, np.arange(marks.size), marks, left=np.nan, right=np.nan)
    starts = starts[np.isfinite(starts)]
    starts = starts[starts >= 0]
    if starts.size < 3:
        raise InputError(record.source, f"{max(starts.size - 1, 0)} whole pass(es)", "at least 2")
    whole = _without_gaps(record, starts)
    n_turns = _chosen(_fold(normal, starts, phase, record.sampling_rate), whole)
    size = normal.size
    del normal  # a record of ten million samples is to fit into 1 GB
    touched = _touched(n_turns)
    n_turns = _chosen(n_turns, touched)
    tangential = low_pass(record.tangential_force, record.sampling_rate, cutoff, order)
    t_turns = _chosen(_chosen(_fold(tangential, starts, phase, record.sampling_rate), whole), touched)
    del tangential
    if n_turns.shape[0] < 2:
        found = f"{n_turns.shape[0]} pass(es) without a gap and with a contact"
        raise InputError(record.source, found, "at least 2")
    contact = _contact(n_turns, cutoff, period, record.source)
    n_level, drift = _free_of_drift(n_turns, phase, contact)
    t_level, _ = _free_of_drift(t_turns, phase, contact)
    noise = float(np.std(n_level[:, ~contact]))
    mean = n_level.mean(axis=0)
    if mean.max() < NOISE_LIMIT * noise:
        raise InputError(record.source, f"a peak of {mean.max():.3g} N in noise of {noise:.3g} N", "a contact above it")
    touch, leave = _touch(mean, phase * period)
    time = phase * period - touch
    duration = leave - touch
    kept = (time > -MARGIN * duration) & (time < (1.0 + MARGIN) * duration)
    first, last = (np.clip(np.array([starts[0], starts[1]]) * record.sampling_rate, 0, size)).astype(int)
    raw = np.arange(first, last) / record.sampling_rate - starts[0]
    raw = raw * period / (starts[1] - starts[0]) - touch
    shown = (raw > -MARGIN * duration) & (raw < (1.0 + MARGIN) * duration)
    return RigPasses(
        time=time[kept],
        normal_force=n_level[:, kept],
        tangential_force=t_level[:, kept],
        peak_normal_force=_spread(n_level[:, kept].max(axis=1)),
        largest_tangential_force=_spread(t_level[:, kept].max(axis=1)),
        least_tangential_force=_spread(t_level[:, kept].min(axis=1)),
        rotational_speed=2.0 * np.pi / period,
        speed_change=change,
        cutoff=cutoff,
        noise=noise,
        drift=drift,
        contact_duration=duration,
        raw_time=raw[shown],
        raw_normal_force=record.normal_force[first:last][shown],
        source=record.source,
        missed_triggers=missed_triggers,
        false_triggers=false_triggers,
        passes_in_gaps=int(np.sum(~whole)),
        passes_without_contact=int(np.sum(~touched)),
    )


def _without_gaps(record: RigRecord, starts: Array) -> NDArray[np.bool_]:
    """Return which revolutions were recorded throughout, (turns,)."""
    if record.missing is None:
        return np.ones(starts.size - 1, dtype=np.bool_)
    lost = np.concatenate([[0], np.cumsum(record.missing)])
    edges = np.clip((starts * record.sampling_rate).astype(np.int64), 0, lost.size - 1)
    return np.asarray(lost[edges[1:]] == lost[edges[:-1]], dtype=np.bool_)


def _chosen(turns: Array, rows: NDArray[np.bool_]) -> Array:
    return turns if rows.all() else turns[rows]


def _touched(turns: Array) -> NDArray[np.bool_]:
    """Return in which revolutions the block met the road, (turns,): a peak of half the usual one or more."""
    if not turns.size:
        return np.ones(0, dtype=np.bool_)
    peaks = turns.max(axis=1) - np.median(turns, axis=1)
    return np.asarray(peaks >= TOUCHED * np.median(peaks), dtype=np.bool_)


def _fold(signal: Array, marks: Array, phase: Array, rate: float) -> Array:
    """Return the signal of each revolution at equal phases, (revolutions, n)."""
    folded = np.empty((marks.size - 1, phase.size))
    for k, (first, last) in enumerate(zip(marks[:-1] * rate, marks[1:] * rate, strict=True)):
        place = first + (last - first) * phase
        low = max(int(place[0]), 0)
        high = min(int(place[-1]) + 2, signal.size)
        folded[k] = np.interp(place, np.arange(low, high), signal[low:high])
    return folded


def _contact(turns: Array, cutoff: float, period: float, source: str) -> NDArray[np.bool_]:
    """Return which phases belong to the contact, with a margin for the filter's ringing."""
    mean = turns.mean(axis=0)
    mean = mean - np.median(mean)
    peak = int(np.argmax(mean))
    above = mean > CONTACT * mean[peak]
    first, last = peak, peak
    while first > 0 and above[first - 1]:
        first -= 1
    while last < mean.size - 1 and above[last + 1]:
        last += 1
    margin = int(np.ceil((last - first) * 0.25 + 2.0 * mean.size / (cutoff * period)))
    contact = np.zeros(mean.size, dtype=np.bool_)
    contact[max(first - margin, 0) : last + margin + 1] = True
    if contact.mean() > 0.6:
        raise InputError(source, f"contact over {100 * contact.mean():.0f} % of a revolution", "free running as well")
    return contact


def _free_of_drift(turns: Array, phase: Array, contact: NDArray[np.bool_]) -> tuple[Array, float]:
    """Return the passes less the straight line through their free running, and the range of those lines in N."""
    basis = np.column_stack([np.ones(phase.size), phase - 0.5])
    lines = np.linalg.lstsq(basis[~contact], turns[:, ~contact].T, rcond=None)[0]
    turns -= (basis @ lines).T
    ends = basis[[0, -1]] @ lines
    return turns, float(np.ptp(ends))


def _touch(mean: Array, time: Array) -> tuple[float, float]:
    """Return when the block first touches and when it leaves, s.

    A flat face meets a round one with a force that grows with the square of time, so the square root of the force is
    a straight line: it is drawn through 3..30 % of the peak and followed to zero.
    """
    peak = int(np.argmax(mean))
    ends = []
    for side in (slice(peak, None, -1), slice(peak, None)):
        force, t = mean[side], time[side]
        below = force < ONSET[0] * mean[peak]
        stop = int(np.argmax(below)) if below.any() else force.size
        part = slice(int(np.argmax(force[:stop] < ONSET[1] * mean[peak])), stop)
        if stop - part.start < 2:
            part = slice(max(stop - 2, 0), stop)
        slope, offset = np.polyfit(t[part], np.sqrt(np.maximum(force[part], 0.0)), 1)
        ends.append(float(-offset / slope))
    return ends[0], ends[1]


def _spread(values: Array) -> Spread:
    return Spread(float(values.mean()), float(values.min()), float(values.max()), float(values.std(ddof=1)))
