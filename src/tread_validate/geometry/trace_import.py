"""Reading raw ridge heights of a coordinate-measuring machine."""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..columns import read_columns
from ..errors import InputError
from ..provenance import sha256_file
from ..units import MM
from .trace import RidgeHeights, smoothed_line

Array = NDArray[np.float64]

POSITION = "position_mm"
RIDGE = re.compile(r"([a-z][a-z0-9_]*)_mm")
PLAUSIBLE_PITCH = (0.05, 20.0)  # mm
LARGEST_HEIGHT = 500.0  # mm


def read_ridges(path: Path | str, invert: bool = False, confirm_units: bool = False) -> RidgeHeights:
    """Read columns position_mm and one ``<ridge>_mm`` for each ridge; an empty cell is a gap.

    `invert` turns heights that are positive towards the road. Raises `InputError` with file, line and reason: no
    ridge, an unequal pitch, positions that do not increase, values that cannot be mm (unless `confirm_units`).
    """
    table = read_columns(path, (), gaps=True)
    if POSITION not in table.values:
        raise InputError(f"{path}:{int(table.line[0]) - 1}", "columns " + ", ".join(table.values), f"column {POSITION}")
    position = table[POSITION]
    table.refuse(~np.isfinite(position), POSITION, "a position")
    ridges: dict[str, Array] = {}
    for name, values in table.values.items():
        matched = RIDGE.fullmatch(name)
        if name != POSITION and matched:
            if not confirm_units:
                table.refuse(np.abs(values) > LARGEST_HEIGHT, name, "mm, at most 500 (is it um?), or --confirm-units")
            ridges[matched[1]] = values * (-MM if invert else MM)
    if not ridges:
        raise InputError(f"{path}:{int(table.line[0]) - 1}", "no ridge", "columns such as mid_top_mm")
    steps = np.diff(position)
    pitch = float(np.median(steps)) if steps.size else 0.0
    wrong = np.abs(steps - pitch) > 1e-3 * abs(pitch) + 1e-9
    if not pitch > 0:
        raise InputError(f"{path}:{int(table.line[0])}: {POSITION}", f"a pitch of {pitch:g} mm", "increasing positions")
    if wrong.any():
        row = int(np.argmax(wrong)) + 1
        found = f"a step of {steps[row - 1]:.4g} mm"
        raise InputError(f"{table.where(row)}: {POSITION}", found, f"the pitch of {pitch:.4g} mm (leave a gap empty)")
    if not confirm_units and not PLAUSIBLE_PITCH[0] <= pitch <= PLAUSIBLE_PITCH[1]:
        found = f"a pitch of {pitch:.4g} mm (is it m or um?)"
        raise InputError(f"{table.where(0)}: {POSITION}", found, "0.05 to 20 mm, or --confirm-units")
    return RidgeHeights(position * MM, ridges, str(path))


def read_raw_trace(path: Path, name: str) -> tuple[Array, Array]:
    """Return place and smoothed height of one ridge of a raw file, both (n,) in m; remembered by content."""
    digest = sha256_file(path) if path.is_file() else ""
    return _read(path, name, digest)


@lru_cache(maxsize=8)
def _read(path: Path, name: str, digest: str) -> tuple[Array, Array]:
    """Read once per content: `digest` is there for the cache."""
    ridges = read_ridges(path)
    if name not in ridges.heights:
        raise InputError(f"{path}: trace", name, f"one of {', '.join(ridges.heights)}")
    x, height = smoothed_line(ridges, name)
    for column in (x, height):
        column.flags.writeable = False
    return x, height
