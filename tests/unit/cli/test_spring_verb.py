"""`tread-validate spring` from the outside."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pandas as pd
import pytest

from tread_validate.cli.app import run
from tread_validate.history import History

RIG = "rig-rectangle-22c-0p2mm-300rpm"


def test_all_cases_are_written_with_a_summary(paper_study: Path, tmp_path: Path) -> None:
    """52 histories and one row for each; the free-rolling creep ratio stands in the row."""
    assert run(["spring", str(paper_study), "--all", "-o", str(tmp_path / "out")]) == 0
    summary = pd.read_csv(tmp_path / "out" / "summary.csv")
    assert len(summary) == 52
    for case_id in summary.case_id:
        history = History.read_csv(tmp_path / "out" / f"{case_id}.csv")
        assert history.provenance["case_id"] == case_id
    belt = summary[summary.case_id.str.startswith("belt")]
    assert (belt.free_rolling_creep_ratio - 0.0022).abs().max() < 2e-4


def test_one_case_goes_to_one_file(paper_study: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An output that ends in .csv is the history itself, and the peak is printed."""
    target = tmp_path / "one.csv"
    assert run(["spring", str(paper_study), "--case", RIG, "--variant", "light", "-o", str(target)]) == 0
    assert History.read_csv(target).provenance["producer"] == "spring/light"
    assert "peak normal force" in capsys.readouterr().out


def test_several_variants_at_once_write_what_each_writes_alone(paper_study: Path, tmp_path: Path) -> None:
    """A folder for each below the output; the files are those of a run of one variant, to the byte."""
    call = ["spring", str(paper_study), "--case", RIG]
    assert run([*call, "--variant", "paper", "--variant", "light", "-o", str(tmp_path / "both")]) == 0
    for name in ("paper", "light"):
        assert run([*call, "--variant", name, "-o", str(tmp_path / name)]) == 0
        files = sorted(path.name for path in (tmp_path / name).iterdir())
        assert files == sorted(path.name for path in (tmp_path / "both" / name).iterdir()) == [f"{RIG}.csv"]
        assert (tmp_path / "both" / name / files[0]).read_bytes() == (tmp_path / name / files[0]).read_bytes()


def test_variants_are_listed(paper_study: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`--variant list` prints a line for each."""
    assert run(["spring", str(paper_study), "--variant", "list"]) == 0
    assert "paper: " in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["--all", "--case", RIG],
        ["--case", "../../etc/passwd"],
        ["--case", RIG, "--variant", "nonsense"],
        ["--all", "-o", "one.csv"],
        ["--case", RIG, "--variant", "paper", "--variant", "light", "-o", "one.csv"],
    ],
)
def test_wrong_call_is_one_line_and_exit_code_two(
    paper_study: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
) -> None:
    """Nothing is written and standard error has one line."""
    monkeypatch.chdir(tmp_path)
    assert run(["spring", str(paper_study), *arguments]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_wrong_case_leaves_nothing_half_written(
    altered_study: Callable[..., Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """An element longer than the shorter block: every case runs before the first file is written, so none is."""
    study = altered_study({"spring.element_length_mm": 26.0})
    assert run(["spring", str(study), "--all", "-o", str(tmp_path / "out")]) == 2
    assert "element_length_mm" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
