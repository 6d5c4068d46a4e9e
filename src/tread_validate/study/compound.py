"""Compounds: relaxation and density of tread rubber, as a study gives them."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, model_validator

from ..errors import InputError
from ..fields import FileName, Line, Name, NonNegative, PoissonsRatio, Positive, Sourced, Strict, WhereGiven
from .shift import OtherShift, TimeShift, Wlf


class CompoundBase(Sourced):
    """What every compound has."""

    poissons_ratio: PoissonsRatio = 0.47
    density_kg_m3: Positive = 1000.0
    wlf: Wlf = Wlf()
    shift: Annotated[OtherShift | None, WhereGiven("shifts are by `wlf` without it")] = Field(
        None, description="shift of times by Arrhenius or a table, in place of `wlf`"
    )
    elasticity: Annotated[
        Literal["linear", "neo_hooke"], WhereGiven("rubber was linear viscoelastic before the key", "linear")
    ] = Field(
        "linear",
        description="what the finite element decks make of the instantaneous moduli: linear in logarithmic strain, or "
        "neo-Hookean with the same moduli at small strain; spring models are linear either way",
    )
    data_temperature_degC: FiniteFloat = Field(22.0, description="temperature that the relaxation times refer to, degC")

    @model_validator(mode="after")
    def _data_where_times_shift(self) -> Self:
        if self.shift is not None and "wlf" in self.model_fields_set:
            raise ValueError("shift: got both wlf and shift, expected one of them")
        try:
            self.time_shift.check(self.data_temperature_degC, "data_temperature_degC")
        except InputError as error:
            raise ValueError(str(error)) from None
        return self

    @property
    def time_shift(self) -> TimeShift:
        """The law by which times shift with temperature."""
        return self.wlf if self.shift is None else self.shift

    def shift_keys(self) -> dict[str, TimeShift]:
        """Return the key that gives another compound the same shift."""
        return {"wlf": self.wlf} if self.shift is None else {"shift": self.shift}


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


class SpringPot(Strict):
    """E (i f/f_ref)^(phase/90): a spring at 0 deg, a dashpot at 90 deg."""

    modulus_MPa: Positive = Field(description="at the reference frequency")
    phase_deg: Annotated[FiniteFloat, Field(ge=0, le=90)]


class SpringPots(CompoundBase):
    """Branches in parallel, each of spring-pots in series: E*(f) = sum over branches of 1/(sum of 1/E_k*(f)).

    The fractional Maxwell, Zener and Kelvin-Voigt solids are cases of it. A fit over a band makes it a Prony series.
    """

    kind: Literal["springpots"]
    reference_frequency_Hz: Positive
    branches: Annotated[
        tuple[Annotated[tuple[SpringPot, ...], Field(min_length=1, max_length=10)], ...],
        Field(min_length=1, max_length=10),
    ]
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


class LibraryCompound(Strict):
    """A published compound by name: a file of ``reference_data/compounds``, a study's compound each."""

    kind: Literal["library"]
    name: Name


Compound = Annotated[FractionalZener | SpringPots | PronyCompound | PronyFile | SweepFile, Field(discriminator="kind")]
NamedCompound = Annotated[
    FractionalZener | SpringPots | PronyCompound | PronyFile | SweepFile | LibraryCompound,
    Field(discriminator="kind"),
]
