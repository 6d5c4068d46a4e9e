"""Finite element references: filed and found by the problem that was solved, bound to deck, engine and code."""

from __future__ import annotations

import gzip
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from tread_validate.errors import EngineError, InputError
from tread_validate.history import History
from tread_validate.inp import DeckFiles
from tread_validate.provenance import sha256_file
from tread_validate.reference import FeStore, engines_here
from tread_validate.reference.deck_store import read_problem
from tread_validate.reference.fe_store import Reference
from tread_validate.reference.filing import drop_unused_blocks, file_run, read_run
from tread_validate.source_code import code_digest

NODES = "".join(f"{i + 1}, {0.5 * i:.5f}, 0.0\n" for i in range(40))


def deck(folder: Path, case_id: str = "case-a", speed: str = "3.14159", nodes: str = NODES) -> DeckFiles:
    """Write a deck with a table and one number to change."""
    place = folder / case_id
    place.mkdir(parents=True, exist_ok=True)
    text = f"*HEADING\n{case_id}\n*NODE, NSET=ALL\n{nodes}*ELASTIC\n5.25, 0.47\n*STEP\n{speed}, 0.0158\n*END STEP\n"
    (place / f"{case_id}.inp").write_text(text, encoding="utf-8")
    return DeckFiles(place / f"{case_id}.inp", place / "vfric.f")


def run(folder: Path, files: DeckFiles, peak: float = 100.0, **changes: Any) -> Path:
    """Write a finished run of a deck, half a sine, with its record."""
    path = folder / f"{files.deck.stem}.csv"
    time = np.linspace(0.0, 0.01, 101)
    force = peak * np.sin(np.pi * time / 0.01).clip(0)
    History(time, force, 0.2 * force, np.zeros(101)).write_csv(path)
    record = {
        "case_id": files.deck.stem,
        "engine": "embedded",
        "code": code_digest("fe"),
        "deck_digest": files.problem.digest,
        "history_sha256": sha256_file(path),
        **changes,
    }
    path.with_suffix(".yaml").write_text(yaml.safe_dump(record), encoding="utf-8")
    return path


def filed(store: Path, folder: Path, files: DeckFiles, **more: Any) -> Path:
    """Run and file a deck and return the run's folder."""
    replace = more.pop("replace", False)
    return file_run(FeStore(store), read_run(run(folder, files, **more), files), study="one", replace=replace)


@pytest.fixture
def store(tmp_path: Path) -> Path:
    """A store with one good run, case-a at 3.14159."""
    filed(tmp_path / "store", tmp_path, deck(tmp_path / "decks"))
    return tmp_path / "store"


def status(store: Path, files: DeckFiles | None, case_id: str = "case-a", engine: str = "embedded") -> str:
    return FeStore(store).find(engine, case_id, files).status


def test_a_run_of_today_s_problem_is_current_whatever_study_and_case_ask(store: Path, tmp_path: Path) -> None:
    """A colleague's clone, another study, another name of the case: the same problem, so the same run."""
    found = FeStore(store).find("embedded", "other-name", deck(tmp_path / "elsewhere", "other-name"))
    assert (found.status, found.reason) == ("current", "")
    assert found.history is not None
    assert found.history.normal_force.max() == pytest.approx(100.0)


def test_numbers_that_agree_to_the_tolerance_are_the_same_problem(store: Path, tmp_path: Path) -> None:
    """A speed 6e-7 apart, as another machine's arithmetic may give, keeps its run; 3e-5 apart does not."""
    assert status(store, deck(tmp_path / "b", speed="3.141592")) == "current"
    assert status(store, deck(tmp_path / "c", speed="3.1417")) == "stale"


def test_a_stale_run_says_which_line_differs_and_by_how_much(store: Path, tmp_path: Path) -> None:
    """File, line, both numbers, their distance."""
    found = FeStore(store).find("embedded", "case-a", deck(tmp_path / "b", speed="6.28318"))
    assert found.history is None
    assert found.reason == ("made from another deck: case-a.inp:47: 3.14159 when it was run, 6.28318 today (0.5 apart)")
    assert status(store, None) == "stale"


def test_no_run_is_missing(store: Path, tmp_path: Path) -> None:
    """Neither this problem nor this name, or another engine."""
    assert status(store, deck(tmp_path / "b", "case-b", speed="1.0"), "case-b") == "missing"
    assert status(store, deck(tmp_path / "b"), engine="abaqus") == "missing"


def test_two_studies_with_equal_case_ids_live_side_by_side(store: Path, tmp_path: Path) -> None:
    """Another problem of the same name gets a folder of its own and leaves the first as it is."""
    before = {path: path.read_bytes() for path in store.rglob("*") if path.is_file()}
    other = deck(tmp_path / "b", speed="6.28318")
    filed(store, tmp_path / "b", other, peak=200.0)
    assert all(path.read_bytes() == data for path, data in before.items())
    assert status(store, deck(tmp_path / "a")) == "current"
    found = FeStore(store).find("embedded", "case-a", other)
    assert found.history is not None
    assert found.history.normal_force.max() == pytest.approx(200.0)


def test_tables_that_decks_share_are_stored_once(store: Path, tmp_path: Path) -> None:
    """One block for both decks; its bytes do not depend on the clock; it goes with the last deck that needs it."""
    filed(store, tmp_path / "b", deck(tmp_path / "b", speed="6.28318"))
    (block,) = (store / "fe" / "blocks").iterdir()
    assert block.read_bytes()[4:8] == b"\0\0\0\0"
    for folder in (store / "fe" / "embedded").iterdir():
        problem = read_problem(store / "fe" / "blocks", folder / "deck.txt")
        assert problem.digest == yaml.safe_load((folder / "record.yaml").read_text())["deck_digest"]
        assert drop_unused_blocks(FeStore(store)) == 0
        shutil.rmtree(folder)
    assert drop_unused_blocks(FeStore(store)) == 1


def test_a_run_that_differs_beyond_noise_needs_a_word(store: Path, tmp_path: Path) -> None:
    """1e-5 of the peak is noise; 1 % is not: refused with both peaks, filed with --replace."""
    files = deck(tmp_path / "b")
    folder = filed(store, tmp_path / "b", files, peak=100.001)
    with pytest.raises(InputError, match=r"peak normal force 100.0010 N filed, 101.0000 N now.*--replace"):
        filed(store, tmp_path / "b", files, peak=101.0)
    assert History.read_csv(folder / "history.csv").normal_force.max() == pytest.approx(100.001)
    assert filed(store, tmp_path / "b", files, peak=101.0, replace=True) == folder
    assert History.read_csv(folder / "history.csv").normal_force.max() == pytest.approx(101.0)


def test_a_run_is_filed_under_the_engine_of_its_record(tmp_path: Path) -> None:
    """Whatever engine the study or an option names; another one than --engine says is refused."""
    files = deck(tmp_path)
    history = run(tmp_path, files)
    folder = file_run(FeStore(tmp_path / "store"), read_run(history, files), study="one")
    assert folder.parent.name == "embedded"
    with pytest.raises(InputError, match="engine: got embedded, expected abaqus"):
        read_run(history, files, "abaqus")
    with pytest.raises(InputError, match="expected one of embedded, abaqus, calculix"):
        read_run(run(tmp_path, files, engine="adams"), files)


def test_a_run_is_not_filed_with_a_deck_that_it_was_not_made_from(tmp_path: Path) -> None:
    """The deck changed after the run; a record without digests; an edited history."""
    files = deck(tmp_path)
    history = run(tmp_path, files)
    with pytest.raises(InputError, match="run it again"):
        read_run(history, deck(tmp_path / "b", speed="1.0"))
    with pytest.raises(InputError, match="deck_digest: got None"):
        read_run(run(tmp_path, files, deck_digest=None), files)
    with pytest.raises(InputError, match="another checksum"):
        read_run(run(tmp_path, files, history_sha256="0" * 64), files)


def test_a_run_made_before_the_engine_s_code_changed_is_marked(tmp_path: Path) -> None:
    """It keeps its history, but is not called current."""
    files = deck(tmp_path)
    filed(tmp_path / "store", tmp_path, files, code="0123456789abcdef")
    found = FeStore(tmp_path / "store").find("embedded", "case-a", files)
    assert (found.status, found.history is None) == ("other_code", False)
    assert "made by code 0123456789abcdef; the part fe is" in found.reason


@pytest.mark.parametrize(
    "how",
    [
        "no record", "no history", "edited", "cut", "not YAML", "a list", "another case", "binary", "another engine",
        "no digest", "no deck", "no block", "deck edited", "block edited", "block garbled",
    ],
)  # fmt: skip
def test_what_cannot_be_trusted_is_corrupt(how: str, store: Path, tmp_path: Path) -> None:
    """Each fault gives the status and a one-line reason, never an exception and never a history."""
    (folder,) = (store / "fe" / "embedded").iterdir()
    record, history = folder / "record.yaml", folder / "history.csv"
    if how == "no record":
        record.unlink()
    elif how == "no history":
        history.unlink()
    elif how == "edited":
        history.write_text(history.read_text(encoding="utf-8").replace("95.", "96."), encoding="utf-8")
    elif how == "cut":
        history.write_bytes(history.read_bytes()[:1000])
    elif how == "not YAML":
        record.write_text("a: [\n", encoding="utf-8")
    elif how == "a list":
        record.write_text("- 1\n", encoding="utf-8")
    elif how == "binary":
        history.write_bytes(b"\x00\xff\x00")
    elif how == "no deck":
        (folder / "deck.txt").unlink()
    elif how == "no block":
        (block,) = (store / "fe" / "blocks").iterdir()
        block.unlink()
    elif how == "deck edited":
        text = (folder / "deck.txt").read_text(encoding="utf-8")
        (folder / "deck.txt").write_text(text.replace("5.25", "5.24"), encoding="utf-8")
    elif how == "block edited":
        (block,) = (store / "fe" / "blocks").iterdir()
        block.write_bytes(gzip.compress(b"1,2,3"))
    elif how == "block garbled":
        (block,) = (store / "fe" / "blocks").iterdir()
        block.write_bytes(block.read_bytes()[:12] + b"\xff" * 40)
    else:
        key, value = {
            "another case": ("case_id", "case-b"),
            "another engine": ("engine", "abaqus"),
            "no digest": ("deck_digest", None),
        }[how]
        data = yaml.safe_load(record.read_text(encoding="utf-8"))
        record.write_text(yaml.safe_dump({**data, key: value}), encoding="utf-8")
    found = FeStore(store).find("embedded", "case-a", deck(tmp_path / "b"))
    assert found.status == "corrupt"
    assert found.history is None
    assert "make reference" in found.reason
    assert "\n" not in found.reason
    assert dict(FeStore(store).check())[f"fe/embedded/{folder.name}"].startswith("corrupt")


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (0.02, 0.02),
        ({"peak_normal_force": 0.01, "note": "text"}, {"peak_normal_force": 0.01}),
        (None, None),
        (-0.1, None),
        (float("nan"), None),
        (True, None),
        ("small", None),
    ],
)
def test_the_mesh_error_that_a_record_states_is_read_where_it_is_a_number(
    value: Any, expected: Any, tmp_path: Path
) -> None:
    """A number for all forces or numbers by quantity; anything else counts as not known."""
    files = deck(tmp_path)
    filed(tmp_path / "store", tmp_path, files, mesh_error=value)
    assert FeStore(tmp_path / "store").find("embedded", "case-a", files).stated_error() == expected


def test_the_old_layout_is_refused_by_name(store: Path) -> None:
    """Never guessed: the verb that reads it once is named."""
    (store / "fe" / "embedded" / "case-b.csv").write_text("time_s\n", encoding="utf-8")
    with pytest.raises(InputError, match="migrate-references"):
        FeStore(store).entries("embedded")


def test_an_engine_that_is_not_here_is_said_before_anything_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """No ABAQUS, no CalculiX, no compiler: a line with the way out."""
    monkeypatch.setenv("PATH", "/nowhere")
    for engine, way in (("abaqus", "import-abaqus"), ("calculix", "calculix-ccx"), ("embedded", "gfortran")):
        with pytest.raises(EngineError, match=f"engine {engine}.*nothing was run.*{way}"):
            engines_here.require(engine)


def test_run_whose_energies_cannot_be_believed_says_so_and_one_that_is_not_judged_does_not():
    time = np.linspace(0.0, 0.01, 5)
    history = History.of(time, np.array([0.0, 1.0, 2.0, 1.0, 0.0]))
    reasons = ["energy unaccounted for is 3 % of the internal energy or external work, at most 1 %"]
    bad = Reference(
        "case",
        "embedded",
        "current",
        history=history,
        record={"reference_quality": {"usable": False, "reasons": reasons}},
    )
    good = Reference(
        "case", "embedded", "current", history=history, record={"reference_quality": {"usable": True, "reasons": []}}
    )
    assert "3 %" in bad.fault()
    assert good.fault() == ""
    assert Reference("case", "abaqus", "current", history=history).fault() == ""
