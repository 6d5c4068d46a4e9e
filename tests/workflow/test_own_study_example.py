"""The worked example of the guide: every command of docs/own_data.md, on the files of examples/own_study."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from tread_validate.cli.app import run
from tread_validate.inp import deck_files
from tread_validate.reference import FeStore
from tread_validate.study import load_study

CASE = "tyre-60c-0p2mm-22p2mps-free"


@pytest.fixture(scope="module")
def example(root: Path) -> Path:
    return root / "examples" / "own_study"


@pytest.fixture(scope="module")
def made(example: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Decks, spring runs of both variants and the imported forces of the example."""
    out = tmp_path_factory.mktemp("own")
    study = str(example / "study.yaml")
    assert run(["deck", study, "--all", "-o", str(out / "fe_inputs")]) == 0
    for variant in load_study(study).model.spring.variants:
        folder = str(out / "spring" / variant)
        assert run(["spring", study, "--all", "--variant", variant, "-o", folder]) == 0
    deck = out / "fe_inputs" / CASE
    forces = str(example / "data" / "synthetic_forces.rpt")
    arguments = ["--deck", str(deck / f"{CASE}.inp"), "--user", str(deck / "vfric.f"), "--store", str(out / "store")]
    assert run(["import-abaqus", forces, *arguments]) == 0
    return out


def test_every_input_of_the_example_is_marked_as_assumed_or_synthetic(example):
    (case, *_) = load_study(example / "study.yaml").cases()
    assert len(case.assumed()) == 4


def test_decks_of_the_example_are_clean(made):
    decks = [path for path in sorted((made / "fe_inputs").glob("*/*.inp")) if path.name.startswith(path.parent.name)]
    assert len(decks) == 6
    for deck in decks:
        assert run(["lint", str(deck)]) == 0


def test_imported_forces_are_the_reference_of_todays_deck(made):
    reference = FeStore(made / "store").find("abaqus", CASE, deck_files(made / "fe_inputs", CASE))
    assert reference.status == "current", reference.reason
    assert reference.record["imported"] is True


def test_stimulus_of_the_example_has_the_mean_of_its_blocks(made, example):
    """The means of summary.csv: lines at 0 Hz, and impulse times block rate, equal to the nine digits written."""
    arguments = ["--case", CASE, "--pitch", str(example / "pitch.yaml")]
    hub = ["--transfer-function", str(example / "data" / "synthetic_hub.csv")]
    (filed,) = (made / "store" / "fe" / "abaqus").glob(f"{CASE}-*/history.csv")
    own = ["--history", f"abaqus={filed}"]
    out = made / "stimulus"
    assert run(["stimulus", str(example / "study.yaml"), *arguments, *hub, *own, "-o", str(out)]) == 0
    with (out / "summary.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    assert {row["model"] for row in rows} == {"paper", "shape_factor", "abaqus"}
    for row in rows:
        mean = float(row["mean_normal_force_N"])
        assert mean == pytest.approx(float(row["normal_impulse_times_rate_N"]), rel=1e-6)
        assert float(row["block_passing_frequency_Hz"]) == pytest.approx(22.2 / 0.034, rel=1e-6)
    assert (out / "paper" / "response.csv").read_text().count("\n") > 1000
