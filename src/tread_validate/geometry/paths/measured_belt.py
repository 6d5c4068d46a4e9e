"""A measured belt: the smoothed trace of a ridge of the loaded tyre (section 3 of the paper)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path as FilePath
from typing import Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from ...errors import InputError
from ...fields import FileName, Name
from ..belt import belt_path
from ..belt_file import read_belt, read_belt_trace
from ..line import TabulatedLine
from ..measured import line_from_trace
from ..path import Path
from ..path_entry import Conditions, Family, PathEntry, Ridge, check_interference
from ..trace import LevelledTrace, level
from ..trace_import import read_ridges


class MeasuredBelt(PathEntry):
    """A measured trace of the loaded belt."""

    family: ClassVar[Family] = "belt"
    on_tyre: ClassVar[bool] = True
    is_measured: ClassVar[bool] = True

    example: ClassVar[Mapping[str, Any]] = {"file": "belt.yaml"}

    kind: Literal["measured_belt"]
    file: FileName = Field(description="belt file as `tread-validate import-belt` writes it, or raw ridge heights")
    trace: Name = Field("mid_top", description="which ridge of the file")

    def belt_file(self, root: FilePath) -> FilePath | None:
        """Return the belt file; None for raw heights."""
        return None if self._is_raw() else root / self.file

    def ridges(self, root: FilePath) -> tuple[Ridge, ...]:
        """Return the smoothed ridges: all of a belt file, the used one of raw heights."""
        file = root / self.file
        found = {self.trace: read_belt_trace(file, self.trace)} if self._is_raw() else read_belt(file)
        return tuple(Ridge(name, x, height, name == self.trace) for name, (x, height) in found.items())

    def raw_ridges(self, root: FilePath) -> tuple[LevelledTrace, ...]:
        """Return the levelled ridges of raw heights, in the order of the file; none of a belt file."""
        if not self._is_raw():
            return ()
        return level(read_ridges(root / self.file))

    def _is_raw(self) -> bool:
        return self.file.lower().endswith(".csv")

    def build(self, run: Conditions) -> Path:
        """Return the path along the trace; raises `InputError` for a bad one."""
        check_interference(run)
        x, height = read_belt_trace(run.root / self.file, self.trace)
        where = f"{self.file}: traces.{self.trace}"
        line, first, last = _traced(x.tobytes(), height.tobytes(), run.height, run.height - run.interference, where)
        return belt_path(run, line, first, last)


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
    from scipy.optimize import brentq

    first = brentq(gap, arcs[inside[0] - 1], arcs[inside[0]], xtol=1e-13)
    last = brentq(gap, arcs[inside[-1]], arcs[inside[-1] + 1], xtol=1e-13)
    return float(first), float(last)
