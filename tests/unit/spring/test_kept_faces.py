"""What is kept on disk between processes changes no number, and is never believed when damaged."""

import numpy as np
import pytest

from tread_validate.source_code import PACKAGE, Graph
from tread_validate.spring.condensed import kept as store
from tread_validate.spring.condensed.roll import roll
from tread_validate.spring.condensed.store import converged_stuck, ready
from tread_validate.study import load_study

ARRAYS = {"one": np.arange(6.0).reshape(2, 3), "two": np.float32([1, 2, 3])}


@pytest.fixture
def own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("TREAD_VALIDATE_CACHE", str(tmp_path))
    for each in (ready, converged_stuck):
        each.cache_clear()
    yield tmp_path
    for each in (ready, converged_stuck):
        each.cache_clear()


def same(found):
    return found is not None and all(np.array_equal(found[name], array) for name, array in ARRAYS.items())


def test_arrays_come_back_as_they_were(own_cache):
    store.keep("thing", "key", ARRAYS)
    assert same(store.load("thing", "key"))
    assert store.load("thing", "other key") is None


@pytest.mark.parametrize("damage", ["flip", "cut", "empty", "head"])
def test_a_damaged_file_is_made_anew(own_cache, damage):
    store.keep("thing", "key", ARRAYS)
    (path,) = own_cache.glob("thing-*")
    data = bytearray(path.read_bytes())
    if damage == "flip":
        data[store.PAGE + 17] ^= 4
    elif damage == "head":
        data[3] ^= 4
    path.write_bytes(data[: {"cut": -64, "empty": 0}.get(damage, len(data))])
    assert store.load("thing", "key") is None
    assert same(store.kept("thing", "key", lambda: ARRAYS))
    assert same(store.load("thing", "key"))


def test_nothing_is_kept_where_nothing_can_be_written(own_cache, monkeypatch):
    (own_cache / "file").write_text("")
    monkeypatch.setenv("TREAD_VALIDATE_CACHE", str(own_cache / "file"))
    assert same(store.kept("thing", "key", lambda: ARRAYS))
    monkeypatch.setenv("TREAD_VALIDATE_CACHE", "off")
    assert store.folder() is None
    assert same(store.kept("thing", "key", lambda: ARRAYS))


def test_files_used_longest_ago_go_first(own_cache, monkeypatch):
    monkeypatch.setattr(store, "MOST_BYTES", 2 * store.PAGE + 200)
    for key in "abc":
        store.keep("thing", key, {"one": np.zeros(4)})
    assert [store.load("thing", key) is not None for key in "abc"] == [False, True, True]


def test_a_kept_face_gives_the_forces_of_a_new_one(own_cache, paper_study):
    """Bit for bit: the same arrays go into the same kernel."""
    case = load_study(paper_study).case("rig-rectangle-22c-0p2mm-300rpm")
    new = roll(case)
    assert {path.name.split("-")[0] for path in own_cache.iterdir()} == {"face", "stiffness", "stuck", "windows"}
    ready.cache_clear()
    again = roll(case)
    assert np.array_equal(new.force, again.force)


def test_all_code_that_makes_the_arrays_is_in_their_key():
    """Every module of the spring package that `store` depends on, by the import graph."""
    here = "spring.condensed."
    listed = {name.removesuffix(".py") for name in store.SOURCES}
    listed = {"spring.stiffness" if "stiffness" in name else here + name for name in listed if "units" not in name}
    reached = Graph(PACKAGE).closure(["spring.condensed.store"])
    needed = {name for name in reached if name.startswith("spring.") and " " not in name}
    assert needed - listed <= {
        "spring.condensed.kept",
        "spring.inputs",
        "spring.condensed.contact",
        "spring.condensed.step",
    }
