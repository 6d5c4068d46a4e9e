"""The fe verb: exit codes and files."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from tread_validate.cli.app import run

spec = importlib.util.spec_from_file_location("subset_deck", Path(__file__).with_name("test_fe_subset.py"))
assert spec is not None
assert spec.loader is not None
subset = importlib.util.module_from_spec(spec)
spec.loader.exec_module(subset)


def test_verb_writes_history_and_reports_progress(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Off a terminal progress is a line for every tenth, with the time left."""
    deck = tmp_path / "a.inp"
    deck.write_text(subset.GOOD)
    assert run(["fe", str(deck), "-o", str(tmp_path / "a.csv")]) == 0
    said = capsys.readouterr()
    assert "peak normal force" in said.out
    assert "100 % done, 0 s left" in said.err
    assert (tmp_path / "a.yaml").is_file()


@pytest.mark.parametrize(
    ("arguments", "code", "message"),
    [
        (["missing.inp", "-o", "a.csv"], 2, "no such file"),
        (["a.inp", "-o", "a.txt"], 2, "ends in .csv"),
        (["user.inp", "-o", "a.csv"], 2, "--user"),
    ],
)
def test_wrong_input_ends_with_code_2_and_one_line(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    code: int,
    message: str,
) -> None:
    """One line that says where, what and what was expected."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.inp").write_text(subset.GOOD)
    (tmp_path / "user.inp").write_text(subset.GOOD.replace("*FRICTION\n0.5,", "*FRICTION, USER\n"))
    assert run(["fe", *arguments]) == code
    said = capsys.readouterr().err
    assert message in said
    assert said.count("\n") == 1
