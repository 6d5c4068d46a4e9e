"""A model of the user's own goes through the pipeline beside the built-in ones, once it is trusted."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from tread_validate.compare.tables import MetricRow, PeakRow, read_rows
from tread_validate.models.skeleton import write_skeleton

FAILS = """
def other(case):
    if case.speed_m_s < 2.0:
        raise ValueError("no such rubber")
    return forces(case)[:2]
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory, root):
    """Run the workflow up to the tables on two cases, with one model that works and one that fails on one."""
    folder = tmp_path_factory.mktemp("own")
    write_skeleton(folder / "mine", "mine", "python")
    module = folder / "mine" / "mine.py"
    module.write_text(module.read_text() + FAILS)
    study = folder / "mine" / "study.yaml"
    data = yaml.safe_load(study.read_text())
    data["runs"][0] |= {"interference_mm": 0.2}
    data["models"]["frail"] = data["models"]["mine"] | {"object": "mine:other"}
    study.write_text(yaml.safe_dump(data, sort_keys=False))
    places = [f"{name}={folder / name}" for name in ("decks", "results", "reports", "logs")]

    def call(trusted):
        command = [sys.executable, "-m", "snakemake", "--snakefile", str(root / "Snakefile"), "--cores", "1"]
        command += ["--nolock", "--directory", str(root), "--until", "tables"]
        command += ["--config", f"study={study}", f"trust_models={int(trusted)}", *places]
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        environment = {**os.environ, "PATH": path, "XDG_CACHE_HOME": str(folder / "cache")}
        return subprocess.run(command, capture_output=True, text=True, check=False, env=environment), folder

    return call


def test_study_that_names_code_is_refused_before_anything_runs(run):
    done, folder = run(trusted=False)
    assert done.returncode != 0
    assert "your word for it" in done.stdout + done.stderr
    assert not list((folder / "results").rglob("*.csv"))


def test_trusted_model_stands_in_the_tables_and_its_failure_is_counted(run):
    done, folder = run(trusted=True)
    assert done.returncode == 0, done.stdout + done.stderr
    tables = folder / "results" / "mine_study" / "tables"
    peaks = {(row.source, row.case_id): row for row in read_rows(tables / "peaks.csv", PeakRow)}
    assert peaks["model:mine", "rig-22c-0p2mm-300rpm"].status == "current"
    assert peaks["model:mine", "rig-22c-0p2mm-150rpm"].status == "current"
    assert peaks["model:frail", "rig-22c-0p2mm-300rpm"].status == "current"
    failed = peaks["model:frail", "rig-22c-0p2mm-150rpm"]
    assert failed.status == "failed"
    assert "no such rubber" in failed.note
    rows = [row for row in read_rows(tables / "errors.csv", MetricRow) if row.predicted_source.startswith("model:")]
    assert {row.case_id for row in rows} == {"rig-22c-0p2mm-300rpm", "rig-22c-0p2mm-150rpm"}
