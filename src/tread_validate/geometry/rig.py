"""The two-wheel rig: block on the small wheel, road on the big one (section 2.2 of the paper)."""

from __future__ import annotations

import math

import numpy as np

from ..errors import InputError
from ..study import Case, Rig
from ..units import MM
from .block import block_profile
from .columns import Columns
from .line import WheelLine
from .path import Path
from .road import Road


def rig_path(case: Case) -> Path:
    """Return the path of a rig case.

    The mount runs on a circle of radius R1 - h, the tread surface on R1, the road is a circle of radius R2 and the
    axles are R1 + R2 - D apart. A point at radius r meets the road where
    ``cos(theta) = (r^2 + a^2 - R2^2)/(2 r a)``, a the axle distance.

    Raises `InputError` where the interference is not between 0 and the block's height, or the block taller than the
    wheel's radius.
    """
    if not isinstance(case.path, Rig):
        raise InputError(f"case {case.case_id}: path {case.path_name}", case.path.kind, "a rig")
    surface = 0.5 * case.path.small_wheel_diameter_mm * MM
    road = 0.5 * case.path.big_wheel_diameter_mm * MM
    check_interference(case)
    if case.height >= surface:
        raise InputError(f"case {case.case_id}: height", case.height, f"below the wheel's radius, {surface:g} m")
    profile = block_profile(case.block)
    flat = case.block.mounting == "flat"
    columns = Columns(case.height, profile.extent, surface if flat else math.inf)
    line = WheelLine(surface, surface - case.height, surface - case.interference)
    distance = surface + road - case.interference
    places = np.linspace(0.0, profile.extent, 201) if flat else np.array([0.0, profile.extent])
    reach = surface - case.height + columns.column_height(places)
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
        speed=case.speed,
        interference=case.interference,
        first_touch_arc=first,
        contact_duration=float(np.max(touch_arc + offset) - first) / case.speed,
    )


def check_interference(case: Case) -> None:
    """Raise `InputError` unless 0 < interference < height."""
    if not case.interference > 0.0:
        raise InputError(
            f"case {case.case_id}: interference", f"{case.interference:g} m", "more than 0, or the block never touches"
        )
    if not case.interference < case.height:
        raise InputError(
            f"case {case.case_id}: interference", f"{case.interference:g} m", f"less than its height {case.height:g} m"
        )
