"""Comparison of runs with their references: rows, ensembles, regressions, claims, tables and the baseline."""

from .build import build_tables, write_tables
from .regression.line import regress
from .scores.comparison import compare, empty_rows
from .scores.ensemble import bias_and_scatter
from .scores.rows import METRIC_COLUMNS, MetricRow, verdict
from .scores.scalars import Scalars, contact_window, scalars
from .study_comparison import Comparison, compare_study

__all__ = [
    "METRIC_COLUMNS", "Comparison", "MetricRow", "Scalars", "bias_and_scatter", "build_tables", "compare",
    "compare_study", "contact_window", "empty_rows", "regress", "scalars", "verdict", "write_tables",
]  # fmt: skip
