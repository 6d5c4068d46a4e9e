"""Paths as a study gives them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from ..fields import FileName, Name, Positive, Sourced


class Rig(Sourced):
    """Two wheels: the block on the small one, the road is the big one."""

    kind: Literal["rig"]
    small_wheel_diameter_mm: Positive = Field(200.0, description="over the tread surface, block and belt flush")
    big_wheel_diameter_mm: Positive = 600.0


class SimplifiedBelt(Sourced):
    """A flat contact patch between two arcs."""

    kind: Literal["simplified_belt"]
    patch_length_mm: Positive = 170.0
    edge_radius_mm: Positive = 500.0


class MeasuredBelt(Sourced):
    """A measured trace of the loaded belt."""

    kind: Literal["measured_belt"]
    file: FileName = Field(description="belt file as `tread-validate import-belt` writes it, or raw ridge heights")
    trace: Name = Field("mid_top", description="which ridge of the file")


Wheel = Annotated[Rig | SimplifiedBelt | MeasuredBelt, Field(discriminator="kind")]
