"""What the validity map expects of a run, beside the error that it has."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from tread_validate.compare.expected_errors import actual_errors, expected_rows
from tread_validate.compare.quantities.scalars import Scalars
from tread_validate.compare.runs import SourceRun
from tread_validate.compare.tables import ExpectedRow, read_rows
from tread_validate.spring import resolve_creep
from tread_validate.study import load_study
from tread_validate.validity import expected_error

FORCES = {
    "peak_normal_force": 100.0,
    "normal_impulse": 0.5,
    "peak_positive_tangential_force": 20.0,
    "peak_negative_tangential_force": -10.0,
}


def run(source: str, **changed: float) -> SourceRun:
    return SourceRun(source, "c", "current", scalars=Scalars(FORCES | changed))


def test_errors_are_those_of_the_map() -> None:
    """N 103 for 100, impulse 0.45 for 0.5, T- -13 for -10 over the larger peak of 20: 3, -10 and 15 %."""
    model = run("spring:a", peak_normal_force=103.0, normal_impulse=0.45, peak_negative_tangential_force=-13.0)
    found = actual_errors(model, run("fe:embedded"))
    assert found == pytest.approx({"normal": 0.03, "impulse": -0.1, "tangential": 0.15})
    assert actual_errors(replace(model, scalars=None), run("fe:embedded")) == {}


def test_a_block_that_is_hardly_sheared_is_judged_by_its_normal_force() -> None:
    """Peaks of T of 0.5 and -0.2 N beside N = 100 N: over 2 N, a fiftieth of it."""
    small = {"peak_positive_tangential_force": 0.5, "peak_negative_tangential_force": -0.2}
    found = actual_errors(run("spring:a", **{**small, "peak_positive_tangential_force": 0.9}), run("fe:b", **small))
    assert found["tangential"] == pytest.approx(0.4 / 2.0)


def test_every_prediction_carries_what_the_map_expects_of_it(paper_study: Path) -> None:
    """Rows for each model, engine and quantity; without a reference the expectation stands alone."""
    case = resolve_creep(load_study(paper_study).cases()[:1])[0]
    runs = {(source, case.case_id): run(source) for source in ("spring:paper", "spring:light", "fe:embedded")}
    runs["spring:paper", case.case_id] = run("spring:paper", peak_normal_force=70.0)
    rows = list(expected_rows([case], runs, ["spring:paper", "spring:light", "fe:embedded"]))
    assert len(rows) == 6
    first, known = rows[0], expected_error(case, "paper")
    assert (first.expected, first.actual) == (known.normal, pytest.approx(-0.3))
    assert first.inside == (known.likely["normal"] >= 0.3)
    assert first.outside_map == "; ".join(known.outside)
    other = rows[3]
    assert (other.predicted_source, other.expected, other.inside) == ("spring:light", None, None)
    assert "0 points" in other.outside_map
    runs["fe:embedded", case.case_id] = SourceRun("fe:embedded", case.case_id, "missing", "no run")
    alone = next(expected_rows([case], runs, ["spring:paper", "fe:embedded"]))
    assert (alone.expected, alone.actual, alone.inside, alone.status) == (known.normal, None, None, "missing")


def test_the_tables_of_a_study_hold_it(workspace: Any) -> None:
    rows = read_rows(workspace.tables / "expected.csv", ExpectedRow)
    assert {row.quantity for row in rows} == {"normal", "impulse", "tangential"}
    assert all(row.actual is not None for row in rows if row.status == "current")
