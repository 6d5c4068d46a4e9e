"""Runs: test matrices over the inputs of a study."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, model_validator

from ..fields import Label, Name, PoissonsRatio, Positive, Strict

Creep = Literal["free_rolling"] | Annotated[FiniteFloat, Field(gt=-20, lt=20)]


class Run(Strict):
    """A test matrix: every list is a factor, and the runs are their product."""

    name: Annotated[Name, Label("names the run")]
    path: Name | Annotated[tuple[Name, ...], Field(min_length=1)]
    block: Name | Annotated[tuple[Name, ...], Field(min_length=1)]
    compound: Name | Annotated[tuple[Name, ...], Field(min_length=1)]
    friction: Name | Annotated[tuple[Name, ...], Field(min_length=1)]
    poissons_ratio: PoissonsRatio | Annotated[tuple[PoissonsRatio, ...], Field(min_length=1)] | None = Field(
        None, description="in place of the compound's own"
    )
    temperature_degC: FiniteFloat | Annotated[tuple[FiniteFloat, ...], Field(min_length=1)]
    interference_mm: Positive | Annotated[tuple[Positive, ...], Field(min_length=1)] = Field(
        description="largest compression of the block"
    )
    speed_rpm: Positive | Annotated[tuple[Positive, ...], Field(min_length=1)] | None = Field(
        None, description="of the small wheel (rig only)"
    )
    speed_m_s: Positive | Annotated[tuple[Positive, ...], Field(min_length=1)] | None = Field(
        None, description="of the surface"
    )
    creep_percent: Creep | Annotated[tuple[Creep, ...], Field(min_length=1)] = Field(
        0.0, description="road faster than block by this much, or `free_rolling`: no net tangential impulse"
    )

    @model_validator(mode="after")
    def _one_speed(self) -> Self:
        if (self.speed_rpm is None) == (self.speed_m_s is None):
            raise ValueError("give either speed_rpm or speed_m_s")
        return self
