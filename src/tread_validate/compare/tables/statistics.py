"""Rows of means and scatter: what can be compared where no history is reliable."""

from __future__ import annotations

from ..quantities import Noise
from .row import TableRow, column, table_row
from .runs import ASSUMED, SOURCE, STATUS

MEAN = Noise(1e-4, 1e-4)


@table_row
class StatisticsRow(TableRow):
    """Statistics of one run over its contact, of runs that are no reference too; empty where there is no history."""

    table = "statistics"
    title = "Means, scatter and frequency of every run: all that is comparable where stick and slip alternate"
    key = ("source", "case_id")

    source: str = column(SOURCE)
    case_id: str = column("name of the case")
    mean_normal_N: float | None = column("mean of N over the contact", "N", noise=MEAN)
    mean_tangential_N: float | None = column("mean of T over the contact", "N", noise=MEAN)
    rms_tangential_N: float | None = column("root mean square of T over the contact", "N", noise=MEAN)
    scatter_N: float | None = column(
        "root mean square of T about its mean over 5 % of the contact", "N", noise=Noise(1e-3, 1e-3)
    )
    frequency_Hz: float | None = column("of that scatter; empty below 0.2 % of the peak of N", "Hz", free=True)
    alternates: bool = column("whether the run says that stick and slip alternate: no history of it is reliable")
    status: str = column(STATUS)
    assumed: str = column(ASSUMED, default="")
