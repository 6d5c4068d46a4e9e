"""A model of the user's own is judged like a built-in one, by what it gives."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

from tread_validate.compare import compare
from tread_validate.compare.model_runs import model_runs
from tread_validate.history import History
from tread_validate.models.run import run_model
from tread_validate.models.skeleton import skeleton
from tread_validate.spring import resolve_creep
from tread_validate.study import load_study

TIME = np.linspace(0.0, 0.012, 601)
NORMAL = 200.0 * np.sin(np.pi * TIME / 0.012) ** 2
TANGENTIAL = 60.0 * np.sin(2.0 * np.pi * TIME / 0.012)
REFERENCE = History.of(TIME, NORMAL, TANGENTIAL, np.zeros(TIME.size))


def rows_of(predicted, uncertainty=0.01):
    rows = compare(REFERENCE, predicted, uncertainty=uncertainty)
    return {(row.quantity, row.metric): row for row in rows}


def test_blind_bias_of_five_per_cent_and_three_newtons_comes_out_as_such():
    """N times 1.05; T less 3 N while the block carries more than it: the peaks move by exactly that."""
    shifted = TANGENTIAL - 3.0 * (NORMAL > 3.0)
    rows = rows_of(History.of(TIME, 1.05 * NORMAL, shifted))
    normal = rows["peak_normal_force", "scalar"]
    assert normal.error == pytest.approx(0.05, abs=1e-12)
    assert normal.assessment == "adequate"
    for sign in ("positive", "negative"):
        row = rows[f"peak_{sign}_tangential_force", "scalar"]
        assert row.predicted - row.reference == pytest.approx(-3.0, abs=1e-9)
    assert rows["normal_impulse", "scalar"].error == pytest.approx(0.05, rel=2e-3)


def test_what_a_model_leaves_out_is_not_given_and_the_rest_is_judged():
    rows = rows_of(History.of(TIME, 1.01 * NORMAL))
    assert rows["peak_normal_force", "scalar"].assessment == "adequate"
    assert rows["normal_force", "iso18571_r"].assessment == "adequate"
    for key in (
        ("peak_positive_tangential_force", "scalar"),
        ("net_tangential_impulse", "scalar"),
        ("slipping_share", "scalar"),
        ("tangential_force", "relative_rms"),
        ("tangential_force", "iso18571_r"),
    ):
        assert rows[key].status == "not_given"
        assert rows[key].assessment == "cannot tell"
        assert rows[key].error is None


@pytest.mark.parametrize(("factor", "word"), [(1e-3, "less"), (1e3, "more")])
def test_newtons_taken_for_kilonewtons_are_pointed_out_and_not_corrected(factor, word):
    row = rows_of(History.of(TIME, factor * NORMAL))["peak_normal_force", "scalar"]
    assert f"{word} than the reference by a factor of 1000" in row.note
    assert row.predicted == pytest.approx(factor * 200.0)
    assert row.assessment == "inadequate"


def test_tangential_force_with_its_sign_turned_is_pointed_out():
    assert "mirror image" in rows_of(History.of(TIME, NORMAL, -TANGENTIAL))["tangential_force", "relative_rms"].note
    assert "mirror image" not in rows_of(History.of(TIME, NORMAL, TANGENTIAL))["tangential_force", "relative_rms"].note


@pytest.fixture
def study(tmp_path):
    files = skeleton("mine", "python")
    (tmp_path / "mine.py").write_text(files["mine.py"])
    data = yaml.safe_load(files["study.yaml"])
    data["runs"][0]["speed_rpm"] = [300.0]
    (tmp_path / "study.yaml").write_text(yaml.safe_dump(data, sort_keys=False))
    return load_study(tmp_path / "study.yaml")


def test_run_counts_as_long_as_case_and_model_are_as_they_were(study, tmp_path):
    cases = resolve_creep(study.cases())
    source, key = "model:mine", ("model:mine", cases[0].case_id)
    assert model_runs(study, cases, tmp_path / "out")[key].status == "missing"
    run_model(study, "mine", cases, tmp_path / "out" / "mine", trusted=True)
    runs = model_runs(study, cases, tmp_path / "out")
    assert {run.status for run in runs.values()} == {"current"}
    assert runs[key].source == source
    assert runs[key].scalars.peak_normal_force > 10.0

    code = tmp_path / "mine.py"
    text = code.read_text()
    code.write_text(text.replace("TIMES = 600", "TIMES = 601"))
    assert model_runs(study, cases, tmp_path / "out")[key].status == "stale"
    code.write_text(text)
    assert model_runs(study, cases, tmp_path / "out")[key].status == "current"

    history = tmp_path / "out" / "mine" / f"{cases[0].case_id}.csv"
    history.write_text("".join(line for line in history.read_text().splitlines(True) if "case_digest" not in line))
    assert model_runs(study, cases, tmp_path / "out")[key].status == "unbound"
