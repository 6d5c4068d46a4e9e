"""Writing belt files: levelled traces in YAML, raw ridge heights in CSV."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..units import IN_UM, MM
from .trace import LevelledTrace, RidgeHeights


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
