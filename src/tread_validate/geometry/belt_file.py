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
from ..yaml_text import read_yaml
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
    traces = _remembered(file, sha256_file(file))
    if trace not in traces:
        raise InputError(f"{file}: traces", f"no {trace}", f"one of {', '.join(traces)}")
    return traces[trace]


@lru_cache(maxsize=8)
def _remembered(file: Path, digest: str) -> dict[str, tuple[Array, Array]]:
    """Read once per content: `digest` is there for the cache."""
    return read_belt(file)


def read_belt(path: Path | str) -> dict[str, tuple[Array, Array]]:
    """Return x and height in m of every trace of a belt file: ``{name: (x, height)}``, each (n,)."""
    data = read_yaml(path, fast=True)
    if not isinstance(data, dict) or not isinstance(data.get("traces"), dict) or not data["traces"]:
        raise InputError(f"{path}: traces", "nothing", "a mapping of trace names to x_mm and height_mm")
    found: dict[str, tuple[Array, Array]] = {}
    for name, trace in data["traces"].items():
        where = f"{path}: traces.{name}"
        if not isinstance(trace, dict) or not {"x_mm", "height_mm"} <= set(trace):
            raise InputError(where, "keys missing", "x_mm and height_mm")
        try:
            x, height = (np.array(trace[key], dtype=np.float64) * MM for key in ("x_mm", "height_mm"))
        except (TypeError, ValueError, OverflowError):
            raise InputError(where, "values that are not numbers", "lists of numbers") from None
        if x.ndim != 1 or x.shape != height.shape or x.size < 10:
            raise InputError(
                where, f"{x.size} positions and {height.size} heights", "two lists of one length, 10 or more"
            )
        if not np.all(np.isfinite(x) & np.isfinite(height)) or not np.all(np.diff(x) > 0):
            raise InputError(where, "positions out of order or values that are not finite", "increasing x_mm")
        for column in (x, height):
            column.flags.writeable = False
        found[str(name)] = (x, height)
    return found
