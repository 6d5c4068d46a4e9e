"""The tables of the results: what they hold, declared once, and how they are written and read.

A column is a field of a row class. The writer, the reader, the report, the baseline and the data package take it from
there.
"""

from .catalogue import TABLES
from .delta import Delta, Outcome, TrendRow
from .errors import Agreement, Assessment, Ensemble, MetricRow, Sensitivity, ToleranceRow
from .expected import ExpectedRow
from .package import write_package
from .row import TableColumn, TableRow, column
from .runs import AssumedRow, CaseRow, PeakRow
from .slopes import Coefficient, Difference, Residual
from .statements import ClaimAssessment, ClaimRow, PublishedRow
from .statistics import StatisticsRow
from .text import cell, read_rows, rows_text, table_text, write_rows, write_table

__all__ = [
    "TABLES",
    "Agreement",
    "Assessment",
    "AssumedRow",
    "CaseRow",
    "ClaimAssessment",
    "ClaimRow",
    "Coefficient",
    "Delta",
    "Difference",
    "Ensemble",
    "ExpectedRow",
    "MetricRow",
    "Outcome",
    "PeakRow",
    "PublishedRow",
    "Residual",
    "Sensitivity",
    "StatisticsRow",
    "TableColumn",
    "TableRow",
    "ToleranceRow",
    "TrendRow",
    "cell",
    "column",
    "read_rows",
    "rows_text",
    "table_text",
    "write_package",
    "write_rows",
    "write_table",
]  # fmt: skip
