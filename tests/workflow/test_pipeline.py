"""The workflow on a small study, run as a user runs it."""

from __future__ import annotations

import base64
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import zlib
from pathlib import Path

import pytest
import yaml

SMALL = {
    "runs.0.block": "rectangle",
    "runs.0.temperature_degC": [22.0, 45.0],
    "runs.0.interference_mm": 0.1,
    "runs.0.speed_rpm": [300.0, 600.0],
    "runs.1.path": "simplified",
    "runs.1.creep_percent": 0.3,
}


@pytest.fixture(scope="module")
def workspace(tmp_path_factory, root) -> Path:
    """A folder with the workflow, the references and a study of five cases."""
    folder = tmp_path_factory.mktemp("workspace")
    for name in ("workflow", "reference_data", "Snakefile"):
        (folder / name).symlink_to(root / name)
    (folder / "config").mkdir()
    shutil.copy(root / "config" / "workflow.yaml", folder / "config")
    data = yaml.safe_load((root / "config" / "study.yaml").read_text(encoding="utf-8"))
    for dotted, value in SMALL.items():
        _, index, key = dotted.split(".")
        data["runs"][int(index)][key] = value
    (folder / "config" / "study.yaml").write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
    return folder


def snakemake(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    binaries = Path(sys.executable).parent
    environment = {**os.environ, "PATH": f"{binaries}{os.pathsep}{os.environ['PATH']}"}
    return subprocess.run(
        [str(binaries / "snakemake"), "--cores", "2", *arguments],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=540,
        check=False,
    )


@pytest.fixture(scope="module")
def finished(workspace) -> Path:
    done = snakemake(workspace)
    assert done.returncode == 0, done.stdout + done.stderr
    return workspace


def test_study_becomes_decks_histories_tables_and_a_report(finished):
    cases = sorted(path.name for path in (finished / "fe_inputs" / "liu2010").iterdir())
    assert len(cases) == 5
    for case in cases:
        assert {path.name for path in (finished / "fe_inputs" / "liu2010" / case).iterdir()} >= {
            f"{case}.inp",
            "vfric.f",
            "mesh.vtu",
        }
        assert (finished / "results" / "liu2010" / "spring" / "paper" / f"{case}.csv").is_file()
    page = (finished / "reports" / "liu2010" / "index.html").read_text(encoding="utf-8")
    assert all(case in page for case in cases)
    assert (finished / "reports" / "liu2010" / "report.pdf").read_bytes().startswith(b"%PDF")


def test_built_report_has_no_empty_cell_and_figures_with_units(finished):
    """Every cell of every table says something; a figure's numbers name their panel by what stands on its axes."""
    report = finished / "reports" / "liu2010"
    page = (report / "index.html").read_text(encoding="utf-8")
    folded = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL).group(1))["tables"]
    texts = [page, *(zlib.decompress(base64.b64decode(text), wbits=-15).decode() for text in folded.values())]
    cells = [cell for text in texts for cell in re.findall(r"<td[^>]*>(.*?)</td>", text, re.DOTALL)]
    assert len(cells) > 1000
    words = [re.sub(r"<[^>]*>", "", cell).strip() for cell in cells]
    assert [cell for cell, word in zip(cells, words, strict=True) if not word and "heat-cell" not in cell] == []
    assert {"nan", "NaN", "None", "true", "false"} & set(words) == set()
    numbers = sorted((report / "figures").glob("*.csv"))
    assert {file.stem for file in numbers} == {file.stem for file in (report / "figures").glob("*.svg")}
    for file in numbers:
        header, *rows = csv.reader(file.read_text(encoding="utf-8").splitlines())
        assert rows, file.name
        assert "nan" not in {cell for row in rows for cell in row}, file.name
        if header[0] == "panel":
            units = r", (%|N|MPa|mm|1/m|% of fitted force)$|^(row|coefficient of friction)$"
            assert all(re.search(units, row[0].split(" against ")[0]) for row in rows), file.name
    told = subprocess.run(["pdfinfo", report / "report.pdf"], check=True, capture_output=True, text=True).stdout
    assert int(re.search(r"Pages:\s+(\d+)", told).group(1)) <= 20


def test_run_times_of_this_run_stand_beside_the_report(finished):
    """Decks, springs, tables and report ran in this run, each with seconds; what was not asked for has not run."""
    page = (finished / "reports" / "liu2010" / "run_times.html").read_text(encoding="utf-8")
    rows = {row.split("</td>")[0].split(">")[-1]: row for row in page.split("<tr>")}
    for rule in ("decks", "spring", "tables", "report"):
        assert "this run" in rows[rule], rule
    assert "has not run here" in rows["fe"]
    index = (finished / "reports" / "liu2010" / "index.html").read_text(encoding="utf-8")
    assert 'id="figure-rule-graph"' in index


def test_second_run_has_nothing_to_do(finished):
    before = (finished / "reports" / "liu2010" / "index.html").stat().st_mtime_ns
    done = snakemake(finished)
    assert done.returncode == 0
    assert "Nothing to be done" in done.stdout + done.stderr
    assert (finished / "reports" / "liu2010" / "index.html").stat().st_mtime_ns == before


def test_lost_file_is_made_again_and_the_tables_are_the_same(finished):
    """Byte for byte: histories and tables depend on the study alone."""
    tables = {path.name: path.read_bytes() for path in (finished / "results" / "liu2010" / "tables").glob("*.csv")}
    assert tables
    next((finished / "results" / "liu2010" / "spring" / "paper").glob("rig-*.csv")).unlink()
    (finished / "results" / "liu2010" / "tables" / "errors.csv").unlink()
    done = snakemake(finished, "--until", "tables")
    assert done.returncode == 0, done.stdout + done.stderr
    assert {
        path.name: path.read_bytes() for path in (finished / "results" / "liu2010" / "tables").glob("*.csv")
    } == tables


def test_snakemake_report_holds_page_and_pdf(finished, tmp_path):
    target = tmp_path / "snakemake-report.html"
    done = snakemake(finished, "--report", str(target))
    assert done.returncode == 0, done.stdout + done.stderr
    text = target.read_text(encoding="utf-8")
    assert "index.html" in text
    assert "report.pdf" in text


@pytest.mark.parametrize(
    ("key", "value", "line"),
    [
        ("interference_mm", -0.2, "runs[0].interference_mm: got -0.2, expected"),
        ("block", "hexagon", "runs[0].block: got hexagon, expected one of"),
    ],
)
def test_wrong_study_stops_before_any_job(workspace, key, value, line):
    data = yaml.safe_load((workspace / "config" / "study.yaml").read_text(encoding="utf-8"))
    data["runs"][0][key] = value
    wrong = workspace / "config" / "wrong.yaml"
    wrong.write_text(yaml.safe_dump(data), encoding="utf-8")
    done = snakemake(workspace, "--config", "study=config/wrong.yaml", "decks=wrong", "results=wrong", "reports=wrong")
    assert done.returncode != 0
    assert line in done.stdout + done.stderr
    assert "Traceback" not in done.stdout + done.stderr
    assert not (workspace / "wrong").exists()


def test_unknown_key_of_the_workflow_is_refused(workspace):
    done = snakemake(workspace, "--config", "resluts=elsewhere")
    assert done.returncode != 0
    assert "resluts" in done.stdout + done.stderr


@pytest.mark.parametrize("target", ["report", "check", "reference", "mesh-study", "hierarchy"])
def test_make_target_reaches_its_rules(target, root):
    """`make -n` shows the command; the target's rule must come after the options, never as a config entry."""
    shown = subprocess.run(["make", "-n", target], cwd=root, capture_output=True, text=True, timeout=60, check=True)
    words = next(line for line in shown.stdout.splitlines() if "bin/snakemake" in line).split()
    after = words[words.index("--config") + 1 :]
    settings = after[: next(place for place, word in enumerate(after) if word.startswith("--"))]
    assert settings[0].startswith("study=")
    assert all("=" in word for word in settings)
    assert "locked.sh" in " ".join(words)
