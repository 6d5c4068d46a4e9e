"""Tread blocks as a study gives them: plan shape, height, sipes, stress-free shape."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, model_validator

from ..fields import NonNegative, Positive, Sourced, Strict


class Sipe(Strict):
    """A gap through the whole height and width of the block."""

    position_mm: NonNegative = Field(description="from the leading end to the gap's near side, mm")
    width_mm: Positive


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
        if self.sipes and sum(sipe.width_mm for sipe in self.sipes) >= self.length_mm:
            raise ValueError("sipes leave nothing of the block")
        return self
