"""A Python function as a model, in a process of its own."""

from __future__ import annotations

import numpy as np
import pytest

import tread_validate as tv
from tread_validate.errors import InputError
from tread_validate.history import History
from tread_validate.models.run import run_model
from tread_validate.spring import resolve_creep
from tread_validate.study import load_study

SINE = """
import numpy as np

def forces(case):
    print("noise on standard output")
    t = np.linspace(0.0, case.expected_duration_s, 60)
    return t, 100.0 * np.sin(np.pi * t / t[-1]) ** 2{more}
"""


@pytest.fixture
def run_function(tmp_path, study_with):
    def run(source, cases=2, **keys):
        (tmp_path / "my_block.py").write_text(source)
        study = load_study(study_with(kind="python", object="my_block:forces", **keys))
        return run_model(study, "mine", resolve_creep(study.cases()[:cases]), tmp_path / "out", trusted=True)

    return run


def test_function_beside_its_study_is_found_and_may_print(run_function, tmp_path):
    outcomes = run_function(SINE.format(more=", -0.1 * t"))
    assert [outcome.message for outcome in outcomes] == ["", ""]
    history = History.read_csv(tmp_path / "out" / f"{outcomes[0].case_id}.csv")
    assert history.normal_force.max() == pytest.approx(100.0, rel=1e-2)
    assert history.provenance["producer"] == "model/mine"
    assert "noise" in (tmp_path / "out" / "model.log").read_text()


def test_model_without_tangential_force_gives_none(run_function, tmp_path):
    (outcome, _) = run_function(SINE.format(more=""))
    assert not History.read_csv(tmp_path / "out" / f"{outcome.case_id}.csv").gives_tangential


@pytest.mark.parametrize(
    ("body", "said"),
    [
        ("raise ValueError('no such rubber')", "ValueError: no such rubber"),
        ("return None", "the function's result"),
        ("return [1.0, 2.0], ['a', 'b']", "arrays of numbers"),
        ("return np.arange(5.0), np.arange(4.0)", "shape"),
        ("import os; os._exit(7)", "exit code 7"),
        ("import time; time.sleep(60)", "time limit of 1 s"),
    ],
)
def test_fault_of_one_case_is_one_line_and_the_other_case_runs(body, said, run_function):
    source = SINE.format(more="").replace("    print", f"    if case.speed_m_s < 2.0:\n        {body}\n    print")
    failed, ran = run_function(source, time_limit_s=1.0)
    assert said in failed.message
    assert "\n" not in failed.message
    assert ran.status == "ran"


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("forces = 3.0", "a function"),
        ("def other(case): pass", "can be imported"),
        ("import no_such_module", "no_such_module"),
    ],
)
def test_object_that_is_no_function_fails_every_case_by_name(source, said, run_function):
    outcomes = run_function(source)
    assert all(said in outcome.message for outcome in outcomes)


def test_function_handed_to_run_is_checked_like_a_model_of_the_study(paper_study):
    case = tv.load_study(paper_study).case("rig-rectangle-22c-0p2mm-300rpm")

    def flat(document):
        time = np.linspace(0.0, document.expected_duration_s, 50)
        return time, np.full(50, 10.0)

    history = tv.run(case, model=flat)
    assert history.provenance["case_digest"] == case.problem_digest()
    with pytest.raises(InputError, match="whole pass"):
        tv.run(case, model=lambda document: tuple(part[:9] for part in flat(document)))
