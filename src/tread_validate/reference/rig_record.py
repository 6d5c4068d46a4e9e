"""Raw force records of the two-wheel rig: CSV, and National Instruments TDMS."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..columns import read_columns
from ..errors import InputError, one_line
from ..units import DEG

Array = NDArray[np.float64]

FORCES = ("normal_force_N", "tangential_force_N")
TIME = "time_s"
TRIGGERS = {"trigger_V": 1.0, "wheel_angle_rad": 1.0, "wheel_angle_deg": DEG}
UNEVEN = 0.01  # largest departure of a time step from the median, relative
FEWEST_SAMPLES = 200
CLIPPED_RUN = 5  # samples in a row at the largest reading ...
CLIPPED_TOTAL = 10  # ... and so many in the record: a limit was reached
LARGEST_FORCE = 1e5  # N
LARGEST_TIME = 1e9  # s


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
    """

    sampling_rate: float
    normal_force: Array
    tangential_force: Array
    trigger: Array | None
    wheel_angle: Array | None
    source: str
    comments: Mapping[str, str] = field(default_factory=dict)


def read_record(path: Path | str, channels: Mapping[str, str] | None = None) -> RigRecord:
    """Read a record by its ending, ``.tdms`` or text.

    Columns or channels time_s, normal_force_N, tangential_force_N and one of trigger_V, wheel_angle_rad,
    wheel_angle_deg. `channels` maps these names to the file's own (TDMS: ``Group/Channel``).

    Raises `InputError` with file, row and reason: missing columns, no trigger, uneven sampling, clipped signals.
    """
    names = {name: (channels or {}).get(name, name) for name in (TIME, *FORCES, *TRIGGERS)}
    if channels:
        for name in channels:
            if name not in names:
                raise InputError(f"channel {one_line(name, 60)}", "an unknown name", f"one of {', '.join(names)}")
    if Path(path).suffix.lower() == ".tdms":
        return _read_tdms(Path(path), names)
    return _read_text(path, names)


def _read_text(path: Path | str, names: Mapping[str, str]) -> RigRecord:
    needed = [names[name] for name in (TIME, *FORCES)]
    table = read_columns(path, needed, optional=[names[name] for name in TRIGGERS])
    present = [name for name in TRIGGERS if names[name] in table.values]
    if not present:
        expected = f"a column {', '.join(names[name] for name in list(TRIGGERS)[:-1])} or {names['wheel_angle_deg']}"
        raise InputError(f"{path}:{int(table.line[0]) - 1}", "a record without a trigger", expected)
    values = {name: table[names[name]] for name in (TIME, *FORCES, *present)}
    return _record(values, str(path), table.line, table.comments)


class _Complaints(logging.Handler):
    """Keeps the warnings of the TDMS reader, which goes on where a file is damaged."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.said: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep one warning."""
        self.said.append(record.getMessage())


def _read_tdms(path: Path, names: Mapping[str, str]) -> RigRecord:
    from nptdms import TdmsFile

    if not path.is_file():
        raise InputError(path, "no such file", "an existing file")
    complaints = _Complaints()
    loggers = [logging.getLogger(name) for name in list(logging.root.manager.loggerDict) if name.startswith("nptdms")]
    kept = [logger.handlers for logger in loggers]
    for logger in loggers:
        logger.handlers = [complaints]
    try:
        file = TdmsFile.read(path)
    except Exception as error:  # the reader raises many kinds for a damaged file
        raise InputError(path, one_line(f"{type(error).__name__}: {error}", 120), "a TDMS file") from None
    finally:
        for logger, handlers in zip(loggers, kept, strict=True):
            logger.handlers = handlers
    if complaints.said:  # a file that is cut off is read as far as it goes, with a warning
        raise InputError(path, one_line(complaints.said[0], 120), "a whole TDMS file")
    found = {f"{group.name}/{channel.name}": channel for group in file.groups() for channel in group.channels()}
    by_name = {}
    for name, wanted in names.items():
        matches = [c for full, c in found.items() if wanted in (full, full.partition("/")[2])]
        if len(matches) > 1:
            raise InputError(f"{path}: {wanted}", f"{len(matches)} channels of that name", "Group/Channel to tell them")
        if matches:
            by_name[name] = matches[0]
    for name in FORCES:
        if name not in by_name:
            have = one_line(", ".join(found) or "none", 160)
            raise InputError(path, f"channels {have}", f"channel {names[name]} (or --channel {name}=Group/Channel)")
    if not any(name in by_name for name in TRIGGERS):
        raise InputError(path, "a record without a trigger", f"a channel {', '.join(names[n] for n in TRIGGERS)}")
    values = {name: np.asarray(channel[:], dtype=np.float64) for name, channel in by_name.items()}
    if TIME not in values:
        step = by_name[FORCES[0]].properties.get("wf_increment")
        if not step:
            raise InputError(path, "no time channel and no wf_increment", f"channel {names[TIME]} or a waveform")
        values[TIME] = np.arange(values[FORCES[0]].size, dtype=np.float64) * float(step)
    sizes = {name: column.size for name, column in values.items()}
    if len(set(sizes.values())) != 1:
        raise InputError(path, f"channels of {sizes} samples", "channels of one length")
    comments = {str(key): str(value) for key, value in file.properties.items()}
    for name, column in values.items():
        if not np.all(np.isfinite(column)):
            row = int(np.argmin(np.isfinite(column)))
            raise InputError(f"{path}: {names[name]}, sample {row + 1}", column[row], "a finite number")
    return _record(values, str(path), np.arange(1, values[TIME].size + 1, dtype=np.int64), comments)


def _record(
    values: Mapping[str, Array], source: str, line: NDArray[np.int64], comments: Mapping[str, str]
) -> RigRecord:
    time = values[TIME]
    if time.size < FEWEST_SAMPLES:
        raise InputError(source, f"{time.size} samples", f"at least {FEWEST_SAMPLES}")
    if np.abs(time).max() > LARGEST_TIME:
        row = int(np.argmax(np.abs(time)))
        raise InputError(f"{source}:{line[row]}: {TIME}", f"{time[row]:.6g} s", f"at most {LARGEST_TIME:g} s")
    steps = np.diff(time)
    step = float(np.median(steps))
    wrong = np.abs(steps - step) > UNEVEN * step if step > 0 else np.ones(steps.size, dtype=bool)
    # times rounded to the file's last digit may jitter by one of them
    wrong &= np.abs(steps - step) > 1.1 * _last_digit(time)
    if step <= 0 or wrong.any():
        row = int(np.argmax(wrong))
        found = f"a step of {steps[row]:.6g} s"
        raise InputError(f"{source}:{line[row + 1]}: {TIME}", found, f"even sampling, {max(step, 0):.6g} s a sample")
    for name in FORCES:
        _refuse_clipped(values[name], name, source, line)
    angle = None
    for name, factor in TRIGGERS.items():
        if name.startswith("wheel") and name in values:
            angle = values[name] * factor
    return RigRecord(
        sampling_rate=(time.size - 1) / float(time[-1] - time[0]),
        normal_force=values[FORCES[0]],
        tangential_force=values[FORCES[1]],
        trigger=values.get("trigger_V"),
        wheel_angle=angle,
        source=source,
        comments=dict(comments),
    )


def _last_digit(time: Array) -> float:
    """Return the resolution of rounded times, s."""
    for digits in range(4, 10):
        if np.allclose(time[:50], np.round(time[:50], digits), rtol=0, atol=1e-12):
            return float(10.0**-digits)
    return 0.0


def _refuse_clipped(force: Array, name: str, source: str, line: NDArray[np.int64]) -> None:
    wrong = np.abs(force) > LARGEST_FORCE
    if wrong.any():
        row = int(np.argmax(wrong))
        raise InputError(f"{source}:{line[row]}: {name}", f"{force[row]:g} N", f"at most {LARGEST_FORCE:g} N (unit?)")
    spread = float(np.ptp(force))
    if spread == 0:
        raise InputError(f"{source}:{line[0]}: {name}", f"{force[0]:g} N throughout", "a signal")
    for extreme in (float(force.max()), float(force.min())):
        at = np.abs(force - extreme) <= 1e-9 * spread
        edges = np.flatnonzero(np.diff(np.concatenate([[0], at.view(np.int8), [0]])))
        runs = edges[1::2] - edges[::2]
        if runs.max() >= CLIPPED_RUN and at.sum() >= CLIPPED_TOTAL:
            row = int(edges[::2][np.argmax(runs)])
            found = f"{int(runs.max())} samples in a row at {extreme:g} N, {int(at.sum())} in all: clipped"
            raise InputError(f"{source}:{line[row]}: {name}", found, "a signal within the amplifier's range")
