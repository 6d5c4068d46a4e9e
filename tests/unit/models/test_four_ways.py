"""The same small model as a Python function, a C program, an Octave script and a folder of histories."""

from __future__ import annotations

import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tread_validate.models.skeleton import KINDS, skeleton, write_skeleton

EXAMPLES = "examples/own_model"


@pytest.fixture(scope="module")
def peaks(tmp_path_factory):
    """Peak forces of every case, by the kind of model."""
    place = tmp_path_factory.mktemp("four")
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"

    def call(folder, *command):
        subprocess.run(command, cwd=folder, check=True, env={**os.environ, "PATH": path})

    found = {}
    for kind in KINDS:
        if kind == "octave" and shutil.which("octave-cli") is None:
            continue
        folder = place / kind
        write_skeleton(folder, "winkler", kind)
        if kind == "command":
            call(folder, "make", "--silent")
        if kind == "histories":
            call(folder, "tread-validate", "case", "study.yaml", "--all", "-o", "cases")
            call(folder, sys.executable, "make_histories.py")
        call(folder, "tread-validate", "model", "study.yaml", "--model", "winkler", "-o", "out", "--trust-models")
        with (folder / "out" / "summary.csv").open() as stream:
            found[kind] = {row["case_id"]: row for row in csv.DictReader(stream)}
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_four_ways_give_equal_tables(kind, peaks):
    """The same arithmetic in double precision, histories written to 10 uN: equal to the last digit but one."""
    if kind not in peaks:
        pytest.skip("GNU Octave is not installed")
    assert len(peaks[kind]) == 4
    for case_id, row in peaks[kind].items():
        assert row["status"] == "ran"
        for quantity in ("peak_normal_force_N", "peak_tangential_force_N", "least_tangential_force_N"):
            assert float(row[quantity]) == pytest.approx(float(peaks["python"][case_id][quantity]), abs=2e-5)


@pytest.mark.parametrize("kind", KINDS)
def test_example_is_what_new_model_writes(kind, root):
    for name, text in skeleton("winkler", kind).items():
        assert (root / EXAMPLES / kind / name).read_text() == text


def test_model_never_overwrites_a_file(tmp_path):
    write_skeleton(tmp_path, "mine", "python")
    with pytest.raises(Exception, match="nothing is overwritten"):
        write_skeleton(tmp_path, "mine", "python")
