"""Work in a process beside this one."""

from __future__ import annotations

import contextlib
import os

import numpy as np
import pytest

from tread_validate.beside import beside
from tread_validate.errors import InputError


@pytest.mark.parametrize("jobs", [1, 2])
def test_work_beside_gives_what_it_gives_here(jobs: int) -> None:
    """The result is the same with one process and with two; with two the work is another process's."""
    values = np.arange(5.0)
    waits = beside(lambda: (os.getpid(), values * 2.0), jobs)
    by, doubled = waits()
    assert (by == os.getpid()) == (jobs == 1)
    assert doubled.tolist() == [0.0, 2.0, 4.0, 6.0, 8.0]


@pytest.mark.parametrize("jobs", [1, 2])
def test_what_is_wrong_is_raised_where_the_result_is_asked_for(jobs: int) -> None:
    """An error of the input is the same error, with its place."""

    def work() -> None:
        raise InputError("study.yaml: speed", "-1", "more than 0")

    waits = beside(work, jobs)
    said = pytest.warns(UserWarning, match="ended early") if jobs > 1 else contextlib.nullcontext()
    with said, pytest.raises(InputError, match="speed"):
        waits()


def test_a_process_that_is_killed_costs_time_and_nothing_else() -> None:
    """Whoever asks does the work again, and says so."""
    here = os.getpid()

    def work() -> str:
        if os.getpid() != here:
            os.kill(os.getpid(), 9)
        return "done"

    waits = beside(work, 2)
    with pytest.warns(UserWarning, match="ended early"):
        assert waits() == "done"


def test_two_run_at_once() -> None:
    """The other process works before anybody waits for it."""
    reader, writer = os.pipe()
    waits = beside(lambda: os.write(writer, b"begun"), 2)
    assert os.read(reader, 5) == b"begun"
    assert waits() == 5
    os.close(reader)
    os.close(writer)
