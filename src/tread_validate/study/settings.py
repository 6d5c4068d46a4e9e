"""Settings of a study: how finely its solvers work, and how large an error is good enough."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, FiniteFloat, field_validator

from ..fields import Label, Line, Name, NonNegative, Positive, Strict, WhereGiven
from ..model_names import current_name


class SpringSettings(Strict):
    """How finely the spring model works."""

    element_length_mm: Positive = Field(0.5, description="length of one spring element in the rolling direction")
    step_fraction: Annotated[FiniteFloat, Field(gt=0, le=1)] = Field(
        0.5, description="time step as a fraction of the time in which the road moves one element length"
    )
    variants: Annotated[tuple[Name, ...], Field(min_length=1), Label("which models run; each run names its own")] = (
        "paper",
    )

    @field_validator("variants")
    @classmethod
    def _todays_names(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        return tuple(dict.fromkeys(current_name(name) for name in names))


class ToleranceEntry(Strict):
    """How large an error is good enough for what the study is for."""

    value: Positive = Field(description="largest error, as a share of what the quantity is judged by")
    floor: NonNegative | None = Field(
        None, description="error in the quantity's unit that is always good enough, where it is judged so"
    )
    reason: Line = Field(description="why it is good enough, in one line")


class DeckSettings(Strict):
    """How the finite element decks are made."""

    element_size_mm: Positive = Field(1.0, description="edge of an element in the plane of the contact face")
    element_length_ratio: Annotated[FiniteFloat, Field(ge=0.1, le=10)] = Field(
        1.0, description="edge of an element in the direction of travel over that across the block"
    )
    layers: Annotated[int, Field(ge=2, le=64)] = Field(8, description="elements over the block's height")
    refinement: Annotated[FiniteFloat, Field(ge=1, le=10)] = Field(
        1.5, description="height of the layer at the mount over that of the layer at the contact face"
    )
    element: Annotated[Literal["C3D8R", "C3D8"], WhereGiven("decks had one-point hexahedra only", "C3D8R")] = Field(
        "C3D8R",
        description="hexahedra with one integration point and hourglass control, or with eight (C3D8): no hourglass "
        "mode and no artificial energy, at 5 to 16 times the run time in the embedded engine",
    )
    hourglass: Literal["RELAX STIFFNESS", "STIFFNESS", "VISCOUS", "ENHANCED", "COMBINED"] = "STIFFNESS"
    bulk_viscosity: tuple[NonNegative, NonNegative] = (0.06, 1.2)
    stiffness_damping_us: NonNegative = Field(
        0.2,
        description="stress per instantaneous stiffness and strain rate: the compound's loss above its Prony series",
    )
    history_interval_us: Positive = 20.0
    field_frames: Annotated[int, Field(ge=1, le=1000)] = 40
    constant_friction_variant: bool = Field(True, description="also write the deck with built-in constant friction")
    symmetry: Literal["auto", "half", "full"] = Field(
        "auto",
        description="auto: a block that z = 0 halves (a rectangle) is meshed for z >= 0 alone, on a plane of symmetry; "
        "half: other blocks are refused; full: every block whole. Readers double forces and energies of a half",
    )


class PathMesh(Strict):
    """What of the mesh a path has in its own way; the rest is as the study's deck settings say."""

    element_size_mm: Positive | None = None
    element_length_ratio: Annotated[FiniteFloat, Field(ge=0.1, le=10)] | None = None
    layers: Annotated[int, Field(ge=2, le=64)] | None = None
    refinement: Annotated[FiniteFloat, Field(ge=1, le=10)] | None = None

    def of(self, deck: DeckSettings) -> DeckSettings:
        """Return the deck settings of a case on the path."""
        return deck.model_copy(update=self.model_dump(exclude_none=True))
