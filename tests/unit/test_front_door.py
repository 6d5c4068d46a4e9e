"""The front door: its examples are true, and opening it loads nothing that is not asked for."""

from __future__ import annotations

import doctest
import importlib
import runpy
import subprocess
import sys

import pytest

import tread_validate as tv
from tread_validate.errors import InputError


@pytest.mark.parametrize("module", ["tread_validate", "tread_validate.api"])
def test_examples_are_true(module, root, monkeypatch):
    monkeypatch.chdir(root)
    found = doctest.testmod(importlib.import_module(module))
    assert found.failed == 0
    assert found.attempted > 0


def test_import_loads_none_of_the_libraries():
    heavy = "'numpy', 'scipy', 'pandas', 'numba', 'pydantic', 'yaml', 'matplotlib'"
    code = f"import sys, tread_validate; sys.exit(any(name in sys.modules for name in ({heavy})))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_every_name_of_the_door_opens():
    assert all(getattr(tv, name) is not None for name in tv.__all__)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = tv.nothing


def test_comparison_shows_as_table_and_frame(paper_study):
    history = tv.run(tv.load_study(paper_study).case("rig-rectangle-22c-0p2mm-300rpm"))
    rows = tv.compare(history, history)
    assert set(rows.to_frame()["error"].dropna()) == {0.0}
    assert "<table" in rows._repr_html_()


def test_histories_of_two_cases_are_not_compared(paper_study):
    study = tv.load_study(paper_study)
    one, two = (tv.run(study.case(f"rig-rectangle-22c-0p2mm-{speed}rpm")) for speed in (150, 300))
    with pytest.raises(InputError, match="the reference's case"):
        tv.compare(one, two)


def test_notebook_runs_from_the_top_of_a_clone(root, monkeypatch, capsys):
    """The half sine's peak of 100 N is what the comparison finds; its tangential force is not given."""
    monkeypatch.chdir(root)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    cells = runpy.run_path("examples/notebook/own_model.py")
    rows = {(row.quantity, row.metric): row for row in cells["rows"].rows}
    assert rows["peak_normal_force", "scalar"].predicted == pytest.approx(100.0, rel=1e-4)
    assert rows["peak_positive_tangential_force", "scalar"].status == "not_given"
    assert "T not given" in capsys.readouterr().out


def test_report_of_a_study_without_runs_says_so_on_its_page(root, tmp_path):
    """Nothing is run for a report: without runs and decks every run is missing."""
    page = tv.report(root / "examples/own_model/python/study.yaml", tmp_path / "out", root=tmp_path,
                     references=root / "reference_data")  # fmt: skip
    assert page == tmp_path / "out" / "index.html"
    assert "missing" in page.read_text(encoding="utf-8")
