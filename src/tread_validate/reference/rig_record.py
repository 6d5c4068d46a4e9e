"""Raw force records of the two-wheel rig: CSV, and National Instruments TDMS."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, one_line
from .rig_clock import from_times, on_one_clock
from .rig_tdms import read_tdms_channels
from .rig_text import read_text_channels

Array = NDArray[np.float64]

FORCES = ("normal_force_N", "tangential_force_N")
TIME = "time_s"
TRIGGERS = ("trigger_V", "wheel_angle_rad", "wheel_angle_deg")
FEWEST_SAMPLES = 200
CLIPPED_RUN = 5  # samples in a row at the largest reading ...
CLIPPED_TOTAL = 10  # ... and so many in the record: a limit was reached
LARGEST_FORCE = 1e5  # N


@dataclass(frozen=True)
class RigRecord:
    """Forces of many revolutions.

    Attributes
    ----------
    sampling_rate : float, Hz
    normal_force, tangential_force : (n,) arrays, N
        As recorded: with drift, noise and both contact and free running.
    trigger : (n,) array or None
        Signal that rises once a revolution, any unit.
    wheel_angle : (n,) array or None, rad
        Angle of the small wheel, wrapped or not.
    source : str
    comments : mapping of str to str
        What the file says of the conditions.
    missing : (n,) bool array or None
        Samples that were not recorded, filled by straight lines.
    understood : tuple of str
        Which column or channel was taken for what, in which unit.
    """

    sampling_rate: float
    normal_force: Array
    tangential_force: Array
    trigger: Array | None
    wheel_angle: Array | None
    source: str
    comments: Mapping[str, str] = field(default_factory=dict)
    missing: NDArray[np.bool_] | None = None
    understood: tuple[str, ...] = ()


def read_record(path: Path | str, channels: Mapping[str, str] | None = None) -> RigRecord:
    """Read a record by its ending, ``.tdms`` or text.

    Columns or channels time_s, normal_force_N, tangential_force_N and one of trigger_V, wheel_angle_rad,
    wheel_angle_deg; their headings may say other units (``normal_force_kN``, ``Fz [kN]``, a unit row, a channel's
    ``unit_string``). `channels` maps these names to the file's own (TDMS: ``Group/Channel``).

    Raises `InputError` with file, row and reason: missing columns, no trigger, uneven sampling, clipped signals.
    """
    names = {name: (channels or {}).get(name, name) for name in (TIME, *FORCES, *TRIGGERS)}
    for name in channels or {}:
        if name not in names:
            raise InputError(f"channel {one_line(name, 60)}", "an unknown name", f"one of {', '.join(names)}")
    if Path(path).suffix.lower() == ".tdms":
        values, clocks, comments, told = read_tdms_channels(Path(path), names, FORCES)
        first = 1
    else:
        values, first, comments, told = read_text_channels(path, names, (TIME, *FORCES))
        clocks = {}
    values = _one_angle(values)
    if not any(name in values for name in TRIGGERS):
        expected = f"a column or channel {', '.join(names[name] for name in TRIGGERS)}"
        raise InputError(f"{path}:{first - 1}" if first > 1 else path, "a record without a trigger", expected)
    time = values.pop(TIME, None)
    smallest = min(signal.size for signal in values.values())
    if smallest < FEWEST_SAMPLES:
        raise InputError(path, f"{smallest} samples", f"at least {FEWEST_SAMPLES}")
    if time is not None:
        sizes = {name: signal.size for name, signal in values.items()} | {TIME: time.size}
        if len(set(sizes.values())) != 1:
            raise InputError(path, f"channels of {sizes} samples", "channels of one length")
        step, missing = from_times(values, time, str(path), first)
    elif FORCES[0] in clocks:
        step, missing = on_one_clock(values, clocks, FORCES[0], str(path))
    else:
        raise InputError(path, "no time channel and no wf_increment", f"channel {names[TIME]} or a waveform")
    for name in FORCES:
        _refuse_clipped(values[name], name, str(path), first)
    return RigRecord(
        sampling_rate=1.0 / step,
        normal_force=values[FORCES[0]],
        tangential_force=values[FORCES[1]],
        trigger=values.get("trigger_V"),
        wheel_angle=values.get("wheel_angle_rad"),
        source=str(path),
        comments=dict(comments),
        missing=missing,
        understood=told,
    )


def _one_angle(values: dict[str, Array]) -> dict[str, Array]:
    """Return the channels with an angle under one name: both names' numbers are in rad by now."""
    if "wheel_angle_deg" in values:
        angle = values.pop("wheel_angle_deg")
        values.setdefault("wheel_angle_rad", angle)
    return values


def _refuse_clipped(force: Array, name: str, source: str, first: int) -> None:
    highest, lowest = float(force.max()), float(force.min())
    if max(highest, -lowest) > LARGEST_FORCE:
        row = int(np.argmax(np.abs(force) > LARGEST_FORCE))
        found = f"{force[row]:g} N"
        raise InputError(f"{source}:{first + row}: {name}", found, f"at most {LARGEST_FORCE:g} N (unit?)")
    spread = highest - lowest
    if spread == 0:
        raise InputError(f"{source}:{first}: {name}", f"{force[0]:g} N throughout", "a signal")
    for extreme in (highest, lowest):
        at = np.flatnonzero(np.abs(force - extreme) <= 1e-9 * spread)
        breaks = np.flatnonzero(np.diff(at) != 1)
        begins = np.concatenate([[0], breaks + 1])
        runs = np.diff(np.concatenate([begins, [at.size]]))
        if runs.max() >= CLIPPED_RUN and at.size >= CLIPPED_TOTAL:
            row = int(at[begins[np.argmax(runs)]])
            found = f"{int(runs.max())} samples in a row at {extreme:g} N, {at.size} in all: clipped"
            raise InputError(f"{source}:{first + row}: {name}", found, "a signal within the amplifier's range")
