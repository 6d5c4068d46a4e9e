"""Reading a belt file: smoothed ridge traces in YAML."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..files import read_text
from ..provenance import sha256_file
from ..units import MM
from ..yaml_text import read_mapping
from .trace_import import read_raw_trace

Array = NDArray[np.float64]


def read_belt_trace(file: Path, trace: str) -> tuple[Array, Array]:
    """Return place and height of one smoothed ridge trace, both (n,) arrays in m.

    The file is YAML with the keys ``origin``, ``source``, ``pitch_mm`` and
    ``traces: {mid_top: {x_mm: [...], height_mm: [...]}, ...}``; height 0 is the level of the flat patch, positive away
    from the road. A ``.csv`` holds raw ridge heights instead, which are levelled and smoothed on the way.

    Raises `InputError` for a missing file or key, or values that are not numbers.
    """
    if file.suffix.lower() == ".csv":
        return read_raw_trace(file, trace)
    read_text(file)
    return _read(file, trace, sha256_file(file))


@lru_cache(maxsize=32)
def _read(file: Path, trace: str, digest: str) -> tuple[Array, Array]:
    """Parse once per content: `digest` is there for the cache."""
    traces = read_mapping(file, fast=True).get("traces")
    if not isinstance(traces, dict):
        raise InputError(f"{file}: traces", "nothing", "a mapping of trace names")
    if trace not in traces:
        raise InputError(f"{file}: traces", f"no {trace}", f"one of {', '.join(map(str, traces))}")
    columns = []
    for key in ("x_mm", "height_mm"):
        values = traces[trace].get(key) if isinstance(traces[trace], dict) else None
        where = f"{file}: traces.{trace}.{key}"
        if not isinstance(values, list):
            raise InputError(where, type(values).__name__, "a list of numbers")
        try:
            column = np.array(values, dtype=np.float64) * MM
        except (TypeError, ValueError):
            raise InputError(where, "an entry that is not a number", "a list of numbers") from None
        column.flags.writeable = False
        columns.append(column)
    return columns[0], columns[1]
