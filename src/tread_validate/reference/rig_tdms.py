"""A rig record in National Instruments' TDMS: channels with their own units and clocks."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, one_line
from .rig_clock import Clock
from .rig_units import channel_factor, is_channel

Array = NDArray[np.float64]


class _Complaints(logging.Handler):
    """Keeps the warnings of the TDMS reader, which goes on where a file is damaged."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.said: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        """Keep one warning."""
        self.said.append(record.getMessage())


def read_tdms_channels(
    path: Path, names: Mapping[str, str], needed: tuple[str, ...]
) -> tuple[dict[str, Array], dict[str, Clock], dict[str, str], tuple[str, ...]]:
    """Return channels in SI by name, the clock of each that has one, the file's properties, and what was understood.

    `names` are ``Group/Channel``, or the channel's name alone where one group has it. A ``unit_string`` is honoured.
    """
    file = _read(path)
    channels = {f"{group.name}/{channel.name}": channel for group in file.groups() for channel in group.channels()}
    values: dict[str, Array] = {}
    clocks: dict[str, Clock] = {}
    told = []
    starts: list[datetime] = []
    for name, wanted in names.items():
        full = _matching(path, channels, name, wanted)
        if full is None:
            if name in needed:
                have = one_line(", ".join(channels) or "none", 160)
                raise InputError(path, f"channels {have}", f"channel {wanted} (or --channel {name}='Group/Channel')")
            continue
        channel = channels[full]
        unit = str(channel.properties.get("unit_string", "") or channel.properties.get("NI_UnitDescription", "") or "")
        factor = channel_factor(name, unit, f"{path}: {full}: unit_string")
        values[name] = np.array(channel[:], dtype=np.float64)
        if factor != 1.0:
            values[name] *= factor
        told.append(f"{name} = channel '{full}'" + (f" in {unit}" if unit else ""))
        bad = ~np.isfinite(values[name])
        if bad.any():
            row = int(np.argmax(bad))
            raise InputError(f"{path}: {full}, sample {row + 1}", values[name][row], "a finite number")
        clock = _clock(channel.properties, starts, f"{path}: {full}")
        if clock is not None:
            clocks[name] = clock
    return values, clocks, {str(key): str(value) for key, value in file.properties.items()}, tuple(told)


def _read(path: Path) -> Any:
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
    return file


def _matching(path: Path, channels: Mapping[str, Any], name: str, wanted: str) -> str | None:
    """Return the full name of the one channel that is `wanted`; None where there is none."""
    exact = [full for full, channel in channels.items() if wanted in (full, f"{channel.group_name}/{channel.name}")]
    found = exact or [full for full, channel in channels.items() if channel.name.strip() == wanted.strip()]
    found = found or [full for full, channel in channels.items() if is_channel(channel.name, name, wanted)]
    if len(found) > 1:
        raise InputError(f"{path}: {wanted}", f"{len(found)} channels of that name", "Group/Channel to tell them")
    return found[0] if found else None


def _clock(properties: Mapping[str, Any], starts: list[datetime], where: str) -> Clock | None:
    """Return a waveform's clock in s; 0 is where the first channel with a start time starts."""
    step = properties.get("wf_increment")
    if step is None:
        return None
    if not float(step) > 0:
        raise InputError(f"{where}: wf_increment", step, "a number > 0")
    first = float(properties.get("wf_start_offset", 0.0) or 0.0)
    begun = properties.get("wf_start_time")
    if begun is not None:
        moment = np.datetime64(begun, "us").astype(datetime)
        starts.append(moment)
        first += (moment - starts[0]).total_seconds()
    return Clock(first, float(step))
