"""Wrong assessments that were once given silently, replayed: each must be said, refused or made impossible."""

from __future__ import annotations

import importlib.util
import json
import math
import shutil
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import yaml

from tread_validate.compare.tables import Delta, Ensemble, MetricRow, read_rows
from tread_validate.history import History

HERE = Path(__file__).parent


def _small_study() -> Any:
    spec = importlib.util.spec_from_file_location("small_study", HERE / "small_study.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["small_study"] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The small study with its references, tables and an accepted baseline."""
    place = _small_study().make_small(tmp_path_factory.mktemp("small"))
    place.study()
    first = place.check()
    assert first.returncode == 3, first.stdout + first.stderr
    assert first.stdout.startswith("Nothing could be compared")
    done = place.snakemake("reference")
    assert done.returncode == 0, done.stdout + done.stderr
    done = place.snakemake("checked")
    assert done.returncode == 0, done.stdout + done.stderr
    done = place.run("tread-validate", "accept", "--reason", "made by the test", "--who", "test", "--allow-dirty")
    assert done.returncode == 0, done.stdout + done.stderr
    return place


def test_check_says_all_in_six_lines_and_ends_with_zero(small: Any) -> None:
    """References, each model, the baseline."""
    done = small.assessment()
    assert done.returncode == 0, done.stdout + done.stderr
    lines = done.stdout.splitlines()
    assert len(lines) <= 6
    assert lines[0] == "references: embedded 2 current"
    assert lines[1].startswith("spring:paper against fe:embedded: mean |error| of peak N ")
    assert lines[-1] == "baseline: not moved"


def test_an_edit_of_the_code_is_noticed_and_so_is_its_taking_back(small: Any) -> None:
    """Without `make clean`: the springs' normal force 1 % up, checked; taken back, checked again."""
    file = "spring/run.py"
    before = (small.folder / "results" / "small" / "tables" / "errors.csv").read_bytes()
    text = small.edit(file, "np.where(touches, normal, 0.0)", "np.where(touches, 1.01 * normal, 0.0)")
    moved = small.check()
    small.restore(file, text)
    assert moved.returncode == 1, moved.stdout + moved.stderr
    assert "moved (make check)" in moved.stdout
    back = small.check()
    assert back.returncode == 0, back.stdout + back.stderr
    assert (small.folder / "results" / "small" / "tables" / "errors.csv").read_bytes() == before


def test_tables_of_other_code_are_refused(small: Any) -> None:
    """The assessment of tables that another comparison made is not given."""
    file = "compare/quantities/quantity.py"
    text = (small.source / file).read_text(encoding="utf-8")
    small.restore(file, text + "\nEDITED = 1\n")
    done = small.assessment()
    small.restore(file, text)
    assert done.returncode == 2
    assert "code of the comparison: got" in done.stderr
    assert done.stderr.count("\n") == 1


def test_an_edit_of_the_engine_marks_its_references(small: Any) -> None:
    """They were made before it: said, and moved since the baseline, without a run of the engine."""
    file = "fe/energy.py"
    text = (small.source / file).read_text(encoding="utf-8")
    small.restore(file, text + "\nEDITED = 1\n")
    done = small.check()
    small.restore(file, text)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "references: embedded 0 current, 2 other code (make reference)" in done.stdout


def test_another_study_with_the_same_case_ids_touches_nothing_of_the_first(small: Any) -> None:
    """Its own decks, results, baseline; the first one's references stay, and its mesh error is unknown."""
    references = small.folder / "reference_data" / "fe" / "embedded"
    before = {path: path.read_bytes() for path in references.rglob("*") if path.is_file()}
    small.study("other", "config/other.yaml", element_size_mm=3.5)
    done = small.snakemake("reference", study="config/other.yaml")
    assert done.returncode == 0, done.stdout + done.stderr
    assert all(path.read_bytes() == data for path, data in before.items())
    assert len(list(references.iterdir())) == 4
    told = small.check("config/other.yaml")
    assert told.returncode == 0, told.stdout + told.stderr
    assert "of 2 cases cannot tell in 2" in told.stdout
    assert "baseline: none accepted yet" in told.stdout


def test_two_studies_with_one_name_are_refused(small: Any) -> None:
    """The second file is named, and what to do."""
    small.study("small", "config/twin.yaml")
    done = small.snakemake("checked", study="config/twin.yaml")
    assert done.returncode != 0
    assert "config/twin.yaml: name: got small, the name of config/study.yaml" in done.stdout + done.stderr


def test_an_engine_that_is_not_here_says_so_before_anything_runs(small: Any) -> None:
    """Nothing is run in its place and nothing filed under its name."""
    path = small.study("elsewhere", "config/elsewhere.yaml")
    path.write_text(path.read_text().replace("engine: embedded", "engine: abaqus"), encoding="utf-8")
    done = small.snakemake("reference", study="config/elsewhere.yaml")
    assert done.returncode != 0
    assert "engine abaqus: no executable abaqus here" in done.stdout + done.stderr
    assert not (small.folder / "reference_data" / "fe" / "abaqus").exists()
    assert not (small.folder / "results" / "elsewhere" / "fe" / "abaqus").exists()


def test_histories_without_digests_are_unbound_and_never_judged(small: Any, tmp_path: Path) -> None:
    """Their headers gone: nothing can be compared, and that is the first thing said."""
    tables = small.folder / "results" / "small"
    spring = tmp_path / "spring"
    shutil.copytree(tables / "spring", spring)
    for path in (spring / "paper").glob("rig-*.csv"):
        rows = [line for line in path.read_text().splitlines(keepends=True) if not line.startswith("#")]
        path.write_text("".join(rows), encoding="utf-8")
    study = "config/study.yaml"
    made = small.run("tread-validate", "tables", study, "--spring", str(spring), "-o", str(tmp_path / "tables"))
    assert made.returncode == 0, made.stderr
    assert "unbound" in (tmp_path / "tables" / "peaks.csv").read_text()
    done = small.run("tread-validate", "assessment", study, "--gate", "--tables", str(tmp_path / "tables"))
    assert done.returncode == 3
    assert done.stdout.startswith("Nothing could be compared")


def test_a_record_that_contradicts_its_folder_is_named(small: Any) -> None:
    """One line with folder, found and expected, where the references are checked."""
    (folder, *_) = sorted((small.folder / "reference_data" / "fe" / "embedded").iterdir())
    record = folder / "record.yaml"
    text = record.read_text(encoding="utf-8")
    record.write_text(yaml.safe_dump({**yaml.safe_load(text), "engine": "abaqus"}), encoding="utf-8")
    done = small.run("tread-validate", "references", "reference_data")
    record.write_text(text, encoding="utf-8")
    assert f"{folder.name}: corrupt, record.yaml: engine abaqus, but the folder is embedded's" in done.stdout


def _own_runs(small: Any) -> list[Path]:
    """Return the folders of the small study's references; another study's may lie beside them."""
    folders = (small.folder / "reference_data" / "fe" / "embedded").iterdir()
    return [path for path in folders if yaml.safe_load((path / "record.yaml").read_text())["study"] == "small"]


def _blind_model(small: Any) -> str:
    """A model of the references' own histories with 5 % more normal and 3 N less tangential force; returns a study."""
    study = small.folder / "config" / "blind.yaml"
    data = yaml.safe_load((small.folder / "config" / "study.yaml").read_text(encoding="utf-8"))
    listed = small.run("tread-validate", "case", "config/study.yaml", "--all", "-o", "cases")
    assert listed.returncode == 0, listed.stderr
    (small.folder / "blind").mkdir()
    for folder in _own_runs(small):
        history = History.read_csv(folder / "history.csv")
        name = yaml.safe_load((folder / "record.yaml").read_text(encoding="utf-8"))["case_id"]
        digest = json.loads((small.folder / "cases" / f"{name}.json").read_text(encoding="utf-8"))["case_digest"]
        loaded = history.normal_force > 3.0
        biased = History.of(history.time, 1.05 * history.normal_force, history.tangential_force - 3.0 * loaded)
        biased.with_provenance({"case_digest": digest}).write_csv(small.folder / "blind" / f"{name}.csv")
    data["models"] = {
        "blind": {
            "kind": "histories",
            "description": "the references with a known bias",
            "origin": "this test",
            "folder": "blind",
        }
    }
    study.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
    return "config/blind.yaml"


def test_bias_of_a_blind_model_comes_out_of_the_tables_as_it_was_put_in(small: Any) -> None:
    """+5 % N, -3 N T, against references good to 1 %: good enough in N, not in T; it has no baseline yet."""
    study = _blind_model(small)
    records = [path / "record.yaml" for path in _own_runs(small)]
    texts = {path: path.read_text(encoding="utf-8") for path in records}
    for path, text in texts.items():
        path.write_text(f"{text}mesh_error: 0.01\n", encoding="utf-8")
    done = small.run("tread-validate", "check-model", study, "--model", "blind")
    for path, text in texts.items():
        path.write_text(text, encoding="utf-8")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "baseline: none accepted yet of model:blind" in done.stdout
    tables = small.folder / "results" / "small" / "model_check" / "tables"
    against = ("model:blind", "fe:embedded")
    rows = read_rows(tables / "errors.csv", MetricRow)
    rows = [row for row in rows if (row.predicted_source, row.reference_source) == against]
    normal = [row for row in rows if (row.quantity, row.metric) == ("peak_normal_force", "scalar")]
    assert [row.error for row in normal] == pytest.approx([0.05, 0.05], abs=2e-6)
    assert all(row.assessment == "adequate" for row in normal)
    for quantity in ("peak_positive_tangential_force", "peak_negative_tangential_force"):
        shifted = [row for row in rows if (row.quantity, row.metric) == (quantity, "scalar")]
        assert [row.predicted - row.reference for row in shifted] == pytest.approx([-3.0, -3.0], abs=1e-4)
        assert all(row.agreement == "differs" for row in shifted)
        assert not any(row.assessment == "adequate" for row in shifted)
    (whole,) = [
        row
        for row in read_rows(tables / "ensemble.csv", Ensemble)
        if (row.predicted_source, row.reference_source, row.group, row.quantity, row.metric)
        == (*against, "all", "peak_normal_force", "scalar")
    ]
    assert whole.total_scatter == pytest.approx(0.0, abs=2e-6)
    assert whole.bias == pytest.approx(1.05 * math.exp(-0.5 * whole.reference_scatter**2), abs=1e-5)


def test_loop_of_a_model_tells_of_the_cases_asked_for_alone(small: Any) -> None:
    """One case of an edited model: it moved, nothing else is called missing; exit code, Markdown and JUnit."""
    file, case = "spring/run.py", "rig-22c-0p2mm-450rpm"
    text = small.edit(file, "np.where(touches, normal, 0.0)", "np.where(touches, 1.01 * normal, 0.0)")
    done = small.run("tread-validate", "check-model", "config/study.yaml", "--model", "paper", "--case", case)
    small.restore(file, text)
    assert done.returncode == 1, done.stdout + done.stderr
    place = small.folder / "results" / "small" / "model_check"
    markdown = (place / "check.md").read_text(encoding="utf-8")
    assert len(markdown.splitlines()) < 50
    assert "| moved |" in markdown
    assert "600rpm" not in markdown
    assert "missing" not in done.stdout + markdown
    suites = {suite.get("name"): suite for suite in ElementTree.parse(place / "junit.xml").getroot()}
    assert suites["numbers"].get("failures") != "0"
    moved = read_rows(place / "delta.csv", Delta)
    assert {row.case_id for row in moved} == {case}
    kinds = [row.kind for row in moved if not row.passed]
    order = ["flip", "rule", "input", "run", "consequence"]
    assert kinds == sorted(kinds, key=order.index)
