"""Rows of the errors: one comparison each, their statistics over many cases, and what the scores hang on."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

from ..quantities import HISTORY_METRIC, SCALAR, ErrorType, Noise
from .row import TableColumn, TableRow, column, table_row
from .runs import ASSUMED, NOTE, SOURCE, STATUS

Assessment = Literal["adequate", "inadequate", "cannot tell"]
Agreement = Literal["agrees", "differs", "cannot tell"]
SCATTER = Noise(1e-3, 1e-4)
PART = Noise(1e-4, 1e-6)  # of an uncertainty
METRIC = "`scalar`, or the score of two histories"
ERROR_TYPE = "`relative`: over the reference; `absolute`: in `unit`; `score`: score less 1"


@table_row
class ToleranceRow(TableRow):
    """How large an error of one quantity or score is good enough."""

    table = "tolerances"
    title = "What is good enough for what the study is for, and why"
    key = ("name",)

    name: str = column("scalar, or score of two histories")
    value: float = column("largest error, as a share of what it is judged by")
    floor: float | None = column("error that is always good enough, in `unit`")
    unit: str = column("unit of the floor")
    criterion: str = column("the two in words")
    origin: str = column("`default`, or `study` where the study chose it")
    reason: str = column("why")


@table_row
class MetricRow(TableRow):
    r"""One declared comparison.

    `agreement` and `assessment` answer two questions, after ASME V&V 20, with U = 2 u_val and u_val^2 the sum of the
    squares of the three uncertainties. Does the model agree with the reference: \|E\| <= U? Is it good enough for what
    the study is for: \|E\| + U <= tolerance (and not so where \|E\| - U > tolerance)? Where a part of u_val is not
    known, nothing can be told.
    """

    table = "errors"
    title = "Every run against its reference, a row for every scalar and every score"
    key = ("predicted_source", "reference_source", "case_id", "quantity", "metric")

    case_id: str = column("name of the case")
    quantity: str = column("scalar, or force whose histories are compared")
    metric: str = column(METRIC)
    reference_source: str = column(SOURCE)
    predicted_source: str = column(SOURCE)
    reference: float | None = column(
        "the reference's value in `unit`; of histories: largest |reference| (relative_rms), root mean square "
        "(sprague_geers_*), 1 (iso18571_*)"
    )
    predicted: float | None = column(
        "the prediction's value in `unit`; of histories: RMS error (relative_rms), root mean square (sprague_geers_*), "
        "score (iso18571_*)"
    )
    unit: str = column("unit of reference and predicted")
    error: float | None = column("comparison error E of the prediction, signed, as `error_type` says")
    error_type: ErrorType = column(ERROR_TYPE)
    u_numerical: float | None = column("standard uncertainty of E from the model's mesh and step", noise=PART)
    u_input: float | None = column("standard uncertainty of E from inputs that the two do not share", noise=PART)
    u_data: float | None = column("standard uncertainty of E from the reference", noise=PART)
    uncertainty: float | None = column("expanded uncertainty U of E; empty where a part is not known", noise=PART)
    tolerance: float | None = column("largest |E| that is good enough, in E's unit", noise=Noise(2e-5, 0.0))
    criterion: str = column("what the tolerance is, in words")
    passed: bool | None = column("whether |E| <= tolerance, uncertainty apart; empty without an error")
    agreement: Agreement = column("`agrees`: |E| <= U; `differs`; `cannot tell`")
    assessment: Assessment = column(
        "`adequate`: |E| + U <= tolerance; `inadequate`: |E| - U > tolerance; `cannot tell`"
    )
    status: str = column(STATUS, default="current")
    note: str = column(NOTE, default="", free=True)
    assumed: str = column(ASSUMED, default="")
    grade: str = column("grade of an ISO/TS 18571 score R: excellent, good, fair or poor", default="")

    def noise(self, found: TableColumn) -> Noise:
        """Return the noise of the quantity, or of the score, for its values and for the error made of them."""
        if found.name in ("u_numerical", "uncertainty") and self.metric == "scalar" and self.predicted:
            return self._noise_of_a_part(2.0 if found.name == "uncertainty" else 1.0)
        if found.name not in ("reference", "predicted", "error"):
            return found.noise
        if self.metric != "scalar":
            newtons = self.unit == "N" and (found.name != "error" or self.error_type == "absolute")
            return SCALAR["peak_positive_tangential_force"].noise if newtons else HISTORY_METRIC[self.metric].noise
        own = SCALAR[self.quantity].noise
        if found.name != "error" or self.error_type != "relative" or not self.reference:
            return own
        # a relative error moves as far as its prediction, over the reference
        return Noise(own.relative, own.relative + own.absolute / abs(self.reference))

    def _noise_of_a_part(self, coverage: float) -> Noise:
        """Return the noise of what a finer pass changes: a small difference of two values, each with its own noise."""
        value = 1.0 if self.error_type == "relative" else abs(self.predicted or 0.0)
        return Noise(PART.relative, PART.absolute + coverage * SCALAR[self.quantity].noise.relative * value)

    def of_run(self, status: str, note: str) -> MetricRow:
        """Return the row with the reference's status, where that is not current."""
        return (
            self
            if status == "current"
            else replace(self, status=status, note="; ".join(filter(None, (self.note, note))))
        )

    def marked(self, assumed: str) -> MetricRow:
        """Return the row with the assumed and synthetic inputs it depends on."""
        return replace(self, assumed=assumed)

    def hinted(self, hint: str) -> MetricRow:
        """Return the row with what looks like a mistake of the user's in its note."""
        return replace(self, note="; ".join(part for part in (hint, self.note) if part)) if hint else self


@table_row
class Ensemble(TableRow):
    """Summary of the rows of one quantity and metric over a group of cases."""

    table = "ensemble"
    title = "Statistics of the errors over groups of cases"
    key = ("group", "predicted_source", "reference_source", "quantity", "metric")

    group: str = column("`all`, `rig`, `belt`, `published` (the rig without 0.3 mm), or a shape of block on the rig")
    quantity: str = column("scalar, or force whose histories are compared")
    metric: str = column(METRIC)
    reference_source: str = column(SOURCE)
    predicted_source: str = column(SOURCE)
    unit: str = column("unit of the errors; 1 for a relative one or a score")
    error_type: ErrorType = column(ERROR_TYPE)
    cases: int = column("cases of the group")
    compared: int = column("cases with an error")
    passed: int = column("cases whose |E| is within its tolerance, uncertainty apart")
    adequate: int = column("cases whose assessment is `adequate`")
    inadequate: int = column("cases whose assessment is `inadequate`")
    agrees: int = column("cases whose |E| is within its uncertainty")
    criterion: str = column("what the tolerance is, in words")
    mean_uncertainty: float | None = column("mean of U over the cases where it is known", noise=PART)
    mean_abs_error: float | None = column("mean of |error|", noise=Noise(1e-5, 1e-4))
    largest_abs_error: float | None = column("largest |error|", noise=Noise(1e-5, 1e-4))
    largest_case_id: str = column("the case that has it")
    bias: float | None = column(
        "factor by which the model exceeds the reference on average; 1 is none", noise=Noise(1e-4, 0.0)
    )
    model_scatter: float | None = column("sigma_M, the model's own relative scatter", noise=SCATTER)
    total_scatter: float | None = column("standard deviation of ln(predicted/reference)", noise=SCATTER)
    area_metric: float | None = column(
        "area between the two distributions of values over the cases, over the mean |reference|", noise=SCATTER
    )
    reference_scatter: float | None = column("sigma_E, the reference's relative uncertainty", noise=SCATTER)
    status: str = column(STATUS)
    note: str = column(NOTE, free=True)
    assumed: str = column(ASSUMED)

    def noise(self, found: TableColumn) -> Noise:
        """Return the noise of the scores for errors that are scores, and of the quantity for those in its unit."""
        if found.name not in ("mean_abs_error", "largest_abs_error"):
            return found.noise
        if self.metric != "scalar":
            return found.noise if self.error_type == "absolute" else HISTORY_METRIC[self.metric].noise
        return SCALAR[self.quantity].noise if self.error_type == "absolute" else found.noise


@table_row
class Sensitivity(TableRow):
    """One score under one variation of how it is taken."""

    table = "sensitivity"
    title = "How much each score hangs on window and sampling"
    key = ("metric", "quantity", "case_id", "variation")

    metric: str = column(METRIC)
    quantity: str = column("force whose histories are compared")
    case_id: str = column("name of the case")
    variation: str = column("what was varied")
    samples: int = column("samples of both histories")
    value: float = column("the score")
    change: float = column("the score less that reported")

    def noise(self, found: TableColumn) -> Noise:
        """Return the noise of the score."""
        return HISTORY_METRIC[self.metric].noise if found.kind == "number" else found.noise
