"""Comparison of runs with their references: rows, ensembles, regressions, claims, tables and the baseline."""

from .comparison import compare, empty_rows
from .ensemble import bias_and_scatter
from .regression import regress
from .rows import METRIC_COLUMNS, MetricRow, verdict
from .scalars import Scalars, contact_window, scalars
from .study_comparison import Comparison, compare_study
from .tables import build_tables, write_tables

__all__ = [
    "METRIC_COLUMNS", "Comparison", "MetricRow", "Scalars", "bias_and_scatter", "build_tables", "compare",
    "compare_study", "contact_window", "empty_rows", "regress", "scalars", "verdict", "write_tables",
]  # fmt: skip
