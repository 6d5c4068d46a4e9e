"""What the fields of an input file are made of: strict models, ranges with names, and marks for the digest.

Keys carry their unit (``_mm``, ``_degC``). Every input names its origin, so a number that depends on an assumed or
synthetic input can be marked wherever it is shown.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal, get_args

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    FiniteFloat,
    StringConstraints,
    ValidationError,
    ValidationInfo,
    field_validator,
    model_validator,
)
from pydantic_core import InitErrorDetails, PydanticCustomError

from .bounds import bound_of


@dataclass(frozen=True)
class Label:
    """Marks a field that decides no result: ``key: Annotated[str, Label("a title")]``."""

    why: str


@dataclass(frozen=True)
class WhereGiven:
    """Marks an optional field that counts only where it is given: without it a case is what it was before the key.

    Attributes
    ----------
    why : str
    absent : str or None
        Value of a case that does not use the field.
    """

    why: str
    absent: str | None = None


@dataclass(frozen=True)
class Numerics:
    """Marks settings of one solver: they decide its discretisation error, not the problem."""

    solver: str


@dataclass(frozen=True)
class DataFile:
    """Marks a file's name, in whose place stand the file's content and its suffix."""


TRUTH = PydanticCustomError("truth_value", "a number or a text, not true or false (nor yes, no, on, off)")
Origin = Literal["published", "measured", "assumed", "synthetic"]
Name = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]{0,23}$")]
Line = Annotated[str, StringConstraints(min_length=1, max_length=300, pattern=r"^[^\x00-\x1f\x7f-\x9f\u2028\u2029]+$")]
FileName = Annotated[str, StringConstraints(min_length=1, max_length=200, pattern=r"^[^\x00-\x1f\x7f]+$"), DataFile()]
Positive = Annotated[FiniteFloat, Field(gt=0)]
NonNegative = Annotated[FiniteFloat, Field(ge=0)]
PoissonsRatio = Annotated[FiniteFloat, Field(gt=0, lt=0.5)]


class Strict(BaseModel):
    """A frozen model that refuses keys it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)

    @model_validator(mode="before")
    @classmethod
    def _no_truth_for_a_number(cls, data: Any) -> Any:
        """Refuse true and false where a number or a text is asked for: they would pass as 1 and 0."""
        wrong: list[InitErrorDetails] = [
            {"type": TRUTH, "loc": (name,), "input": value}
            for name, value in (data.items() if isinstance(data, Mapping) else ())
            if name in cls.model_fields and _holds_truth(value) and not _admits_truth(cls.model_fields[name].annotation)
        ]
        if wrong:
            raise ValidationError.from_exception_data(cls.__name__, wrong)
        return data

    @field_validator("*", mode="after")
    @classmethod
    def _within_bounds(cls, value: Any, info: ValidationInfo) -> Any:
        """Refuse numbers that the quantity, known by the field's name and unit, cannot take."""
        bound = bound_of(info.field_name or "")
        if bound is not None and not all(map(bound.holds, _numbers(value))):
            raise PydanticCustomError("out_of_bounds", "{bound}", {"bound": str(bound)})
        return value


def _holds_truth(value: object) -> bool:
    """Whether a value is true or false, or a list with one of them."""
    return isinstance(value, bool) or (isinstance(value, tuple | list) and any(map(_holds_truth, value)))


def _admits_truth(annotation: object) -> bool:
    """Whether a field's type has bool in it."""
    return annotation is bool or annotation is Any or any(map(_admits_truth, get_args(annotation)))


def _numbers(value: object) -> list[float]:
    """Return the numbers in a value: itself, or those in its lists."""
    if isinstance(value, tuple | list):
        return [number for item in value for number in _numbers(item)]
    return [float(value)] if isinstance(value, int | float) and not isinstance(value, bool) else []


class Sourced(Strict):
    """An input that says where it comes from."""

    origin: Annotated[Origin, Label("how far the values can be trusted, not what they are")] = Field(
        description="published, measured, assumed or synthetic"
    )
    source: Annotated[Line, Label("where the values come from")] = Field(
        description="where the values come from, in one line"
    )
