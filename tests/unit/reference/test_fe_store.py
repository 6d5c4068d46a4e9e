"""Finite element references: current, stale, missing, corrupt; and the mesh error that a record carries."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.history import History
from tread_validate.provenance import sha256_file
from tread_validate.reference import check_store, fe_path, load_fe

DIGEST = "d" * 64


@pytest.fixture
def store(tmp_path: Path) -> Path:
    """A store with one good run, case-a."""
    path = fe_path(tmp_path, "embedded", "case-a")
    History([0.0, 1.0, 2.0], [0.0, 5.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]).write_csv(path)
    write_record(path, {})
    return tmp_path


def write_record(path: Path, changes: dict[str, Any]) -> None:
    record = {"case_id": "case-a", "engine": "embedded", "deck_digest": DIGEST, "history_sha256": sha256_file(path)}
    record.update(changes)
    path.with_suffix(".yaml").write_text(yaml.safe_dump(record), encoding="utf-8")


def test_a_run_of_today_s_deck_is_current(store: Path) -> None:
    """Digest and checksum fit: the history is there, and no reason."""
    found = load_fe(store, "embedded", "case-a", DIGEST)
    assert (found.status, found.reason) == ("current", "")
    assert found.history is not None
    assert found.history.normal_force.max() == 5.0


def test_a_run_of_another_deck_is_stale(store: Path) -> None:
    """Another digest, or no deck at hand to compare with."""
    assert load_fe(store, "embedded", "case-a", "e" * 64).status == "stale"
    assert load_fe(store, "embedded", "case-a", None).status == "stale"


def test_no_run_is_missing(store: Path) -> None:
    """Neither history nor record."""
    assert load_fe(store, "embedded", "case-b", DIGEST).status == "missing"
    assert load_fe(store, "abaqus", "case-a", DIGEST).status == "missing"


@pytest.mark.parametrize("how", ["no record", "no history", "edited", "not YAML", "a list", "another case", "binary"])
def test_what_cannot_be_trusted_is_corrupt(how: str, store: Path) -> None:
    """Each fault gives the status and a one-line reason, never an exception and never a history."""
    path = fe_path(store, "embedded", "case-a")
    record = path.with_suffix(".yaml")
    if how == "no record":
        record.unlink()
    elif how == "no history":
        path.unlink()
    elif how == "edited":
        path.write_text(path.read_text(encoding="utf-8").replace("5.0", "6.0"), encoding="utf-8")
    elif how == "not YAML":
        record.write_text("a: [\n", encoding="utf-8")
    elif how == "a list":
        record.write_text("- 1\n", encoding="utf-8")
    elif how == "another case":
        write_record(path, {"case_id": "case-b"})
    else:
        path.write_bytes(b"\x00\xff\x00")
    found = load_fe(store, "embedded", "case-a", DIGEST)
    assert found.status == "corrupt"
    assert found.history is None
    assert found.reason
    assert "\n" not in found.reason


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
def test_the_mesh_error_is_read_where_it_is_a_number(value: Any, expected: Any, store: Path) -> None:
    """A number for all forces or numbers by quantity; anything else counts as not known."""
    write_record(fe_path(store, "embedded", "case-a"), {"mesh_error": value})
    assert load_fe(store, "embedded", "case-a", DIGEST).uncertainty() == expected


def test_a_store_is_checked_run_by_run(store: Path) -> None:
    """One run and a further table of it: fine. A history without a record and a wrong checksum are named."""
    path = fe_path(store, "embedded", "case-a")
    path.with_name("case-a_face.csv").write_text("x_m,pressure_Pa\n0,1\n", encoding="utf-8")
    assert check_store(store) == (("fe/embedded", "1 runs"),)
    path.with_name("case-b.csv").write_bytes(path.read_bytes())
    write_record(path, {"history_sha256": "0" * 64})
    found = dict(check_store(store))
    assert "checksum" in found["fe/embedded/case-a"]
    assert "without its record" in found["fe/embedded/case-b"]
    assert check_store(store / "nothing here") == ()
