"""What a study file may say: compounds, friction laws, blocks, paths, runs and settings.

Keys carry their unit (``_mm``, ``_degC``); the `Case` built from them is SI. Every input names its origin, so that a
number which rests on an assumed or synthetic input can be marked wherever it is shown.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, StringConstraints, model_validator

from .digest import DataFile, Label, Numerics

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


class Sourced(Strict):
    """An input that says where it comes from."""

    origin: Annotated[Origin, Label("how far the values can be trusted, not what they are")] = Field(
        description="published, measured, assumed or synthetic"
    )
    source: Annotated[Line, Label("where the values come from")] = Field(
        description="where the values come from, in one line"
    )


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


class SweepFile(CompoundBase):
    """Raw isothermal sweeps of a dynamic mechanical analyser, fitted by the pipeline."""

    kind: Literal["sweeps"]
    file: FileName
    fit: FitSettings = FitSettings()


Compound = Annotated[FractionalZener | PronyCompound | PronyFile | SweepFile, Field(discriminator="kind")]


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


class Run(Strict):
    """A factor grid: every list is a factor, and the runs are their product."""

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


Creep = Literal["free_rolling"] | Annotated[FiniteFloat, Field(gt=-20, lt=20)]


class SpringSettings(Strict):
    """How finely the spring model works."""

    element_length_mm: Positive = Field(0.5, description="length of one spring element in the rolling direction")
    step_fraction: Annotated[FiniteFloat, Field(gt=0, le=1)] = Field(
        0.5, description="time step as a fraction of the time in which the road moves one element length"
    )
    variants: Annotated[tuple[Name, ...], Field(min_length=1), Label("which models run; each run names its own")] = (
        "paper",
    )


class DeckSettings(Strict):
    """How the finite element decks are made."""

    element_size_mm: Positive = Field(1.0, description="edge of an element in the plane of the contact face")
    layers: Annotated[int, Field(ge=2, le=64)] = Field(8, description="elements over the block's height")
    refinement: Annotated[FiniteFloat, Field(ge=1, le=10)] = Field(
        1.5, description="height of the layer at the mount over that of the layer at the contact face"
    )
    hourglass: Literal["RELAX STIFFNESS", "STIFFNESS", "VISCOUS", "ENHANCED", "COMBINED"] = "STIFFNESS"
    bulk_viscosity: tuple[NonNegative, NonNegative] = (0.06, 1.2)
    history_interval_us: Positive = 20.0
    field_frames: Annotated[int, Field(ge=1, le=1000)] = 40
    constant_friction_variant: bool = Field(True, description="also write the deck with built-in constant friction")


class Study(Strict):
    """A whole study file."""

    schema_version: Literal[1]
    name: Annotated[Name, Label("names the study")]
    title: Annotated[Line, Label("heads the report")]
    notes: Annotated[tuple[Line, ...], Label("for the reader")] = ()
    compounds: Annotated[dict[Name, Compound], Field(min_length=1)]
    friction_laws: Annotated[dict[Name, Friction], Field(min_length=1)]
    blocks: Annotated[dict[Name, Block], Field(min_length=1)]
    paths: Annotated[dict[Name, Wheel], Field(min_length=1)]
    runs: Annotated[tuple[Run, ...], Field(min_length=1)]
    spring: Annotated[SpringSettings, Numerics("spring")] = SpringSettings()
    deck: Annotated[DeckSettings, Numerics("deck")] = DeckSettings()
    engine: Annotated[
        Literal["embedded", "abaqus", "calculix"], Label("which solver makes references; each run names its own")
    ] = "embedded"

    @model_validator(mode="after")
    def _names_exist(self) -> Self:
        known: dict[str, dict[str, Any]] = {
            "compound": self.compounds,
            "friction": self.friction_laws,
            "block": self.blocks,
            "path": self.paths,
        }
        for index, run in enumerate(self.runs):
            for key, table in known.items():
                names = getattr(run, key)
                for name in (names,) if isinstance(names, str) else names:
                    if name not in table:
                        raise ValueError(f"runs[{index}].{key}: got {name}, expected one of {', '.join(sorted(table))}")
        return self


Run.model_rebuild()
