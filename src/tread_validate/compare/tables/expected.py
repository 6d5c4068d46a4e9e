"""Rows of what the validity map lets a reader expect of each prediction, beside what came out."""

from __future__ import annotations

from typing import Literal

from ..quantities import Noise
from .row import TableRow, column, table_row
from .runs import ASSUMED, SOURCE, STATUS

Expected = Literal["normal", "impulse", "tangential"]
SHARE = Noise(1e-4, 1e-5)


@table_row
class ExpectedRow(TableRow):
    """The error of one quantity that the validity map expects of one model's run, and the actual one."""

    table = "expected"
    title = "The error that the validity map expects of each model's run beside the actual one"
    key = ("predicted_source", "reference_source", "case_id", "quantity")

    case_id: str = column("name of the case")
    predicted_source: str = column(SOURCE)
    reference_source: str = column(SOURCE)
    quantity: Expected = column(
        "`normal`: peak of N, `impulse`: of N, both over the reference's; `tangential`: peaks of T, the one that is "
        "further out, over the larger one of the reference"
    )
    expected: float | None = column("size of the error to expect: root mean square of the nearest points", noise=SHARE)
    limit: float | None = column("what nine in ten errors stay below", noise=SHARE)
    actual: float | None = column(
        "error of the run, signed but for T; empty where there is nothing to compare it with", noise=Noise(0.0, 2e-4)
    )
    inside: bool | None = column("whether the size of the actual error is at most the limit; empty without one of them")
    outside_map: str = column("why the case lies outside the map, `; ` between reasons; empty inside it")
    map_made_by: str = column("empty, or what of model and engine has changed since the map was made")
    status: str = column(STATUS)
    assumed: str = column(ASSUMED, default="")
