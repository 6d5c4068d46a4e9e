"""The simplified belt: a flat contact patch between two arcs (Fig. 15 of the paper)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, Literal

from ...fields import Positive
from ...units import MM
from ..belt import belt_path
from ..line import ArcFlatArc
from ..path import Path
from ..path_entry import Conditions, Family, PathEntry, Uncertain, check_interference


class SimplifiedBelt(PathEntry):
    """A flat contact patch between two arcs."""

    family: ClassVar[Family] = "belt"
    on_tyre: ClassVar[bool] = True
    uncertain: ClassVar[tuple[Uncertain, ...]] = (
        Uncertain("edge_radius_mm", "edge radius", 400.0, 600.0),
        Uncertain("patch_length_mm", "patch length", 150.0, 190.0),
    )

    example: ClassVar[Mapping[str, Any]] = {}

    kind: Literal["simplified_belt"]
    patch_length_mm: Positive = 170.0
    edge_radius_mm: Positive = 500.0

    def build(self, run: Conditions) -> Path:
        """Return the path: a column touches where (R + h) cos(alpha) = R + h - D."""
        check_interference(run)
        radius, half = self.edge_radius_mm * MM, 0.5 * self.patch_length_mm * MM
        # alpha of section 4: (R + h) cos(alpha) = R + h - D
        reach = half + radius * 2.0 * math.asin(math.sqrt(0.5 * run.interference / (radius + run.height)))
        return belt_path(run, ArcFlatArc(2.0 * half, radius, run.height - run.interference), -reach, reach)
