"""A reference that was altered, cut off or swapped with another's is corrupt, never compared."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

from tread_validate.history import History
from tread_validate.provenance import sha256_file
from tread_validate.reference import load_fe

DIGEST = "d" * 64


@pytest.fixture
def store(tmp_path):
    """Two good runs, of cases a and b."""
    folder = tmp_path / "fe" / "embedded"
    folder.mkdir(parents=True)
    time = np.linspace(0.0, 0.01, 50)
    for case, peak in (("a", 100.0), ("b", 200.0)):
        path = folder / f"{case}.csv"
        force = peak * np.sin(np.pi * time / 0.01).clip(0)
        History(time, force, 0.2 * force, np.zeros(50)).write_csv(path)
        record = {"case_id": case, "deck_digest": DIGEST, "history_sha256": sha256_file(path)}
        path.with_suffix(".yaml").write_text(yaml.safe_dump(record))
    return tmp_path


def status(store, case):
    return load_fe(store, "embedded", case, DIGEST).status


def test_good_runs_are_current(store):
    assert [status(store, case) for case in "ab"] == ["current", "current"]


@pytest.mark.parametrize("share", [0.0, 0.3, 0.99])
def test_truncated_history_is_corrupt(store, share):
    path = store / "fe" / "embedded" / "a.csv"
    data = path.read_bytes()
    path.write_bytes(data[: int(share * len(data))])
    assert status(store, "a") == "corrupt"


def test_single_digit_changed_is_corrupt(store):
    path = store / "fe" / "embedded" / "a.csv"
    text = path.read_text()
    at = text.rindex("0.", 0, len(text) // 2)
    path.write_text(text[:at] + "1." + text[at + 2 :])
    assert status(store, "a") == "corrupt"


def test_swapped_histories_are_corrupt(store):
    """Histories of two cases exchanged under their records."""
    a, b = (store / "fe" / "embedded" / f"{case}.csv" for case in "ab")
    one, other = a.read_bytes(), b.read_bytes()
    a.write_bytes(other)
    b.write_bytes(one)
    assert [status(store, case) for case in "ab"] == ["corrupt", "corrupt"]


def test_swapped_pairs_are_corrupt(store):
    """History and record of one case under the name of the other: the record still names its own case."""
    folder = store / "fe" / "embedded"
    for suffix in (".csv", ".yaml"):
        a, b = folder / f"a{suffix}", folder / f"b{suffix}"
        one, other = a.read_bytes(), b.read_bytes()
        a.write_bytes(other)
        b.write_bytes(one)
    assert [status(store, case) for case in "ab"] == ["corrupt", "corrupt"]


def test_missing_half_of_a_pair_is_corrupt(store):
    folder = store / "fe" / "embedded"
    (folder / "a.yaml").unlink()
    (folder / "b.csv").unlink()
    assert [status(store, case) for case in "ab"] == ["corrupt", "corrupt"]
