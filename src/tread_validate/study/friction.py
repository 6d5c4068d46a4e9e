"""Friction laws as a study gives them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, FiniteFloat

from ..fields import FileName, Positive, Sourced


class FrictionBase(Sourced):
    """What every friction law has."""

    static_coefficient: Annotated[FiniteFloat, Field(gt=0, le=5)] = 0.9


class Coulomb(FrictionBase):
    """A constant kinetic coefficient."""

    kind: Literal["coulomb"]
    kinetic_coefficient: Annotated[FiniteFloat, Field(ge=0, le=5)]


class Huemer(FrictionBase):
    """mu = (alpha |p|^(n-1) + beta) / (a + b |v|^(-1/m) + c |v|^(-2/m)), p in MPa, v in m/s.

    Huemer et al., Eng. Comput. 18 (2001) 417-436.
    """

    kind: Literal["huemer"]
    alpha: FiniteFloat
    beta: FiniteFloat
    n: Positive
    m: Positive
    a: FiniteFloat
    b: FiniteFloat
    c: FiniteFloat
    least_pressure_kPa: Positive = Field(10.0, description="the law is evaluated at no less pressure than this")
    least_slip_speed_mm_s: Positive = Field(1.0, description="and at no less slip speed than this")


class FrictionTable(FrictionBase):
    """A measured table of friction coefficient against pressure and slip speed, interpolated."""

    kind: Literal["table"]
    file: FileName


class HuemerFile(FrictionBase):
    """A friction file, as ``tread-validate fit-friction`` writes it."""

    kind: Literal["huemer_file"]
    file: FileName


Friction = Annotated[Coulomb | Huemer | FrictionTable | HuemerFile, Field(discriminator="kind")]
