"""A model of the user's own is a level like the others: error against what its run has cost."""

from __future__ import annotations

import pytest
import yaml

from tread_validate.compare.runs import SourceRun
from tread_validate.errors import InputError
from tread_validate.hierarchy.own_models import own_rows
from tread_validate.hierarchy.pareto import case_row, pareto_rows
from tread_validate.history import History
from tread_validate.models.run import run_model
from tread_validate.models.single import history_of
from tread_validate.models.skeleton import skeleton
from tread_validate.spring import resolve_creep
from tread_validate.study import load_study


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("own")
    files = skeleton("mine", "python")
    (folder / "mine.py").write_text(files["mine.py"])
    data = yaml.safe_load(files["study.yaml"])
    data["runs"][0].update(speed_rpm=[300.0], interference_mm=[0.2])
    (folder / "study.yaml").write_text(yaml.safe_dump(data, sort_keys=False))
    return load_study(folder / "study.yaml")


def test_level_has_the_error_against_its_reference_and_the_cost_of_its_run(study, tmp_path):
    """A reference of 1/1.25 the model's own forces: an error of 25 %; time and memory as the run's outcome has them."""
    cases = resolve_creep(study.cases())
    run_model(study, "mine", cases, tmp_path / "mine", trusted=True)
    references = {}
    for case in cases:
        own = History.read_csv(tmp_path / "mine" / f"{case.case_id}.csv")
        made = History.of(own.time, own.normal_force / 1.25, own.tangential_force)
        references["fe:embedded", case.case_id] = SourceRun("fe:embedded", case.case_id, "current", history=made)
    rows = own_rows(study, cases, references, tmp_path)
    assert [row["peak_normal_force_error"] for row in rows] == pytest.approx([0.25] * len(cases), abs=1e-5)
    assert all(row["seconds"] > 0.0 and row["memory_MB"] > 1.0 for row in rows)
    whole = pareto_rows(rows, cases)[0]
    assert (whole["level"], whole["group"], whole["compared"]) == ("model:mine", "all", len(cases))
    assert whole["memory_MB"] == max(row["memory_MB"] for row in rows)


def test_what_a_model_does_not_give_stays_open_in_its_level(study):
    (case, *_) = resolve_creep(study.cases())
    full = history_of(study, "mine", case, trusted=True)
    reference = SourceRun("fe:embedded", case.case_id, "current", history=full)
    normal_only = SourceRun("model:x", case.case_id, "current", history=History.of(full.time, full.normal_force))
    row = case_row("model:x", case, reference, normal_only, seconds=None)
    assert row["peak_normal_force_error"] == 0.0
    assert row["tangential_error"] is None
    (whole, *_) = pareto_rows([row], [case])
    assert whole["seconds_per_pass"] is None
    assert whole["tangential_within"] is None


def test_single_run_needs_trust_like_any(study):
    with pytest.raises(InputError, match="trust"):
        history_of(study, "mine", study.cases()[0])
