"""Running a deck from its files: results, record, failures that leave nothing finished-looking."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import yaml

from tread_validate.errors import EngineError, InputError
from tread_validate.fe import run_deck
from tread_validate.history import History
from tread_validate.inp import problem_of
from tread_validate.provenance import sha256_file
from tread_validate.source_code import code_digest

spec = importlib.util.spec_from_file_location("subset_deck", Path(__file__).with_name("test_fe_subset.py"))
assert spec is not None
assert spec.loader is not None
subset = importlib.util.module_from_spec(spec)
spec.loader.exec_module(subset)
USER = subset.GOOD.replace("*FRICTION\n0.5,", "*FRICTION, USER=FRIC, PROPERTIES=1\n0.5,")
ROUTINE = """      subroutine vfric(f, s, k1, k2, nContact)
      implicit real*8 (a-h,o-z)
      dimension f(2,nContact)
      do 10 k = 1, nContact
   10 f(1,k) = 0.d0
      end
"""


@pytest.fixture
def deck(tmp_path: Path) -> Callable[[str], Path]:
    """Write a deck's text."""

    def write(text: str = subset.GOOD) -> Path:
        path = tmp_path / "press.inp"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_result_is_written_whole_with_a_record_bound_to_the_deck(tmp_path: Path, deck: Callable[..., Path]) -> None:
    """The record holds the digests of deck and history; the history reads back as it was."""
    source = deck()
    shares: list[float] = []
    result = run_deck(source, progress=lambda share, left: shares.append(share))
    out = tmp_path / "out" / "press.csv"
    result.write(out)
    record = yaml.safe_load(out.with_suffix(".yaml").read_text())
    assert record["engine"] == "embedded"
    assert record["deck_digest"] == problem_of(source).digest
    assert record["code"] == code_digest("fe")
    assert record["history_sha256"] == sha256_file(out)
    assert record["elements"] == 1
    assert record["increment_s"]["smallest"] > 0
    history = History.read_csv(out)
    assert np.allclose(history.normal_force, result.history.normal_force, atol=1e-5)
    assert history.normal_force.size > 10
    assert {key: history.provenance[key] for key in ("deck_digest", "code", "engine")} == {
        key: record[key] for key in ("deck_digest", "code", "engine")
    }
    assert shares[-1] == pytest.approx(1.0)
    for part in ("energies", "contact", "face"):
        assert (tmp_path / "out" / f"press_{part}.csv").is_file()


def test_contact_force_and_reaction_hold_the_pressed_element_in_balance(deck: Callable[..., Path]) -> None:
    """At rest the contact pushes up what the mount pushes down: their z components cancel."""
    text = subset.GOOD.replace(", 2e-5", ", 4e-4").replace("1e-5, 1.", "2e-4, 1.").replace("1e-6", "1e-5")
    result = run_deck(deck(text.replace("*AMPLITUDE, NAME=A", "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP")))
    last = result.contact.iloc[-1]
    assert last["cfn_z_N"] > 0.1
    assert result.reactions.iloc[-1]["reaction_z_N"] == pytest.approx(-last["cfn_z_N"], rel=0.02)


def test_interrupted_run_leaves_no_record(tmp_path: Path, deck: Callable[..., Path]) -> None:
    """An exception on the way (here from the progress function) ends the run before anything is written."""

    def stop(share: float, left: float) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_deck(deck(), progress=stop).write(tmp_path / "out" / "press.csv")
    assert not (tmp_path / "out").exists()


def test_old_record_goes_before_new_results_come(
    tmp_path: Path, deck: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A write that breaks half way leaves no record of the run before beside the new files."""
    result = run_deck(deck())
    out = tmp_path / "press.csv"
    result.write(out)

    def fail(path: object, text: str) -> None:
        raise OSError("disk full")

    monkeypatch.setattr("tread_validate.fe.result.write_text", fail)
    with pytest.raises(OSError, match="disk full"):
        result.write(out)
    assert not out.with_suffix(".yaml").exists()


def test_frames_are_written_for_paraview(tmp_path: Path, deck: Callable[..., Path]) -> None:
    """The last frame holds the displacement and the stress of the pressed element."""
    import meshio

    run_deck(deck(), frames=tmp_path / "frames")
    files = sorted((tmp_path / "frames").glob("*.vtu"))
    assert len(files) > 5
    grid = meshio.read(files[-1])
    assert grid.point_data["displacement"][4:, 2] == pytest.approx(-0.01, rel=1e-6)
    assert grid.cell_data["stress"][0].shape == (1, 6)


def test_user_friction_without_a_routine_stops(deck: Callable[..., Path]) -> None:
    """A deck that asks for VFRIC never runs without it."""
    with pytest.raises(InputError, match="--user"):
        run_deck(deck(USER))


def test_user_routine_is_called_through_the_documented_arguments(tmp_path: Path, deck: Callable[..., Path]) -> None:
    """A routine that knows only the first five arguments still finds the number of contacts where it belongs."""
    source = tmp_path / "vfric.f"
    source.write_text(ROUTINE)
    result = run_deck(deck(USER), source)
    assert result.contact["cfn_z_N"].max() > 0.0
    assert result.contact[["cfs_x_N", "cfs_y_N", "cfs_z_N"]].abs().to_numpy().max() == 0.0
    assert result.record["user_sha256"] is not None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("      subroutine vfric(f\n      end\n", r"vfric\.f:\d+: got .*expected Fortran that gfortran compiles"),
        ("      subroutine other()\n      end\n", "no subroutine VFRIC"),
    ],
)
def test_routine_that_does_not_compile_or_is_not_there_stops(
    tmp_path: Path, deck: Callable[..., Path], text: str, message: str
) -> None:
    """The message names the source, and its line where the compiler does."""
    source = tmp_path / "vfric.f"
    source.write_text(text)
    with pytest.raises((EngineError, InputError), match=message):
        run_deck(deck(USER), source)


def test_missing_compiler_is_an_engine_error(
    tmp_path: Path, deck: Callable[..., Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Exit code 3, not 2: the input is not wrong."""
    source = tmp_path / "vfric.f"
    source.write_text(ROUTINE)
    monkeypatch.setenv("PATH", "")
    with pytest.raises(EngineError, match="gfortran not found"):
        run_deck(deck(USER), source)


def test_slave_nodes_inside_the_master_at_the_start_stop(deck: Callable[..., Path]) -> None:
    """A profile run the other way has its outward normal on the wrong side."""
    text = subset.GOOD.replace("START, -10., 0.", "START, 10., -0.5").replace("LINE, 10., 0.", "LINE, -10., -0.5")
    with pytest.raises(InputError, match="inside ROAD"):
        run_deck(deck(text))


def test_increment_too_long_breaks_down_with_a_message(deck: Callable[..., Path]) -> None:
    """DIRECT USER CONTROL beyond the stable increment: an element turns inside out or the energy overflows."""
    text = subset.GOOD.replace("*DYNAMIC, EXPLICIT\n, 2e-5", "*DYNAMIC, EXPLICIT, DIRECT USER CONTROL\n2e-5, 2e-2")
    with pytest.raises(EngineError, match=r"turned inside out|no longer finite"):
        run_deck(deck(text.replace("TIME INTERVAL=1e-6", "TIME INTERVAL=1e-4")))


def test_free_rigid_body_is_refused(deck: Callable[..., Path]) -> None:
    """The engine moves rigid bodies as told; it does not integrate them."""
    with pytest.raises(InputError, match="all six prescribed"):
        run_deck(deck(subset.GOOD.replace("REF, 1, 6", "REF, 1, 5")))
