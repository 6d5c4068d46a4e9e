"""The model runs on every case of its study, and its forces are of the right size and sign."""

import csv
import shutil
import subprocess
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent


@pytest.fixture(scope="module")
def outcomes(tmp_path_factory):
    folder = tmp_path_factory.mktemp("winkler")
    if shutil.which("octave-cli") is None:
        pytest.skip("GNU Octave is not installed")
    command = ["tread-validate", "model", "study.yaml", "--model", "winkler", "-o", str(folder), "--trust-models"]
    subprocess.run(command, cwd=HERE, check=True)
    with (folder / "summary.csv").open() as stream:
        return list(csv.DictReader(stream))


def test_every_case_ran(outcomes):
    assert [row["message"] for row in outcomes if row["status"] != "ran"] == []


def test_deeper_is_harder(outcomes):
    """A linear foundation: twice the interference is more than twice the force, as the contact is longer too."""
    peak = {row["case_id"]: float(row["peak_normal_force_N"]) for row in outcomes}
    for speed in ("150rpm", "300rpm"):
        assert peak[f"rig-22c-0p2mm-{speed}"] > 2.0 * peak[f"rig-22c-0p1mm-{speed}"]
