"""Every verb: numbers within bounds, outputs that are neither inputs nor each other, exit codes."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
from pathlib import Path
from typing import get_type_hints

import pytest
from typer.models import OptionInfo

from tread_validate.bounds import bound_of
from tread_validate.cli.app import VERBS, run
from tread_validate.cli.options import WRITTEN
from tread_validate.history import COLUMNS

READ = {
    "--mesh",
    "--study", "--user", "--settings", "--deck", "--tangential", "--references", "--decks", "--baseline", "--store",
    "--spring", "--tables", "--workflow", "--delta", "--hierarchy", "--pitch", "--impulse-response",
    "--transfer-function", "--convergence", "--frames", "--work", "--models", "--shift-table", "--sweep",
}  # fmt: skip
HISTORY = ",".join(COLUMNS) + "\n0,0,0,0\n1e-3,{force},0,0\n2e-3,0,0,0\n"


@pytest.fixture
def data(root: Path) -> Path:
    return root / "reference_data"


def one_line(said: str) -> bool:
    return said.startswith("tread-validate: ") and said.count("\n") == 1


@pytest.mark.parametrize("name", VERBS)
def test_every_number_of_every_verb_has_a_range_and_every_path_is_known(name: str) -> None:
    """A new option without a bound, or a path of which nobody said whether it is written, fails here."""
    command = importlib.import_module(f"tread_validate.cli.{VERBS[name]}").command
    for parameter, hint in get_type_hints(command, include_extras=True).items():
        if parameter == "return":
            continue
        (told,) = hint.__metadata__
        kinds = str(hint.__origin__)
        if "float" in kinds:
            assert bound_of(told.callback.quantity) is not None, parameter
        elif "int" in kinds:
            assert told.min is not None, parameter
            assert told.max is not None, parameter
        elif "Path" in kinds and isinstance(told, OptionInfo):
            flags = [str(told.default), *told.param_decls]  # in an annotation the first flag stands as the default
            option = next((flag for flag in flags if flag.startswith("--")), f"--{parameter}")
            assert option in READ | WRITTEN, option


@pytest.mark.parametrize(
    "arguments",
    [
        ["fit-prony", "{sweeps}", "--c1", "inf"],
        ["fit-prony", "{sweeps}", "--c2", "inf"],
        ["fit-prony", "{sweeps}", "--ts", "nan"],
        ["fit-prony", "{sweeps}", "--margins", "1e300", "1e300"],
        ["fit-prony", "{sweeps}", "--loss-weight", "1e300"],
        ["fit-prony", "{sweeps}", "--poissons-ratio", "-5"],
        ["fit-prony", "{sweeps}", "--poissons-ratio", "0.5"],
        ["fit-prony", "{sweeps}", "--density-kg-m3", "1e-308"],
        ["deck", "study.yaml", "--all", "--element-size", "1e-308"],
        ["fit-friction", "{table}", "--hold", "n=nan"],
        ["fit-friction", "{table}", "--hold", "m=-5"],
        ["fit-friction", "{table}", "--static", "1e308"],
        ["stimulus", "study.yaml", "--case", "x", "--pitch", "p.yaml", "-o", "out", "--to", "1e308"],
        ["import-rig", "{record}", "--temperature-degC", "nan"],
        ["import-rig", "{record}", "--temperature-degC", "500"],
        ["import-rig", "{record}", "--interference-mm", "nan"],
        ["import-rig", "{record}", "--interference-mm", "1e9"],
        ["import-rig", "{record}", "--wheel-diameter-mm", "-5"],
        ["import-rig", "{record}", "--wheel-diameter-mm", "1e-308"],
        ["import-rig", "{record}", "--low-pass-Hz", "1e-308"],
        ["import-rig", "{record}", "--cell-percent", "-5"],
        ["regress", "peaks.csv", "--zero-degC", "nan"],
        ["import-belt", "straight.csv"],
        ["compare", "huge.csv", "huge.csv"],
    ],
)
def test_numbers_that_cannot_be_end_with_two_and_one_line(
    arguments: list[str],
    data: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """nan, infinity, 1e308 N, a rubber at 500 degC, a wheel of -5 mm, a ridge without relief."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "huge.csv").write_text(HISTORY.format(force="1e308"), encoding="utf-8")
    heights = "".join(f"{2 * n},1.0\n" for n in range(300))
    (tmp_path / "straight.csv").write_text("position_mm,top_mm\n" + heights, encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    files = {
        "sweeps": data / "material" / "synthetic_sweeps.csv",
        "table": data / "friction" / "synthetic_tribometer.csv",
        "record": data / "rig" / "synthetic_record.csv",
    }
    assert run([item.format(**files) for item in arguments]) == 2
    assert one_line(capsys.readouterr().err)
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize(
    "arguments",
    [
        ["fit-prony", "in.csv", "-o", "in.csv"],
        ["fit-prony", "in.csv", "-o", "link.csv"],
        ["fit-prony", "in.csv", "-o", "hard.csv"],
        ["fit-prony", "in.csv", "-o", "sub/../in.csv"],
        ["fit-prony", "in.csv", "-o", "out.yaml", "--abaqus-card", "sub/../out.yaml"],
        ["fit-prony", "in.csv", "-o", "out.yaml", "--figure", "hard.csv"],
        ["compare", "in.csv", "other.csv", "-o", "other.csv"],
    ],
)
def test_an_output_is_neither_an_input_nor_another_output(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """By any name: symbolic link, hard link, another way round. The input stays as it was."""
    monkeypatch.chdir(tmp_path)
    for name in ("in.csv", "other.csv"):
        Path(name).write_text(HISTORY.format(force="1"), encoding="utf-8")
    Path("sub").mkdir()
    Path("link.csv").symlink_to("in.csv")
    os.link("in.csv", "hard.csv")
    assert run(arguments) == 2
    said = capsys.readouterr().err
    assert one_line(said)
    assert "a file of its own" in said
    assert Path("in.csv").read_text("utf-8") == Path("other.csv").read_text("utf-8") == HISTORY.format(force="1")


def test_a_record_is_not_overwritten_by_its_own_import(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The names that a verb makes up in its folder are guarded too, where they are written."""
    record = tmp_path / "synthetic_record.csv"
    text = (data / "rig" / "synthetic_record.csv").read_bytes()
    record.write_bytes(text)
    assert run(["import-rig", str(record), "-o", str(tmp_path)]) == 2
    assert "what is read as" in capsys.readouterr().err
    assert record.read_bytes() == text


def test_a_fault_of_the_program_is_code_4_with_a_log(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Never 1, which says that a check failed; the log holds the traceback."""

    def broken(*_: object) -> None:
        raise ZeroDivisionError("float division by zero")

    monkeypatch.setattr("tread_validate.study.load_study", broken)
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    assert run(["cases", "study.yaml"]) == 4
    said = capsys.readouterr().err
    assert one_line(said)
    log = Path(said.split()[-1])
    assert log.parent == tmp_path
    assert "Traceback" in log.read_text("utf-8")
    assert "'study.yaml'" in log.read_text("utf-8")


@pytest.mark.parametrize("arguments", [[], ["nosuch"], ["fit-prony"], ["deck", "s.yaml", "--layers", "0"]])
def test_wrong_usage_is_one_line_too(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(arguments) == 2
    assert one_line(capsys.readouterr().err)


LOOP = """      subroutine vfric(a, b)
      integer i
      i = 1
   10 i = -i
      if (i .ne. 0) goto 10
      end
"""


@pytest.mark.parametrize(
    ("routine", "said"),
    [
        (LOOP, "no progress for 2 s"),
        ("      subroutine vfric(f\n      end\n", "expected Fortran that gfortran compiles"),
    ],
)
def test_a_routine_that_loops_for_ever_or_does_not_compile_ends_fe_with_three(
    tmp_path: Path, routine: str, said: str
) -> None:
    """The watch ends the process; nothing is written."""
    place = Path(__file__).parents[1] / "fe" / "test_fe_subset.py"
    spec = importlib.util.spec_from_file_location("subset_of_decks", place)
    assert spec is not None
    assert spec.loader is not None
    subset = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(subset)
    deck = tmp_path / "a.inp"
    deck.write_text(subset.GOOD.replace("*FRICTION\n0.5,", "*FRICTION, USER\n"), encoding="utf-8")
    (tmp_path / "vfric.f").write_text(routine, encoding="utf-8")
    command = [sys.executable, "-m", "tread_validate.cli.app", "fe", str(deck), "--user", str(tmp_path / "vfric.f")]
    command += ["-o", str(tmp_path / "a.csv"), "--stall-limit", "2"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
    assert done.returncode == 3, done.stderr
    assert said in done.stderr
    assert one_line(done.stderr)
    assert not (tmp_path / "a.csv").exists()
