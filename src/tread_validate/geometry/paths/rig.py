"""The two-wheel rig: block on the small wheel, road on the big one (section 2.2 of the paper)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, Literal

import numpy as np
from pydantic import Field

from ...errors import InputError
from ...fields import Positive
from ...units import MM, RPM
from ..block import block_profile
from ..columns import Columns
from ..line import WheelLine
from ..path import Path
from ..path_entry import Conditions, Family, PathEntry, Uncertain, check_interference
from ..road import Road


class Rig(PathEntry):
    """Two wheels: the block on the small one, the road is the big one."""

    family: ClassVar[Family] = "rig"
    mount_is_rigid: ClassVar[bool] = True
    gives_coefficients: ClassVar[bool] = True
    pulls: ClassVar[bool] = False
    uncertain: ClassVar[tuple[Uncertain, ...]] = (
        Uncertain("big_wheel_diameter_mm", "big wheel's diameter", 600.0, 1600.0),
    )

    example: ClassVar[Mapping[str, Any]] = {}

    kind: Literal["rig"]
    small_wheel_diameter_mm: Positive = Field(200.0, description="over the tread surface, block and belt flush")
    big_wheel_diameter_mm: Positive = 600.0

    def surface_speed(self, rpm: float) -> float:
        """Return the speed of the tread surface in m/s at the small wheel's revolutions per minute."""
        return rpm * RPM * 0.5 * self.small_wheel_diameter_mm * MM

    def revolutions(self, speed: float) -> float:
        """Return the small wheel's revolutions per minute at a surface speed in m/s."""
        return speed / (0.5 * self.small_wheel_diameter_mm * MM) / RPM

    def tallest_block(self) -> tuple[float, str]:
        """Return the small wheel's radius, mm."""
        return 0.5 * self.small_wheel_diameter_mm, "the small wheel's radius"

    def wheel_radii(self) -> tuple[float, float]:
        """Return the radii of the small and the big wheel, mm."""
        return 0.5 * self.small_wheel_diameter_mm, 0.5 * self.big_wheel_diameter_mm

    def build(self, run: Conditions) -> Path:
        """Return the path of a rig case.

        The mount runs on a circle of radius R1 - h, the tread surface on R1, the road is a circle of radius R2 and the
        axles are R1 + R2 - D apart. A point at radius r meets the road where
        ``cos(theta) = (r^2 + a^2 - R2^2)/(2 r a)``, a the axle distance.

        Raises `InputError` where the interference is not between 0 and the block's height, or the block taller than the
        wheel's radius.
        """
        surface = 0.5 * self.small_wheel_diameter_mm * MM
        road = 0.5 * self.big_wheel_diameter_mm * MM
        check_interference(run)
        if run.height >= surface:
            raise InputError(f"case {run.case_id}: height", run.height, f"below the wheel's radius, {surface:g} m")
        profile = block_profile(run.block)
        flat = run.block.mounting == "flat"
        columns = Columns(run.height, profile.extent, surface if flat else math.inf)
        line = WheelLine(surface, surface - run.height, surface - run.interference)
        distance = surface + road - run.interference
        places = np.linspace(0.0, profile.extent, 201) if flat else np.array([0.0, profile.extent])
        reach = surface - run.height + columns.column_height(places)
        cosine = (reach**2 + distance**2 - road**2) / (2.0 * reach * distance)
        touch_arc = surface * np.arccos(np.clip(cosine, -1.0, 1.0))
        offset = columns.arc_offset(places)
        # Leading end touches at -touch_arc[0]; any other column at -touch_arc + offset on the leading end's scale.
        first = float(np.min(offset - touch_arc))
        return Path(
            line=line,
            road=Road(road),
            columns=columns,
            profile=profile,
            speed=run.speed,
            interference=run.interference,
            first_contact_arc=first,
            contact_duration=float(np.max(touch_arc + offset) - first) / run.speed,
        )
