"""Every table of the results, in the order in which one follows from another."""

from __future__ import annotations

from .errors import Ensemble, MetricRow, Sensitivity, ToleranceRow
from .expected import ExpectedRow
from .row import TableRow
from .runs import AssumedRow, CaseRow, PeakRow
from .slopes import Coefficient, Difference, Residual
from .statements import ClaimRow, PublishedRow
from .statistics import StatisticsRow

TABLES: dict[str, type[TableRow]] = {
    kind.table: kind
    for kind in (
        CaseRow,
        AssumedRow,
        PublishedRow,
        ToleranceRow,
        PeakRow,
        StatisticsRow,
        MetricRow,
        ExpectedRow,
        Coefficient,
        Ensemble,
        Sensitivity,
        Residual,
        Difference,
        ClaimRow,
    )
}
