"""The tables of the model hierarchy: what they hold, declared once for writer, figures and report."""

from __future__ import annotations

from ..compare.tables import TableRow, column
from ..compare.tables.row import table_row
from ..compare.tables.runs import ASSUMED, NOTE, STATUS

LEVEL = "level of the hierarchy: a variant of the spring model, or `model:<name>` of the study's own"
GROUP = "`all`, or the cases of one kind of path: `rig`, `belt`"
REFERENCE = "runs that the level is compared with, `fe:<engine>`"
CASE = "name of the case"
TANGENTIAL = "largest error of a peak longitudinal force over the tolerance by which the results judge that peak"


@table_row
class LevelError(TableRow):
    """One level on one case."""

    table = "errors"
    title = "Error and cost of every level on every case"
    key = ("level", "case_id")

    level: str = column(LEVEL)
    case_id: str = column(CASE)
    reference: str = column(REFERENCE)
    status: str = column(STATUS + " or `not_applicable`, a level that is not made for such a block")
    seconds: float | None = column("processor time of one pass", "s")
    memory_MB: float | None = column("largest resident memory of the run's process", "MB")
    peak_normal_force_error: float | None = column("relative error of the peak normal force", "1")
    normal_impulse_error: float | None = column("relative error of the normal impulse", "1")
    peak_positive_tangential_force_error_N: float | None = column(
        "error of the peak longitudinal force, leading edge", "N"
    )
    peak_negative_tangential_force_error_N: float | None = column(
        "error of the peak longitudinal force, trailing edge", "N"
    )
    tangential_error: float | None = column(TANGENTIAL, "1")
    iso18571_normal: float | None = column("ISO/TS 18571 score of the normal force, 0..1")
    iso18571_tangential: float | None = column("ISO/TS 18571 score of the longitudinal force, 0..1")
    late_sign_change: float | None = column("1 where the longitudinal force changes sign again at the exit, else 0")
    note: str = column(NOTE)
    assumed: str = column(ASSUMED)


@table_row
class Level(TableRow):
    """One level on a group of cases."""

    table = "pareto"
    title = "Cost and error of each model level"
    key = ("level", "group")

    level: str = column(LEVEL)
    group: str = column(GROUP)
    reference: str = column(REFERENCE)
    cases: int = column("cases of the group")
    compared: int = column("cases with a current run and reference")
    seconds_per_pass: float | None = column("median processor time of one pass", "s")
    memory_MB: float | None = column("largest resident memory", "MB")
    mean_abs_peak_normal_force_error: float | None = column("mean |error| of the peak normal force", "1")
    worst_peak_normal_force_error: float | None = column("largest error of the peak normal force, with sign", "1")
    worst_case_id: str = column("case of that error")
    worst_normal_impulse_error: float | None = column("largest error of the normal impulse, with sign", "1")
    tangential_within: float | None = column("share of runs with both peaks of T within their tolerance", "1")
    worst_tangential_error_N: float | None = column("largest |error| of a peak longitudinal force", "N")
    least_iso18571_normal: float | None = column("least ISO/TS 18571 score of the normal force")
    least_iso18571_tangential: float | None = column("least ISO/TS 18571 score of the longitudinal force")
    mean_iso18571_normal: float | None = column("mean ISO/TS 18571 score of the normal force")
    mean_iso18571_tangential: float | None = column("mean ISO/TS 18571 score of the longitudinal force")
    target: str = column("what the level was to reach; empty where nothing was asked")
    target_met: bool | None = column("whether it does")
    target_missed: str = column("parts of the target that it misses, with what it reaches")
    note: str = column(NOTE)
    assumed: str = column(ASSUMED)


@table_row
class FeMesh(TableRow):
    """One mesh of the mesh study."""

    table = "fe_meshes"
    title = "Cost and error of the FE meshes"
    key = ("case_id", "element_size_mm")

    case_id: str = column(CASE)
    element_size_mm: float = column("edge length of the elements", "mm")
    seconds_estimated: float | None = column("run time from elements, increments and the least time of each", "s")
    peak_normal_force_N: float = column("peak normal force", "N")
    peak_normal_force_error: float = column("its relative error against the limit of three meshes", "1")
    normal_impulse_error: float = column("relative error of the normal impulse against that limit", "1")
    note: str = column(NOTE)


@table_row
class Effect(TableRow):
    """What one physical effect is worth on one case."""

    table = "effects"
    title = "What each physical effect is worth"
    key = ("case_id", "effect", "before", "after")

    case_id: str = column(CASE)
    effect: str = column("what is switched")
    before: str = column("model without the change")
    after: str = column("model with it")
    peak_normal_force_percent: float | None = column("change of the peak normal force", "%")
    normal_impulse_percent: float | None = column("change of the normal impulse", "%")
    peak_positive_tangential_force_N: float | None = column("change of the peak longitudinal force, leading edge", "N")
    peak_negative_tangential_force_N: float | None = column("change of the peak longitudinal force, trailing edge", "N")
    peak_normal_force_N: float | None = column("peak normal force with the change", "N")
    assumed: str = column(ASSUMED)


@table_row
class StiffnessRow(TableRow):
    """One stiffness of the block over that of free rods."""

    table = "stiffness"
    title = "Stiffness of the block bonded to its mount, solved and in closed form"
    key = ("case_id", "stiffness")

    case_id: str = column(CASE)
    stiffness: str = column("which one, and what the face does")
    static_solve: float = column("from the static solve, over E A/h (G A/h for shear)")
    theory: float | None = column("by the pressure method, or by shear theory")
    gent_lindley: float | None = column("by Gent and Lindley's formula")
    assumed: str = column(ASSUMED)


@table_row
class PublishedFigure(TableRow):
    """One published figure of the belt run and what a level makes of it."""

    table = "published"
    title = "Published figures of the belt run, level by level"
    key = ("level", "case_id", "figure")

    level: str = column(LEVEL + ", or `fe:<engine>`")
    case_id: str = column(CASE)
    figure: str = column("what is printed")
    published: float = column("the printed value, in `unit`")
    computed: float | None = column("the computed value, in `unit`")
    unit: str = column("unit of both")
    error: float | None = column("relative error; absolute where 0 is printed")
    met: bool | None = column("whether it is within 5 %")
    note: str = column(NOTE)
    assumed: str = column(ASSUMED)


@table_row
class CombinationRow(TableRow):
    """Edge radius, patch length and modulus, and the figures that they give."""

    table = "combinations"
    title = "Which edge radius, patch length and modulus would meet all published figures"
    key = ("level", "what")

    level: str = column(LEVEL)
    what: str = column("as published, or searched for")
    edge_radius_mm: float = column("radius of the path at the patch's edges", "mm")
    patch_length_mm: float = column("length of the patch", "mm")
    modulus_factor: float = column("factor on all moduli of the compound")
    peak_normal_force_N: float = column("peak normal force", "N")
    largest_tangential_force_N: float = column("largest |longitudinal force|", "N")
    creep_percent: float = column("creep ratio of free rolling", "%")
    late_sign_change: float = column("1 where the longitudinal force changes sign again at the exit, else 0")
    meets_all: bool = column("whether all figures are met")
    note: str = column(NOTE)
    assumed: str = column(ASSUMED)


@table_row
class CompoundError(TableRow):
    """One error of the paper's springs with one compound."""

    table = "compounds"
    title = "Errors of the paper's springs by compound, against the condensed model"
    key = ("compound", "group", "quantity", "metric")

    compound: str = column("compound of the study or of the library")
    origin: str = column("published, measured, assumed or synthetic")
    group: str = column(GROUP)
    quantity: str = column("scalar or force")
    metric: str = column("`scalar`, or the score of two histories")
    cases: int = column("cases of the group")
    storage_modulus_MPa: float = column("E' in the middle of the frequencies that the passes need", "MPa")
    loss_factor: float = column("E''/E' there")
    unit: str = column("unit of the errors")
    error_type: str = column("`relative`, `absolute` or `score`")
    mean_error: float | None = column("mean error, in `unit`")
    least_error: float | None = column("least error, in `unit`")
    largest_error: float | None = column("largest error, in `unit`")
    passed: int = column("cases within the tolerance")
    criterion: str = column("the tolerance in words")
    assumed: str = column(ASSUMED)


@table_row
class CompoundDependence(TableRow):
    """How far one error moves over the compounds."""

    table = "compound_dependence"
    title = "What of the paper's springs' errors depends on the compound"
    key = ("group", "quantity", "metric")

    group: str = column(GROUP)
    quantity: str = column("scalar or force")
    metric: str = column("`scalar`, or the score of two histories")
    unit: str = column("unit of the errors")
    error_type: str = column("`relative`, `absolute` or `score`")
    compounds: int = column("compounds tried")
    own_mean_error: float | None = column("mean error with the study's own compound, in `unit`")
    least_mean_error: float | None = column("least of the compounds' mean errors, in `unit`")
    largest_mean_error: float | None = column("largest of them, in `unit`")
    own_passed: int = column("cases within the tolerance with the study's own compound")
    cases: int = column("cases of the group")
    least_passed: int = column("fewest cases within the tolerance of any compound")
    largest_passed: int = column("most of them")
    cases_that_change: int = column("cases that some compounds pass and others do not")
    depends: bool = column("whether there are such cases")


@table_row
class Compatibility(TableRow):
    """The two coefficients of one linear compound."""

    table = "compatibility"
    title = "Which compounds could give both published coefficients"
    key = ("family", "what", "parameter", "value")

    family: str = column("kind of relaxation spectrum")
    what: str = column("which of the kind")
    a_v_percent_s_per_m: float = column("rate coefficient a_v", "% s/m")
    a_v_sd_percent_s_per_m: float | None = column("its standard deviation over the sets", "% s/m")
    a_theta_percent_per_degC: float = column("temperature coefficient a_theta", "%/degC")
    parameter: str = column("what `value` is")
    value: float | None = column("exponent, width or misfit")
    meets_a_v: bool = column("whether a_v is within the published spread")
    meets_a_theta: bool = column("whether a_theta is")
    meets_spread: bool | None = column("whether the sets scatter no more than published")
    note: str = column(NOTE)


@table_row
class SobolIndex(TableRow):
    """Sobol indices of one quantity for one input."""

    table = "sobol"
    title = "Sobol indices"
    key = ("run", "quantity", "input")

    run: str = column(CASE)
    quantity: str = column("output of the pass")
    unit: str = column("its unit")
    input: str = column("assumed input that varies")
    low: float = column("lower end of its range, in `input_unit`")
    high: float = column("upper end of its range, in `input_unit`")
    input_unit: str = column("unit of the input")
    first_order: float = column("first-order index")
    first_order_ci: float = column("half-width of its 95 % interval")
    total: float = column("total index")
    total_ci: float = column("half-width of its 95 % interval")
    mean: float = column("mean of the quantity, in `unit`")
    sd: float = column("its standard deviation, in `unit`")
    p05: float = column("its 5 % quantile, in `unit`")
    p95: float = column("its 95 % quantile, in `unit`")
    samples: int = column("passes behind the indices")
    assumed: str = column(ASSUMED)


TABLES: tuple[type[TableRow], ...] = (
    Level, PublishedFigure, Effect, CombinationRow, CompoundDependence, CompoundError, Compatibility, SobolIndex,
    StiffnessRow, FeMesh,
)  # fmt: skip
"""In the report's order; `LevelError` is not shown there."""
