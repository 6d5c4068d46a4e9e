"""How relaxation times shift with temperature: by WLF constants, an activation energy, or a table."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, model_validator

from ..errors import InputError
from ..fields import Positive, Strict

REACH = 0.6  # K beyond a table: what one isothermal sweep spans


class Wlf(Strict):
    """Williams-Landel-Ferry constants: log10 a_T = -C1 (T - Ts) / (C2 + T - Ts)."""

    c1: Positive = Field(8.86, description="C1, dimensionless")
    c2_K: Positive = Field(101.6, description="C2, K")
    reference_temperature_degC: FiniteFloat = Field(10.0, description="Ts, degC (Tg + 50)")

    @property
    def pole(self) -> float:
        """Ts - C2, degC, at and below which the law has no meaning."""
        return self.reference_temperature_degC - self.c2_K

    def check(self, temperature: float, where: str) -> None:
        """Raise `InputError` at a temperature (degC) where the law has no meaning."""
        if temperature <= self.pole:
            raise InputError(where, f"{temperature:g} degC", f"above the WLF pole, {self.pole:g} degC")


class ArrheniusShift(Strict):
    """log10 a_T = E_a/(R ln 10) (1/T - 1/T0), T in K."""

    kind: Literal["arrhenius"]
    activation_energy_kJ_mol: Positive

    def check(self, temperature: float, where: str) -> None:
        """Raise `InputError` at or below absolute zero."""
        if temperature <= -273.15:
            raise InputError(where, f"{temperature:g} degC", "above -273.15 degC")


class ShiftTable(Strict):
    """log10 a_T at temperatures, linear in between; not extrapolated by more than 0.6 K."""

    kind: Literal["table"]
    points: Annotated[tuple[tuple[FiniteFloat, FiniteFloat], ...], Field(min_length=2, max_length=1000)] = Field(
        description="rows of temperature in degC, rising, and log10 a_T, referred to any temperature"
    )

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if any(b[0] <= a[0] for a, b in pairwise(self.points)):
            raise ValueError("points: got temperatures that do not rise, expected each above the one before")
        return self

    def check(self, temperature: float, where: str) -> None:
        """Raise `InputError` outside the table."""
        low, high = self.points[0][0], self.points[-1][0]
        if not low - REACH <= temperature <= high + REACH:
            raise InputError(where, f"{temperature:g} degC", f"{low:g} to {high:g} degC, where the shift is tabulated")


OtherShift = Annotated[ArrheniusShift | ShiftTable, Field(discriminator="kind")]
TimeShift = Wlf | ArrheniusShift | ShiftTable
