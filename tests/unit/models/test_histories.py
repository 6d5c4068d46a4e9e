"""Histories made elsewhere count only where it is known what they were made for."""

from __future__ import annotations

import pytest

from tread_validate.models.run import run_model
from tread_validate.spring import resolve_creep
from tread_validate.study import load_study, problems_digest


@pytest.fixture
def read(tmp_path, study_with):
    def run(head="", **keys):
        study = load_study(study_with(kind="histories", folder="made", **keys))
        cases = resolve_creep(study.cases()[:2])
        (tmp_path / "made").mkdir()
        for case in cases:
            text = head.format(digest=case.problem_digest()) + "time_s,normal_force_N\n0,0\n0.01,50\n0.04,0\n"
            (tmp_path / "made" / f"{case.case_id}.csv").write_text(text)
        return run_model(study, "mine", cases, tmp_path / "out")

    return run


def test_history_that_carries_its_case_s_digest_is_bound(read):
    assert [outcome.message for outcome in read("# case_digest: {digest}\n")] == ["", ""]


def test_history_without_digest_and_without_a_statement_is_refused(read):
    outcomes = read()
    assert all("nobody can tell which case" in outcome.message for outcome in outcomes)


def test_statement_binds_histories_as_long_as_the_study_stays_as_it_was(read, study_with):
    digest = problems_digest(load_study(study_with(kind="histories", folder="made")).cases())
    outcomes = read(made_for=digest, statement="exported from the same four runs on 1 June")
    assert [outcome.message for outcome in outcomes] == ["", ""]


def test_statement_about_another_study_binds_nothing(read):
    outcomes = read(made_for="0" * 64, statement="exported from other runs")
    assert all("the study's inputs have changed" in outcome.message for outcome in outcomes)
