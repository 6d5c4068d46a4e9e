"""A history reads back as it was written, and a wrong one is refused."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from tread_validate.errors import InputError
from tread_validate.history import COLUMNS, History

HEADER = ",".join(COLUMNS)


@given(
    forces=hnp.arrays(np.float64, st.tuples(st.integers(2, 40), st.just(3)), elements=st.floats(-1e5, 1e5)),
    label=st.text(max_size=60),
)
def test_history_reads_back_within_its_printed_digits(tmp_path_factory, forces, label):
    """Forces are printed to 1e-5 N, so they come back within half of that."""
    path = tmp_path_factory.mktemp("history") / "h.csv"
    time = 1e-5 * np.arange(len(forces))
    history = History(time, *forces.T, provenance={"label": label})
    history.write_csv(path)
    back = History.read_csv(path)
    np.testing.assert_allclose(back.time, time, rtol=0, atol=5.1e-10)
    np.testing.assert_allclose(back.normal_force, history.normal_force, rtol=0, atol=5.1e-6)
    np.testing.assert_allclose(back.tangential_force, history.tangential_force, rtol=0, atol=5.1e-6)
    assert set(back.provenance) == {"label"}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("time,force\n0,1\n", "time,force"),
        (f"{HEADER}\n0,1,2,0\n0,1,2,0\n", "sample 2"),
        (f"{HEADER}\n1,1,2,0\n0,1,2,0\n", "sample 2"),
        (f"{HEADER}\n0,1,2,0\n1,nan,2,0\n", "normal_force, sample 2"),
        (f"{HEADER}\n0,1,2,0\n", "1 sample"),
        (f"{HEADER}\n", "0 sample"),
        (f"{HEADER}\n0,1,2,0\n1,x,2,0\n", "x"),
        (f"{HEADER}\n0,1,2\n1,1,2\n", "h.csv:2: got 0,1,2"),
        (f"{HEADER}\n0,1,2,0,9\n1,1,2,0,9\n", "expected four numbers"),
        ("# a: b\n", "no header"),
    ],
)
def test_wrong_history_file_is_one_line(tmp_path, text, found):
    path = tmp_path / "h.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=r"h\.csv") as caught:
        History.read_csv(path)
    assert found in str(caught.value)
    assert "\n" not in str(caught.value)


def test_history_cannot_be_changed_after_the_fact():
    history = History(np.arange(3.0), *np.zeros((3, 3)))
    with pytest.raises(ValueError, match="read-only"):
        history.normal_force[0] = 1.0
