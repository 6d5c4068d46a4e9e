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
    share = np.clip(np.abs(forces[:, 2]), 0.0, 1.0)
    history = History(time, forces[:, 0], forces[:, 1], share, provenance={"label": label})
    history.write_csv(path)
    back = History.read_csv(path)
    np.testing.assert_allclose(back.time, time, rtol=0, atol=5.1e-10)
    np.testing.assert_allclose(back.normal_force, history.normal_force, rtol=0, atol=5.1e-6)
    np.testing.assert_allclose(back.tangential_force, history.tangential_force, rtol=0, atol=5.1e-6)
    assert set(back.provenance) == {"label"}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("time,force\n0,1\n", "time, force"),
        (f"{HEADER}\n0,1,2,0\n0,1,2,0\n", "sample 2"),
        (f"{HEADER}\n1,1,2,0\n0,1,2,0\n", "sample 2"),
        (f"{HEADER}\n0,1,2,0\n1,nan,2,0\n", "normal_force, sample 2"),
        (f"{HEADER}\n0,1,2,0\n", "1 sample"),
        (f"{HEADER}\n", "a header without rows"),
        (f"{HEADER}\n0,1,2,0\n1,x,2,0\n", "x"),
        (f"{HEADER}\n0,1,2\n1,1,2\n", "h.csv:2: got 3 cells, expected 4"),
        (f"{HEADER}\n0,1,2,0,9\n1,1,2,0,9\n", "h.csv:2: got 5 cells, expected 4"),
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


def test_a_model_leaves_out_what_it_does_not_know_and_adds_what_it_likes(tmp_path):
    path = tmp_path / "h.csv"
    path.write_text("temperature,time_s,normal_force_N\nhot,0,1\nhot,1,2\n")
    history = History.read_csv(path)
    assert list(history.normal_force) == [1.0, 2.0]
    assert not history.gives_tangential
    assert not history.gives_slip
    assert history.to_csv() == "time_s,normal_force_N\n0.000000000,1.00000\n1.000000000,2.00000\n"
    assert list(history.to_frame().columns) == ["time_s", "normal_force_N"]
    assert "T not given" in repr(history)


def test_a_column_of_nan_is_a_fault_not_a_column_left_out(tmp_path):
    path = tmp_path / "h.csv"
    path.write_text(f"{HEADER}\n0,1,nan,0\n1,2,nan,0\n")
    with pytest.raises(InputError, match="leave out a column"):
        History.read_csv(path)


def test_forces_in_kilonewtons_by_their_header_are_refused(tmp_path):
    path = tmp_path / "h.csv"
    path.write_text("time_s,normal_force_kN\n0,1\n1,2\n")
    with pytest.raises(InputError, match="normal_force_N"):
        History.read_csv(path)


def test_times_just_before_the_touch_keep_their_sign(tmp_path):
    """At 100 kHz a sample may lie microseconds before t = 0; forces that round to zero have none."""
    time = np.array([-1.5e-5, -5e-6, 5e-6, 1.5e-5])
    path = tmp_path / "fast.csv"
    History(time, np.array([-1e-9, 0.0, 1.0, 2.0]), np.full(4, -1e-9), np.zeros(4)).write_csv(path)
    np.testing.assert_array_equal(History.read_csv(path).time, time)
    assert "-0.00000," not in path.read_text(encoding="utf-8")
