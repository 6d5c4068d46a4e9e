"""Tread blocks as a study gives them: plan shape, height, sipes, stress-free shape."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, model_validator

from ..fields import FileName, NonNegative, Positive, Sourced, Strict


class Sipe(Strict):
    """A gap through the whole width of the block, from the face up to its depth."""

    position_mm: NonNegative = Field(description="from the leading end to the gap's near side, mm")
    width_mm: Positive
    depth_mm: Positive | None = Field(None, description="from the face; through the whole height where left out")


class Block(Sourced):
    """A tread block; its plan dimensions are those of the contact face."""

    shape: Literal["rectangle", "parallelogram"]
    length_mm: Positive = Field(description="in the rolling direction")
    width_mm: Positive
    height_mm: Positive
    skew_deg: Annotated[FiniteFloat, Field(ge=-75, le=75)] = Field(
        0.0, description="parallelogram: angle of the leading and trailing edges to the axle"
    )
    sipes: Annotated[tuple[Sipe, ...], Field(max_length=20)] = ()
    mounting: Literal["conforming", "flat"] = Field(
        "conforming",
        description="stress-free shape. conforming: face parallel to the mount everywhere; flat: a flat face",
    )
    draft_deg: Annotated[FiniteFloat, Field(ge=0, le=30)] = Field(
        0.0, description="lean of the outer walls: the block widens by as much from the face to the mount"
    )
    mesh: FileName | None = Field(
        None,
        description="hexahedra of the block (.vtu, .inp, ... as meshio reads them) in place of the deck's own mesh: "
        "x towards the leading end, y away from the road, z across; their size must be that of the lengths above",
    )
    mesh_unit: Literal["mm", "m"] = Field("mm", description="unit of the mesh file")

    @model_validator(mode="after")
    def _shape_is_whole(self) -> Self:
        if self.shape == "rectangle" and self.skew_deg != 0.0:
            raise ValueError("skew_deg belongs to a parallelogram; a rectangle has none")
        if self.shape == "parallelogram" and self.skew_deg == 0.0:
            raise ValueError("a parallelogram needs a skew_deg other than 0")
        end = 0.0
        for sipe in self.sipes:
            if sipe.position_mm < end or sipe.position_mm + sipe.width_mm > self.length_mm:
                raise ValueError("sipes must be in order, apart from each other and inside the block's length")
            end = sipe.position_mm + sipe.width_mm
            if sipe.depth_mm is not None and sipe.depth_mm >= self.height_mm:
                raise ValueError(
                    "a sipe's depth_mm must be less than the block's height; leave it out for a through cut"
                )
        if self.mesh is not None and (self.sipes or self.draft_deg or self.shape != "rectangle"):
            raise ValueError("a block with a mesh file is a rectangle without sipes or draft: the file has them")
        if self.sipes and sum(sipe.width_mm for sipe in self.sipes) >= self.length_mm:
            raise ValueError("sipes leave nothing of the block")
        return self
