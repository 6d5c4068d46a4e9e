"""Rows of the published statements: as printed, and next to what is computed."""

from __future__ import annotations

from typing import Literal

from ..quantities import Noise
from .row import TableColumn, TableRow, column, table_row
from .runs import ASSUMED, NOTE, SOURCE, STATUS

ClaimAssessment = Literal["agrees", "disagrees", "cannot tell"]
OF_SAMPLES = ("rig_peak_at_centre", "belt_slip_at_exit")  # read off at one sample of a history
SPREAD_KIND = "what the interval is: sd, range, rounding, last digit, about, sign, exact, exists, grade or none"


@table_row
class ClaimRow(TableRow):
    """One published number next to one computed number."""

    table = "claims"
    title = "Published statements and what is found here"
    key = ("claim_id", "source")

    claim_id: str = column("name of the statement")
    kind: str = column(
        "what agreement would be worth: `input`, the study uses the number; `study`, it follows from the inputs; "
        "`tuned`, a surrogate was made to meet it; `model`, runs give it; `published`, arithmetic on printed numbers; "
        "`context`, not compared"
    )
    section: str = column("section of the paper")
    statement: str = column("what it says")
    quantity: str = column("the quantity")
    unit: str = column("unit, as printed")
    published: float | None = column("the printed value, in `unit`")
    published_low: float | None = column("lower end of the interval it stands for, in `unit`")
    published_high: float | None = column("upper end of the interval it stands for, in `unit`")
    spread_kind: str = column(SPREAD_KIND)
    source: str = column(SOURCE + "; `study` where no run is behind it")
    case_ids: tuple[str, ...] = column("the cases behind it")
    computed: float | None = column("the computed value, in `unit`", noise=Noise(1e-4, 1e-6))
    error: float | None = column("of the computed value, as `error_type` says", noise=Noise(1e-4, 1e-6))
    error_type: str = column("`relative` or `absolute`")
    assessment: ClaimAssessment = column("`agrees`, `disagrees` or `cannot tell`")
    status: str = column(STATUS + "; `not_compared` for context")
    note: str = column(NOTE, free=True)
    assumed: str = column(ASSUMED)

    def noise(self, found: TableColumn) -> Noise:
        """Return that of the statement, where it stands for an instant or for a share that slips."""
        of_samples = found.name in ("computed", "error") and self.claim_id in OF_SAMPLES
        return Noise(0.0, 2e-3) if of_samples else found.noise


@table_row
class PublishedRow(TableRow):
    """A number that the paper prints, as the reference data package has it."""

    table = "published"
    title = "Every number in the paper's text and how it is used"
    key = ("id",)

    id: str = column("name of the statement")
    quantity: str = column("the quantity")
    value: float | None = column("the printed value, in `unit`")
    unit: str = column("unit, as printed")
    low: float | None = column("lower end of the interval it stands for")
    high: float | None = column("upper end of the interval it stands for")
    spread_kind: str = column(SPREAD_KIND)
    section: str = column("section of the paper")
    statement: str = column("what it says")
    comparability: str = column("`computed`, `input` or `context`")
    comparison: str = column("how it is compared, or why not")
