"""The layout of a case file. Every key carries its unit: m, N, s, Pa, rad, degC."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat

Positive = Annotated[FiniteFloat, Field(gt=0)]
NonNegative = Annotated[FiniteFloat, Field(ge=0)]
Numbers = tuple[FiniteFloat, ...]


class Frozen(BaseModel):
    """A frozen part of the file that refuses keys it does not know."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)


class Named(Frozen):
    """An input by its name in the study, with where it comes from."""

    name: str
    origin: Literal["published", "measured", "assumed", "synthetic"]
    source: str


class Conventions(Frozen):
    """Axes, signs and clock, in words, so that the file explains itself."""

    axes: str = (
        "x: rolling direction of the road's surface in the patch, y: up, from the road into the tyre; origin where the "
        "undeformed road is highest (rig) or anywhere on the flat road below the patch's middle (belt)"
    )
    clock: str = "t = 0 is the first contact of the stress-free block with the road"
    block: str = "s = 0 is the leading end, which is ahead on the path; s grows towards the trailing end"
    column: str = (
        "the mount point of the column at s is on the mount line at arc first_contact_arc_m + arc_speed_m_s t - "
        "arc_offset_m(s), x_offset_m(s) added to x; its stress-free end is at (x + h sin(slope), y - h cos(slope)), "
        "h = height_m(s)"
    )
    normal_force: str = "force of the road on the block along +y (rig: towards the block wheel's axle), compression > 0"
    tangential_force: str = "force of the road on the block, positive towards the leading edge (-x)"
    creep_ratio: str = "road speed over block speed, less 1"


class Term(Frozen):
    """One exponential of the relaxation modulus in uniaxial tension."""

    modulus_Pa: NonNegative
    relaxation_time_s: Positive


class CaseWlf(Frozen):
    """log10 a_T = -C1 (T - Ts)/(C2 + T - Ts); Williams, Landel and Ferry, J. Am. Chem. Soc. 77 (1955) 3701-3707."""

    c1: Positive
    c2_K: Positive
    reference_temperature_degC: FiniteFloat


class Compound(Named):
    """E(t) = long_term_modulus_Pa + sum modulus_Pa exp(-t/relaxation_time_s) at the run's temperature."""

    temperature_degC: FiniteFloat = Field(description="that the relaxation times below refer to: the run's")
    long_term_modulus_Pa: Positive
    terms: tuple[Term, ...]
    poissons_ratio: Annotated[FiniteFloat, Field(gt=0, lt=0.5)]
    density_kg_m3: Positive
    data_temperature_degC: FiniteFloat = Field(description="at which the compound was measured or stated")
    shift_factor: Positive = Field(description="relaxation times here over those at the data temperature")
    wlf: CaseWlf | None = Field(description="null where the compound shifts by another law; see shift_factor")


class Constant(Frozen):
    """A constant of a law, with its unit."""

    value: FiniteFloat
    unit: str


class CaseFrictionTable(Frozen):
    """The kinetic coefficient over contact pressure (rows) and slip speed (columns)."""

    pressure_Pa: Numbers
    slip_speed_m_s: Numbers
    coefficient: tuple[Numbers, ...]


class CaseFriction(Named):
    """Static coefficient (limit while sticking) and kinetic coefficient over pressure and slip speed."""

    kind: str
    static_coefficient: NonNegative
    constants: dict[str, Constant] = Field(description="of the law's formula; empty for a measured table")
    table: CaseFrictionTable = Field(description="the same law as numbers: linear between them in log p and log v")


class CaseSipe(Frozen):
    """A gap through the block's width, from the face up."""

    position_m: NonNegative
    width_m: Positive
    depth_m: Positive = Field(description="from the face; the block's height for a cut through")


class CaseWidthProfile(Frozen):
    """Width of the contact face against s: linear between the points; two points at one s are a jump."""

    s_m: Numbers
    width_m: Numbers


class CaseColumns(Frozen):
    """The block's columns: their place along the path behind the leading end's, and their stress-free heights."""

    s_m: Numbers
    arc_offset_m: Numbers
    x_offset_m: Numbers = Field(description="added to x of the mount point; 0 where the block rolls")
    height_m: Numbers


class CaseBlock(Named):
    """The tread block; its plan dimensions are those of the contact face."""

    shape: str
    length_m: Positive
    width_m: Positive
    height_m: Positive
    skew_rad: FiniteFloat
    mounting: str = Field(description="conforming: face parallel to the mount everywhere; flat: a flat face")
    sipes: tuple[CaseSipe, ...]
    draft_rad: NonNegative = Field(description="lean of the outer walls: the block widens from the face to the mount")
    mesh: str | None = Field(description="mesh file of the block where the study gives one")
    area_m2: Positive
    outline_m: tuple[tuple[tuple[FiniteFloat, FiniteFloat], ...], ...] = Field(
        description="polygons (s, z) of the face's solid parts, z along the axle"
    )
    width_profile: CaseWidthProfile
    columns: CaseColumns


class CaseRoad(Frozen):
    """The rigid road: the plane y = 0, or a wheel's circle with its centre at (0, -radius)."""

    kind: Literal["plane", "wheel"]
    radius_m: Positive | None = Field(description="None for the plane")
    surface_speed_m_s: Positive = Field(description="towards +x at the contact")


class PathSamples(Frozen):
    """The mount line against the arc; `time_s` is when the leading end's mount point is there. All of one length."""

    time_s: Numbers
    arc_m: Numbers
    x_m: Numbers
    y_m: Numbers
    slope_rad: Numbers
    curvature_1_m: Numbers


class CasePath(Named):
    """The curve that the mount point of the block follows, fixed in the axle frame."""

    kind: str
    parameters: dict[str, Constant]
    first_contact_arc_m: FiniteFloat = Field(description="arc of the leading end's mount point at t = 0")
    arc_speed_m_s: Positive = Field(description="rate at which the arc grows")
    mount_speed_ratio: NonNegative = Field(
        description="speed of the mount point along its line over the arc's rate; 0 where the block does not roll"
    )
    samples: PathSamples


class CaseFile(Frozen):
    """One pass of one block, complete."""

    format: Literal["tread_validate case"] = "tread_validate case"
    schema_version: Literal[1] = 1
    case_id: str
    study: str
    case_digest: str = Field(description="binds a result to these inputs; write it into the history as # case_digest:")
    conventions: Conventions = Conventions()
    temperature_degC: FiniteFloat
    interference_m: Positive = Field(description="largest compression of the block")
    speed_m_s: Positive = Field(description="of the tread surface (rig) or of the belt along its arc")
    creep_ratio: FiniteFloat
    free_rolling: bool = Field(description="whether the creep ratio is the one without net tangential impulse")
    expected_duration_s: Positive = Field(description="from first contact until the road has left the stress-free face")
    compound: Compound
    friction: CaseFriction
    block: CaseBlock
    path: CasePath
    road: CaseRoad
