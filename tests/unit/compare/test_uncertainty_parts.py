"""Where the parts of an uncertainty come from: mesh and step of the models, spread of the assumed inputs."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.compare.input_spread import input_spreads
from tread_validate.compare.numerical import numerical_uncertainties
from tread_validate.errors import InputError
from tread_validate.spring import resolve_creep, run
from tread_validate.study import Case, conditions_digest, load_study


@pytest.fixture(scope="module")
def cases(paper_study: Path) -> tuple[Case, ...]:
    """The cases of the paper's study, creep ratios known."""
    return tuple(resolve_creep(load_study(paper_study).cases()))


def belt(cases: tuple[Case, ...], element_mm: float) -> Case:
    """A belt case on springs of one length."""
    case = next(case for case in cases if case.path.family == "belt" and not case.free_rolling)
    return replace(case, spring=case.spring.model_copy(update={"element_length_mm": element_mm}))


def test_the_numerical_uncertainty_covers_the_distance_to_a_fine_run(cases: tuple[Case, ...]) -> None:
    """k u_num of the peak on springs of 2 mm is at least its distance from the peak on springs of 0.25 mm, and no more
    than ten times that: an uncertainty, not a blanket.
    """
    case = belt(cases, 2.0)
    known = numerical_uncertainties([case], "paper")[case.path_name, case.block_name]
    coarse, fine = (run(item, "paper").normal_force.max() for item in (case, belt(cases, 0.25)))
    distance = abs(coarse - fine) / fine
    assert distance <= 2.0 * known["peak_normal_force"] <= 10.0 * distance


def test_springs_are_converged(cases: tuple[Case, ...]) -> None:
    """The model keeps its own step small enough: the normal force history is within 1e-4 on springs of 2 mm already,
    and nearer on those of 0.5 mm.
    """
    sizes = [
        numerical_uncertainties([case], "paper")[case.path_name, case.block_name]["normal_force"]
        for case in (belt(cases, 2.0), belt(cases, 0.5))
    ]
    assert sizes[1] < sizes[0] < 1e-4


def test_every_path_and_block_has_its_own(cases: tuple[Case, ...]) -> None:
    """Rig with two blocks and two belts: four entries, each with both histories and every scalar but yes or no."""
    known = numerical_uncertainties(cases, "paper")
    assert set(known) == {(case.path_name, case.block_name) for case in cases}
    assert len(known) == 4
    for entry in known.values():
        assert {"peak_normal_force", "normal_impulse", "normal_force", "tangential_force"} <= set(entry)
        assert "late_sign_change" not in entry
        assert all(value >= 0.0 for value in entry.values())


@pytest.fixture
def hierarchy(tmp_path: Path, cases: tuple[Case, ...]) -> Path:
    """A sensitivity study of one rig and one belt case: standard deviations 10 % and 20 % of the mean."""
    rows = ["run,quantity,unit,input,mean,sd"]
    rig, tyre = (next(case for case in cases if case.path.on_tyre == kind) for kind in (False, True))
    for case, sd in ((rig, 10.0), (tyre, 20.0)):
        rows += [f"{case.case_id},peak normal force,N,{name},100.0,{sd}" for name in ("modulus", "rate")]
    (tmp_path / "sobol.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    record = {"study": "liu2010", "study_digest": conditions_digest(cases)}
    (tmp_path / "record.yaml").write_text(yaml.safe_dump(record), encoding="utf-8")
    return tmp_path


def test_the_spread_of_the_inputs_is_that_of_the_sensitivity_study(hierarchy: Path, cases: Any) -> None:
    """sd over mean, for rig and belt apart."""
    assert input_spreads(hierarchy, cases) == {"rig": {"peak_normal_force": 0.1}, "belt": {"peak_normal_force": 0.2}}


def test_a_sensitivity_study_of_other_conditions_says_nothing(hierarchy: Path, cases: Any, tmp_path: Path) -> None:
    """Another digest, or no study at all: not known, rather than zero."""
    hotter = [replace(case, temperature=case.temperature + 1.0) for case in cases]
    assert input_spreads(hierarchy, hotter) == {}
    assert input_spreads(tmp_path / "nothing", cases) == {}


def test_a_damaged_sensitivity_study_is_refused(hierarchy: Path, cases: Any) -> None:
    """A word in place of a number: file and line."""
    path = hierarchy / "sobol.csv"
    path.write_text(path.read_text(encoding="utf-8").replace("100.0,10.0", "100.0,many", 1), encoding="utf-8")
    with pytest.raises(InputError, match=r"sobol\.csv:2: got no mean and sd"):
        input_spreads(hierarchy, cases)
