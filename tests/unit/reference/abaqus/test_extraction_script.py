"""The script that runs under ABAQUS's own Python."""

from __future__ import annotations

import ast
import json
import subprocess
import sys
from pathlib import Path

import parso
import pytest

from tread_validate.reference.abaqus import EXTRACTION_SCRIPT, read_table

STAND_IN = Path(__file__).parent / "stand_in"


def extract(folder: Path, odb: dict, *more: str) -> subprocess.CompletedProcess[str]:
    (folder / "job-1.odb").write_text(json.dumps(odb))
    call = [sys.executable, str(EXTRACTION_SCRIPT), "job-1.odb", "-o", "forces.csv", *more]
    return subprocess.run(
        call, cwd=folder, env={"PYTHONPATH": str(STAND_IN)}, capture_output=True, text=True, timeout=60, check=False
    )


@pytest.mark.parametrize("version", ["2.7", "3.6", "3.8"])
def test_script_is_grammatical_in_each_python_of_abaqus(version):
    """ABAQUS ships 2.7 up to 2023 and 3.x after: no error node in either grammar."""
    grammar = parso.load_grammar(version=version)
    tree = grammar.parse(EXTRACTION_SCRIPT.read_text())
    assert [error.message for error in grammar.iter_errors(tree)] == []


def test_grammar_check_would_notice_a_construct_of_one_python_only():
    grammar = parso.load_grammar(version="2.7")
    assert list(grammar.iter_errors(grammar.parse('x = f"{1}"\n')))
    grammar = parso.load_grammar(version="3.8")
    assert list(grammar.iter_errors(grammar.parse("print 1\n")))


def test_script_needs_nothing_but_odb_access_and_the_standard_library():
    tree = ast.parse(EXTRACTION_SCRIPT.read_text())
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    names |= {str(node.module) for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    assert names == {"__future__", "hashlib", "io", "os", "re", "sys", "odbAccess"}


def test_forces_and_reactions_come_out_by_name(tmp_path, odb_data):
    done = extract(tmp_path, odb_data)
    assert done.returncode == 0, done.stderr
    table = read_table(tmp_path / "forces.csv")
    assert table.layout == "csv"
    assert table.columns[:7] == ("time_s", "CFN1_N", "CFN2_N", "CFN3_N", "CFS1_N", "CFS2_N", "CFS3_N")
    assert set(table.columns[7:]) == {"RF1@ROAD_REF_N", "RF2@ROAD_REF_N", "slipping_fraction"}
    assert table.column("CFN2").max() == pytest.approx(200.0, rel=1e-3)
    assert table.notes["job"] == "job-1"
    assert table.notes["clock"] == "step"


def test_slipping_share_counts_touching_nodes_only(tmp_path, odb_data):
    """Three nodes touch; one of them slips from frame 6 on; the fourth moves fast but does not touch: 0, then 1/3."""
    extract(tmp_path, odb_data)
    share = read_table(tmp_path / "forces.csv").column("slipping_fraction")
    assert share[0] == 0.0
    assert share[-1] == pytest.approx(1 / 3, rel=1e-8)


def test_missing_output_and_missing_step_are_said(tmp_path, odb_data):
    assert "no step roll" in extract(tmp_path, odb_data, "--step", "roll").stderr
    del odb_data["steps"]["pass"]["regions"]["NodeSet ASSEMBLY.FACE"]
    done = extract(tmp_path, odb_data)
    assert done.returncode == 3
    assert "no history output CFN1, CFN2, CFS1, CFS2" in done.stderr
    assert not (tmp_path / "forces.csv").exists()


def test_two_contact_pairs_are_not_mixed(tmp_path, odb_data):
    regions = odb_data["steps"]["pass"]["regions"]
    rows = regions["NodeSet ASSEMBLY.FACE"]["outputs"]["CFN2     ASSEMBLY_FACE/ASSEMBLY_ROAD"]
    regions["NodeSet ASSEMBLY.RIM"] = {"outputs": {"CFN2     ASSEMBLY_RIM/ASSEMBLY_ROAD": rows}}
    done = extract(tmp_path, odb_data)
    assert done.returncode == 3
    assert "more than one contact pair" in done.stderr
