"""What a study comes to, as data: models, references, baseline, assumptions in one small file."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from ..files import write_text
from .baseline.delta import Check
from .baseline.movement import Movement
from .quantities import HEADLINE
from .tables import AssumedRow, Ensemble, MetricRow, PeakRow, cell, read_rows

SUMMARY = "summary.json"
SCHEMA_VERSION = 1
GRADES = ("excellent", "good", "fair", "poor")


def write_summary(tables: Path, study: str, check: Check | None = None, moved: Sequence[Movement] = ()) -> None:
    """Write ``summary.json`` beside the tables; the baseline is null where no check was made.

    Errors are fractions, or in the unit that stands beside them; scores stand as they are.
    """
    peaks = read_rows(tables / "peaks.csv", PeakRow)
    facts = {
        "schema_version": SCHEMA_VERSION,
        "study": study,
        "models": _models(tables),
        "references": _states(peaks),
        "baseline": None if check is None else _baseline(check, moved),
        "assumed_inputs": [
            {"input": row.input, "origin": row.origin, "cases": row.cases}
            for row in read_rows(tables / "assumed.csv", AssumedRow)
        ],
    }
    write_text(tables / SUMMARY, json.dumps(facts, indent=1, ensure_ascii=False) + "\n")


def _models(tables: Path) -> list[dict[str, Any]]:
    statistics = read_rows(tables / "ensemble.csv", Ensemble)
    errors = read_rows(tables / "errors.csv", MetricRow)
    peaks = read_rows(tables / "peaks.csv", PeakRow)
    found = []
    for pair in dict.fromkeys((row.predicted_source, row.reference_source) for row in statistics):
        own = [row for row in errors if (row.predicted_source, row.reference_source) == pair]
        whole = {
            (row.quantity, row.metric): row
            for row in statistics
            if row.group == "all" and (row.predicted_source, row.reference_source) == pair
        }
        found.append(
            {
                "model": pair[0],
                "reference": pair[1],
                "runs": _counts(row.status for row in peaks if row.source == pair[0]),
                "assessment": _assessment(whole[HEADLINE[0]]) if HEADLINE[0] in whole else "cannot tell",
                "quantities": [_quantity(whole[key], own) for key in HEADLINE if key in whole],
            }
        )
    return found


def _quantity(row: Ensemble, errors: Sequence[MetricRow]) -> dict[str, Any]:
    """Return one headline quantity of one model: errors, what is good enough, uncertainty and assessments."""
    own = [item for item in errors if (item.quantity, item.metric) == (row.quantity, row.metric)]
    worst = next((item for item in own if item.case_id == row.largest_case_id), None)
    found = {
        "quantity": row.quantity,
        "metric": row.metric,
        "unit": row.unit,
        "error_type": row.error_type,
        "cases": row.cases,
        "compared": row.compared,
        "mean_abs_error": _printed(row.mean_abs_error),
        "largest_abs_error": _printed(row.largest_abs_error),
        "largest_case": row.largest_case_id,
        "mean_uncertainty": _printed(row.mean_uncertainty),
        "criterion": row.criterion,
        "tolerance_of_largest": _printed(None if worst is None else worst.tolerance),
        "adequate": row.adequate,
        "inadequate": row.inadequate,
        "cannot_tell": row.cases - row.adequate - row.inadequate,
        "assessment": _assessment(row),
        "agrees_within_uncertainty": row.agrees,
        "bias": _printed(row.bias),
        "model_scatter": _printed(row.model_scatter),
        "reference_scatter": _printed(row.reference_scatter),
        "area_metric": _printed(row.area_metric),
    }
    if row.metric == "iso18571_r":
        grades = Counter(item.grade for item in own if item.grade)
        found["grades"] = {grade: grades[grade] for grade in GRADES}
    return found


def _assessment(row: Ensemble) -> str:
    """Say what all cases come to: adequate only where every one is, inadequate where any is not."""
    if row.inadequate:
        return "inadequate"
    return "adequate" if row.adequate == row.cases else "cannot tell"


def _states(peaks: Sequence[PeakRow]) -> dict[str, dict[str, int]]:
    sources = dict.fromkeys(row.source for row in peaks if row.source.startswith(("fe:", "rig:")))
    return {source: _counts(row.status for row in peaks if row.source == source) for source in sources}


def _baseline(check: Check, moved: Sequence[Movement]) -> dict[str, Any]:
    failed = check.failed
    return {
        "rows": check.rows,
        "moved_rows": len({(row.in_table, row.row_key) for row in failed}),
        "flips": [
            {"row": row.name, "column": row.in_column, "was": row.baseline, "is": row.current} for row in check.flips
        ],
        "by_kind": _counts(row.kind for row in failed),
        "models": [
            {
                "model": item.predicted_source,
                "reference": item.reference_source,
                "quantity": item.quantity,
                "metric": item.metric,
                "better": item.better,
                "worse": item.worse,
                "largest_change_case": item.case_id,
                "before": _printed(item.before),
                "now": _printed(item.now),
                "unit": item.unit,
            }
            for item in moved
        ],
    }


def _counts(words: Iterable[str]) -> dict[str, int]:
    return dict(sorted(Counter(words).items()))


def _printed(value: float | None) -> float | None:
    """Return a number with the digits that the tables print."""
    return None if value is None else float(cell(float(value)))
