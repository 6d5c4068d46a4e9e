"""Comparison of runs with their references: rows, ensembles, regressions, claims, tables and the baseline."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..callable_module import make_callable
from ..later import loaded

if TYPE_CHECKING:
    from .build import build_tables, write_tables
    from .quantities import Scalars, contact_window, scalars
    from .regression.line import regress
    from .scores.assessment import assessment
    from .scores.comparison import compare, empty_rows
    from .scores.ensemble import bias_and_scatter
    from .study_comparison import StudyComparison, compare_study
    from .tables import MetricRow

__all__ = [
    "MetricRow",
    "Scalars",
    "StudyComparison",
    "assessment",
    "bias_and_scatter",
    "build_tables",
    "compare",
    "compare_study",
    "contact_window",
    "empty_rows",
    "regress",
    "scalars",
    "write_tables",
]  # fmt: skip

_LATER = {
    "MetricRow": ".tables",
    "Scalars": ".quantities",
    "StudyComparison": ".study_comparison",
    "assessment": ".scores.assessment",
    "bias_and_scatter": ".scores.ensemble",
    "build_tables": ".build",
    "compare": ".scores.comparison",
    "compare_study": ".study_comparison",
    "contact_window": ".quantities",
    "empty_rows": ".scores.comparison",
    "regress": ".regression.line",
    "scalars": ".quantities",
    "write_tables": ".build",
}


def __getattr__(name: str) -> Any:
    return loaded(__name__, _LATER, name)


make_callable(__name__, "tread_validate.api:compare")
