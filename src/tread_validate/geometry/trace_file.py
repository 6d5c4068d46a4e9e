"""Belt files: raw ridge heights (CSV) in, levelled traces (YAML) out and in."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..units import IN_UM, MM
from ..yaml_text import read_yaml
from .trace import LevelledTrace, RidgeHeights

Array = NDArray[np.float64]


def belt_yaml(traces: tuple[LevelledTrace, ...], origin: str, source: str, provenance: Mapping[str, str]) -> str:
    """Return the text of a belt file: levelled smoothed traces with what was found on the way."""
    lines = [
        "# Levelled and smoothed traces of a loaded belt. height 0 = flat patch, positive away from the road.",
        f"# {origin} data: {source}",
        *(f"# {key}: {value}" for key, value in provenance.items()),
        f"origin: {origin}",
        f"source: {_quoted(source)}",
        f"pitch_mm: {round((traces[0].x[1] - traces[0].x[0]) / MM, 6)}",
        "summary:",
    ]
    for trace in traces:
        lines.append(
            f"  {trace.name}: {{patch_length_mm: {trace.patch_length.value / MM:.2f}, "
            f"patch_length_95_mm: {trace.patch_length.half_width / MM:.2f}, "
            f"edge_radius_mm: {trace.edge_radius.value / MM:.0f}, "
            f"edge_radius_95_mm: {trace.edge_radius.half_width / MM:.0f}, "
            f"leading_edge_mm: {trace.edges[0] / MM:.2f}, trailing_edge_mm: {trace.edges[1] / MM:.2f}, "
            f"noise_um: {trace.noise * IN_UM:.1f}, spikes_removed: {trace.spikes.size}, "
            f"edge_shift_mm: {trace.edge_shift / MM:.3f}}}"
        )
    lines.append("traces:")
    for trace in traces:
        x = ", ".join(f"{value / MM:.4f}".rstrip("0").rstrip(".") for value in trace.x)
        height = ", ".join(f"{value / MM:.7f}".rstrip("0").rstrip(".") for value in trace.height + 0.0)
        lines += [f"  {trace.name}:", f"    x_mm: [{x}]", f"    height_mm: [{height}]"]
    return "\n".join(lines) + "\n"


def read_belt(path: Path | str) -> dict[str, tuple[Array, Array]]:
    """Return x and height in m of every trace of a belt file: ``{name: (x, height)}``, each (n,)."""
    data = read_yaml(path)
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
        found[str(name)] = (x, height)
    return found


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "''") + "'"


def ridges_csv(ridges: RidgeHeights, comments: Mapping[str, str]) -> str:
    """Return raw heights as CSV in mm with 10 um resolution; a gap is an empty cell."""
    lines = [f"# {key}: {value}" for key, value in comments.items()]
    lines.append("position_mm," + ",".join(f"{name}_mm" for name in ridges.heights))
    for row, position in enumerate(ridges.position):
        cells = [f"{heights[row] / MM:.3f}" if np.isfinite(heights[row]) else "" for heights in ridges.heights.values()]
        lines.append(",".join([f"{position / MM:.3f}", *cells]))
    return "\n".join(lines) + "\n"
