"""The laboratory verbs from the command line: files written, exit codes, one line for a fault."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
import yaml

from tread_validate.cli.app import run
from tread_validate.compare.regression.peaks_file import read_peaks
from tread_validate.friction import read_friction
from tread_validate.geometry.belt_file import read_belt
from tread_validate.material import read_material
from tread_validate.reference.rig import load_rig
from tread_validate.reference.rig_synthetic import record_csv, synthetic_record

VERBS = ("fit-prony", "fit-friction", "import-belt", "import-rig", "synthesize")


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory, root: Path) -> Path:
    folder = tmp_path_factory.mktemp("data")
    assert run(["synthesize", "-o", str(folder), "--study", str(root / "config" / "study.yaml"), "--tdms"]) == 0
    return folder


def test_shipped_synthetic_data_are_what_the_command_makes(data: Path, root: Path) -> None:
    """Same seed, same text: nobody edited the shipped files by hand."""
    for name in ("material/synthetic_sweeps.csv", "friction/synthetic_tribometer.csv", "belt/synthetic_ridges.csv",
                 "rig/synthetic_record.csv"):  # fmt: skip
        assert (data / name).read_text("utf-8") == (root / "reference_data" / name).read_text("utf-8"), name


@pytest.mark.parametrize(
    ("kind", "file"),
    [("material", "material/synthetic_material.yaml"), ("friction", "friction/synthetic_friction.yaml")],
)
def test_shipped_files_meet_the_schema_that_is_printed(
    kind: str, file: str, root: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["schema", kind]) == 0
    schema = json.loads(capsys.readouterr().out)
    data = yaml.safe_load((root / "reference_data" / file).read_text("utf-8"))
    jsonschema.validate(data, schema)
    data["surplus"] = 1
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(data, schema)


@pytest.mark.parametrize("verb", VERBS)
def test_help_shows_an_example(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([verb, "--help"]) == 0
    assert "Example: tread-validate " + verb in " ".join(capsys.readouterr().out.split())


def test_sweeps_become_a_material_file_a_card_and_a_picture(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, card, picture = tmp_path / "material.yaml", tmp_path / "card.inp", tmp_path / "material.png"
    sweeps = str(data / "material" / "synthetic_sweeps.csv")
    options = ["--band", "0.25", "2500", "--abaqus-card", str(card), "--figure", str(picture)]
    assert run(["fit-prony", sweeps, "-o", str(out), *options]) == 0
    read = read_material(out)
    assert read.origin == "synthetic"
    assert read.quality["kramers_kronig_consistent"] is True
    assert "*TRS, DEFINITION=WLF" in card.read_text("utf-8")
    assert picture.read_bytes()[:4] == b"\x89PNG"
    assert "synthetic data" in capsys.readouterr().out


def test_pruned_and_fitted_shift_from_the_command_line(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "material.yaml"
    sweeps = str(data / "material" / "synthetic_sweeps.csv")
    arguments = ["--band", "0.25", "2500", "--fit-wlf", "--vertical-shift", "--prune", "2.5", "--resamples", "50"]
    assert run(["fit-prony", sweeps, "-o", str(out), *arguments]) == 0
    assert len(read_material(out).terms) <= 8
    assert "fitted WLF at 22 degC: C1 = " in capsys.readouterr().out


def test_tribometer_table_becomes_a_friction_file_and_its_fortran(data: Path, tmp_path: Path) -> None:
    out, fortran, picture = tmp_path / "friction.yaml", tmp_path / "vfric.f", tmp_path / "friction.png"
    table = str(data / "friction" / "synthetic_tribometer.csv")
    options = ["--hold", "beta=0", "--vfric", str(fortran), "--figure", str(picture)]
    assert run(["fit-friction", table, "-o", str(out), *options]) == 0
    assert read_friction(out).held == {"beta": 0.0}
    assert "subroutine vfric" in fortran.read_text("utf-8").lower()
    assert all(len(line) <= 72 for line in fortran.read_text("utf-8").splitlines())


def test_ridges_become_a_belt_file(data: Path, tmp_path: Path) -> None:
    out = tmp_path / "belt.yaml"
    arguments = [str(data / "belt" / "synthetic_ridges.csv"), "-o", str(out), "--figure", str(tmp_path / "belt.png")]
    assert run(["import-belt", *arguments]) == 0
    assert set(read_belt(out)) == {"top", "mid_top", "mid_bottom", "bottom"}


@pytest.mark.parametrize("ending", ["csv", "tdms"])
def test_record_becomes_a_reference_and_a_peak_table(data: Path, tmp_path: Path, ending: str) -> None:
    record = str(data / "rig" / f"synthetic_record.{ending}")
    assert run(["import-rig", record, "-o", str(tmp_path), "--figure", str(tmp_path / "rig.png")]) == 0
    (found,) = load_rig(tmp_path)
    assert found.origin == "synthetic"
    ((peak,),) = read_peaks(tmp_path / "peaks.csv").values()
    assert peak.shape == "rectangle"


def test_records_of_several_speeds_make_the_table_that_regress_reads(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Three records of one set in one folder: three rows with error bars, a slope over speed, and their picture."""
    for rpm in (150.0, 300.0, 600.0):
        record = tmp_path / f"rpm{rpm:.0f}.csv"
        record.write_text(record_csv(synthetic_record(speed_rpm=rpm, revolutions=4)), encoding="utf-8")
        picture = ["--peaks-figure", str(tmp_path / "peaks.png")]
        assert run(["import-rig", str(record), "-o", str(tmp_path / "rig"), *picture]) == 0
    ((*rows,),) = read_peaks(tmp_path / "rig" / "peaks.csv").values()
    assert [row.speed for row in rows] == pytest.approx([1.571, 3.142, 6.283], rel=1e-3)
    capsys.readouterr()
    assert run(["regress", str(tmp_path / "rig" / "peaks.csv")]) == 0
    assert "rig,rectangle,a_v,22 degC 0.2 mm,0" in capsys.readouterr().out.replace(",-0", ",0")


@pytest.mark.parametrize(
    "arguments",
    [
        ["fit-prony", "nowhere.csv"],
        ["fit-prony", "{sweeps}", "--c2", "-3"],
        ["fit-prony", "{sweeps}", "--ts", "200"],
        ["fit-prony", "{sweeps}", "--band", "9", "1"],
        ["fit-prony", "{sweeps}", "--times", "odd"],
        ["fit-prony", "{sweeps}", "--modulus-unit", "bar"],
        ["fit-prony", "{sweeps}", "--origin", "measured"],
        ["fit-friction", "{sweeps}"],
        ["fit-friction", "{table}", "--hold", "beta"],
        ["import-belt", "{table}"],
        ["import-rig", "{table}"],
        ["import-rig", "{record}", "--name", "../up"],
        ["import-rig", "{record}", "--low-pass-Hz", "1e9"],
        ["synthesize", "--study", "nowhere.yaml"],
    ],
)
def test_wrong_input_ends_with_two_and_one_line(
    data: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    names = {
        "sweeps": data / "material" / "synthetic_sweeps.csv",
        "table": data / "friction" / "synthetic_tribometer.csv",
        "record": data / "rig" / "synthetic_record.csv",
    }
    assert run([argument.format(**names) for argument in arguments]) == 2
    said = capsys.readouterr().err
    assert said.startswith("tread-validate: ")
    assert said.count("\n") == 1
    assert not list(tmp_path.iterdir())
