"""Rows of the regressions: coefficients a_v and a_theta, whether two sources differ, and the residuals."""

from __future__ import annotations

from ..quantities import Noise
from .row import TableRow, column, table_row
from .runs import ASSUMED, NOTE, SOURCE, STATUS

SLOPE, END = Noise(1e-4, 1e-6), Noise(1e-4, 5e-6)  # of a coefficient, and of the end of an interval about it
SHAPE = "plan of the block: rectangle or parallelogram"
COEFFICIENT = "`a_v` (speed) or `a_theta` (temperature)"
SET = "temperature and interference of a set of runs, or `mean` over the sets"


@table_row
class Coefficient(TableRow):
    """A row of Table 1 in long form."""

    table = "regression"
    title = "Regression coefficients of the peak normal force, set by set and as means"
    key = ("source", "shape", "coefficient", "set")

    source: str = column(SOURCE)
    shape: str = column(SHAPE)
    coefficient: str = column(COEFFICIENT)
    set: str = column(SET)
    value: float | None = column("the coefficient, a fraction per unit", noise=SLOPE)
    unit: str = column("unit of the coefficient: s/m or 1/degC")
    spread: float | None = column("of the sets about their mean, as `spread_kind` says", noise=SLOPE)
    spread_kind: str = column("`sd`: sample standard deviation; `range`: largest less smallest")
    low: float | None = column("lower end of the spread", noise=SLOPE)
    high: float | None = column("upper end of the spread", noise=SLOPE)
    ci_low: float | None = column("lower end of the confidence interval", noise=END)
    ci_high: float | None = column("upper end of the confidence interval", noise=END)
    ci_level: float = column("level of the confidence interval, 0..1")
    n: int = column("runs of the set, or sets of the mean")
    status: str = column(STATUS)
    note: str = column(NOTE, default="", free=True)
    assumed: str = column(ASSUMED, default="")


@table_row
class Difference(TableRow):
    """Coefficient of source b less that of source a, with the test that judges it."""

    table = "regression_differences"
    title = "Whether two sources' mean coefficients differ by more than their spread"
    key = ("shape", "coefficient", "source_a", "source_b")

    shape: str = column(SHAPE)
    coefficient: str = column(COEFFICIENT)
    source_a: str = column(SOURCE)
    source_b: str = column(SOURCE)
    difference: float | None = column("coefficient of source_b less that of source_a", noise=SLOPE)
    unit: str = column("unit of the coefficient")
    ci_low: float | None = column("lower end of the difference's confidence interval", noise=END)
    ci_high: float | None = column("upper end of the difference's confidence interval", noise=END)
    p_value: float | None = column("two-sided p of no difference, of this test alone", noise=Noise(1e-3, 1e-4))
    p_holm: float | None = column(
        "p after Holm's correction for all tests of the family: the chance of as small a p anywhere in it",
        noise=Noise(1e-3, 1e-3),
    )
    family: str = column("`measured or published`: one source is that; `models`: both were run here")
    tests: int = column("tests of the family")
    significant: bool | None = column("whether p_holm is below 1 - ci_level of the interval; empty without a test")
    test: str = column("`paired t` (set by set) or `Welch t` (means and spreads)")
    status: str = column(STATUS)
    note: str = column(NOTE, free=True)
    assumed: str = column(ASSUMED)


@table_row
class Residual(TableRow):
    """Distance of one run from the line of its set."""

    table = "regression_residuals"
    title = "Residuals of the regressions"
    key = ("source", "shape", "coefficient", "set", "case_id")

    source: str = column(SOURCE)
    shape: str = column(SHAPE)
    coefficient: str = column(COEFFICIENT)
    set: str = column(SET)
    case_id: str = column("name of the case")
    x: float = column("surface speed or temperature, in `x_unit`")
    x_unit: str = column("m/s or degC")
    force_N: float = column("peak normal force of the run", "N", noise=Noise(5e-6, 5e-5))
    fitted_N: float = column("that of the line", "N", noise=Noise(1e-5, 1e-4))
    residual_N: float = column("force less fitted", "N", noise=Noise(1e-5, 5e-4))
    residual_percent: float | None = column("residual over fitted", "%", noise=Noise(1e-5, 1e-3))
    assumed: str = column(ASSUMED, default="")
