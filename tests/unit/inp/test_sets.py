"""Sets: one reading of labels, names and GENERATE for engines and lint."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.inp import read_deck
from tread_validate.inp.sets import Sets

NODES, ELEMENTS = np.arange(1, 21), np.arange(1, 5)


def sets_of(folder: Path, text: str) -> Sets:
    path = folder / "a.inp"
    path.write_text(text, encoding="utf-8")
    return Sets(NODES, ELEMENTS, lambda labels: np.unique(np.concatenate([labels, labels + 4]))).read(
        read_deck(path).blocks
    )


def test_members_are_labels_and_sets_defined_before(tmp_path: Path) -> None:
    """Sorted, each once; a set given again grows; names do not depend on case and blanks unless quoted."""
    sets = sets_of(
        tmp_path,
        '*NSET, NSET=a\n5, 3, 5\n*NSET, NSET="a b"\n9\n*NSET, NSET=all\nA , "a b", 1,\n*NSET, NSET=A\n7\n'
        "*ELSET, ELSET=two\n1, 2\n*NSET, NSET=of, ELSET=two\n",
    )
    assert {name: found.tolist() for name, found in sets.nodes.items()} == {
        "A": [3, 5, 7], "a b": [9], "ALL": [1, 3, 5, 9], "OF": [1, 2, 5, 6],
    }  # fmt: skip


@settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(first=st.integers(1, 20), count=st.integers(0, 6), step=st.integers(1, 5))
def test_generate_is_the_arithmetic_series(first: int, count: int, step: int, tmp_path: Path) -> None:
    last = first + count * step
    if last > 20:
        return
    sets = sets_of(tmp_path, f"*NSET, NSET=G, GENERATE\n{first}, {last}, {step}\n")
    assert sets.nodes["G"].tolist() == list(range(first, last + 1, step))


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("*NSET, NSET=G, GENERATE\n1, 10, 2\n", "whole number of increments"),
        ("*NSET, NSET=G, GENERATE\n10, 1, 1\n", "first <= last"),
        ("*NSET, NSET=G, GENERATE\n1, 10, 0\n", "increment of 1 or more"),
        ("*NSET, NSET=G, GENERATE\n1, x\n", "first, last, increment"),
        ("*NSET, NSET=G, GENERATE\n18, 24\n", "no node 21"),
        ("*NSET, NSET=G, GENERATE\n1, 999999999\n", "no node 21"),
        ("*NSET, NSET=G\n1, 21\n", "node 21"),
        ("*NSET, NSET=G\n1, LATER\n*NSET, NSET=LATER\n1\n", "node set LATER"),
        ("*ELSET, ELSET=G\n5\n", "element 5"),
        ("*NSET, NSET=G, ELSET=NONE\n", "element set NONE"),
    ],
)
def test_what_does_not_exist_or_does_not_come_out_even_stops_at_its_line(text: str, says: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=rf"a\.inp:\d.*{says}"):
        sets_of(tmp_path, text)
