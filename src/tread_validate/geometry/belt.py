"""What the belts share: an inextensible mount at its speed along the arc, over a plane road."""

from __future__ import annotations

from .block import block_profile
from .columns import Columns
from .line import MountLine
from .path import Path
from .path_entry import Conditions
from .road import Road


def belt_path(run: Conditions, line: MountLine, first: float, last: float) -> Path:
    """Return the path along a mount line on which a column touches at the arc `first` and leaves at `last`, m.

    The belt is at height h - D over the road where the patch is flat (sections 3, 4.3 and 5 of the paper).
    """
    profile = block_profile(run.block)
    return Path(
        line=line,
        road=Road(),
        columns=Columns(run.height, profile.extent),
        profile=profile,
        speed=run.speed,
        interference=run.interference,
        first_contact_arc=first,
        contact_duration=(last - first + profile.extent) / run.speed,
    )
