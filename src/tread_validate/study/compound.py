"""Compounds: relaxation and density of tread rubber, as a study gives them."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, model_validator

from ..fields import FileName, Line, NonNegative, PoissonsRatio, Positive, Sourced, Strict


class Wlf(Strict):
    """Williams-Landel-Ferry constants: log10 a_T = -C1 (T - Ts) / (C2 + T - Ts)."""

    c1: Positive = Field(8.86, description="C1, dimensionless")
    c2_K: Positive = Field(101.6, description="C2, K")
    reference_temperature_degC: FiniteFloat = Field(10.0, description="Ts, degC (Tg + 50)")


class CompoundBase(Sourced):
    """What every compound has."""

    poissons_ratio: PoissonsRatio = 0.47
    density_kg_m3: Positive = 1000.0
    wlf: Wlf = Wlf()
    data_temperature_degC: FiniteFloat = Field(22.0, description="temperature that the relaxation times refer to, degC")

    @model_validator(mode="after")
    def _data_above_the_pole(self) -> Self:
        pole = self.wlf.reference_temperature_degC - self.wlf.c2_K
        if self.data_temperature_degC <= pole:
            raise ValueError(f"data_temperature_degC must lie above the WLF pole at {pole:g} degC")
        return self


class FitSettings(Strict):
    """How a Prony series is fitted to moduli over a band."""

    terms: Annotated[int, Field(ge=1, le=60)] = 24
    band_rad_s: tuple[Positive, Positive] = (0.25, 2500.0)
    low_margin: Positive = Field(5.0, description="g2: longest time is 2 pi g2 / lowest frequency")
    high_margin: Positive = Field(5.0, description="g1: shortest time is 2 pi / (g1 highest frequency)")

    @model_validator(mode="after")
    def _band_in_order(self) -> Self:
        if self.band_rad_s[0] >= self.band_rad_s[1]:
            raise ValueError("band_rad_s must be [lowest, highest] with lowest < highest")
        return self


class FractionalZener(CompoundBase):
    """E*(w) = E_inf + dE (i w/w_c)^a / (1 + (i w/w_c)^a), turned into a Prony series by a fit over a band."""

    kind: Literal["fractional_zener"]
    long_term_modulus_MPa: Positive
    modulus_rise_MPa: Positive
    corner_frequency_rad_s: Positive
    exponent: Annotated[FiniteFloat, Field(gt=0, le=1)]
    fit: FitSettings = FitSettings()


class PronyTerm(Strict):
    """One exponential of the relaxation modulus."""

    modulus_MPa: NonNegative
    relaxation_time_s: Positive


class PronyCompound(CompoundBase):
    """A Prony series written out in the study."""

    kind: Literal["prony"]
    long_term_modulus_MPa: Positive
    terms: Annotated[tuple[PronyTerm, ...], Field(max_length=60)] = ()


class PronyFile(CompoundBase):
    """A material file, as ``tread-validate fit-prony`` writes it."""

    kind: Literal["prony_file"]
    file: FileName


class SweepColumns(Strict):
    """Which column of an export is what, by heading or number from 1, where the headings leave a doubt."""

    temperature: Line | None = None
    frequency: Line | None = None
    storage: Line | None = None
    loss: Line | None = None
    complex: Line | None = None
    tan_delta: Line | None = None
    phase: Line | None = None
    set: Line | None = None


class SweepUnits(Strict):
    """Units of an export, whatever its headings say."""

    temperature: Literal["degC", "K", "degF"] | None = None
    frequency: Literal["Hz", "rad/s", "kHz"] | None = None
    modulus: Literal["Pa", "kPa", "MPa", "GPa"] | None = None
    phase: Literal["deg", "rad"] | None = None


class SweepFile(CompoundBase):
    """Raw isothermal sweeps of a dynamic mechanical analyser, fitted by the pipeline."""

    kind: Literal["sweeps"]
    file: FileName
    columns: SweepColumns = SweepColumns()
    units: SweepUnits = SweepUnits()
    fit: FitSettings = FitSettings()


Compound = Annotated[FractionalZener | PronyCompound | PronyFile | SweepFile, Field(discriminator="kind")]
