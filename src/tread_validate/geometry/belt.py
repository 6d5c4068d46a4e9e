"""The tyre belt's path: a flat patch between two arcs, or a measured trace (sections 3, 4.3 and 5 of the paper)."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from scipy.optimize import brentq

from ..errors import InputError
from ..study import Case, MeasuredBelt, SimplifiedBelt
from ..units import MM
from .belt_file import read_belt_trace
from .block import block_profile
from .columns import Columns
from .line import ArcFlatArc, MountLine, TabulatedLine
from .measured import line_from_trace
from .path import Path
from .rig import check_interference
from .road import Road


def belt_path(case: Case) -> Path:
    """Return the path of a belt case: the belt at height h - D over the road where the patch is flat.

    The belt is inextensible and runs at ``case.speed`` along its arc. Raises `InputError` for a bad trace, an
    interference that is not between 0 and the block's height, or a path on which the block never touches the road.
    """
    check_interference(case)
    profile = block_profile(case.block)
    line, first, last = _line(case)
    return Path(
        line=line,
        road=Road(),
        columns=Columns(case.height, profile.extent),
        profile=profile,
        speed=case.speed,
        interference=case.interference,
        first_touch_arc=first,
        contact_duration=(last - first + profile.extent) / case.speed,
    )


def _line(case: Case) -> tuple[MountLine, float, float]:
    """Return the mount line and the arcs at which a column touches and leaves the road."""
    patch_height = case.height - case.interference
    if isinstance(case.path, SimplifiedBelt):
        radius, half = case.path.edge_radius_mm * MM, 0.5 * case.path.patch_length_mm * MM
        # alpha of section 4: (R + h) cos(alpha) = R + h - D
        reach = half + radius * 2.0 * math.asin(math.sqrt(0.5 * case.interference / (radius + case.height)))
        return ArcFlatArc(2.0 * half, radius, patch_height), -reach, reach
    if not isinstance(case.path, MeasuredBelt):
        raise InputError(f"case {case.case_id}: path {case.path_name}", case.path.kind, "a belt")
    x, height = read_belt_trace(case.root / case.path.file, case.path.trace)
    where = f"{case.path.file}: traces.{case.path.trace}"
    return _traced(x.tobytes(), height.tobytes(), case.height, patch_height, where)


@lru_cache(maxsize=32)
def _traced(
    x: bytes, trace: bytes, height: float, patch_height: float, where: str
) -> tuple[TabulatedLine, float, float]:
    """Return line and touching arcs of a trace given as the bytes of its places and heights (m)."""
    line = line_from_trace(np.frombuffer(x), np.frombuffer(trace), patch_height, where)
    return line, *_touching_arcs(line, height, where)


def _touching_arcs(line: TabulatedLine, height: float, where: str) -> tuple[float, float]:
    """Return the first and the last arc at which a free column of the given height (m) meets the plane y = 0."""

    def gap(arc: float) -> float:
        _, y, theta = line.mount(arc)
        return float(y - height * np.cos(theta))

    arcs = np.linspace(line.first_arc, line.last_arc, 2 * len(line.table))
    _, y, theta = line.mount(arcs)
    inside = np.flatnonzero(y - height * np.cos(theta) < 0.0)
    if inside.size == 0:
        raise InputError(where, "a path on which the block never touches the road", "a path that comes down to it")
    if inside[0] == 0 or inside[-1] == arcs.size - 1:
        raise InputError(where, "a trace that ends inside the contact", "a trace that goes on until the block is clear")
    first = brentq(gap, arcs[inside[0] - 1], arcs[inside[0]], xtol=1e-13)
    last = brentq(gap, arcs[inside[-1]], arcs[inside[-1] + 1], xtol=1e-13)
    return float(first), float(last)
