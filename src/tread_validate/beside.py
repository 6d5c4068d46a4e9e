"""A part of a job's work in a process beside this one, which has all that was read and loaded so far."""

from __future__ import annotations

import gc
import os
import pickle
import warnings
from collections.abc import Callable
from typing import TypeVar

Result = TypeVar("Result")


def beside(work: Callable[[], Result], jobs: int) -> Callable[[], Result]:
    """Begin `work` in a forked process where `jobs` is 2 or more; return what waits for its result.

    The result comes back pickled. Where there is no second process to be had (one job, a system without ``fork``) and
    where the process fails, which a warning says, the work is done here when its result is asked for: so the result is
    the same, and what is wrong is raised here. The work must not need threads that a library may have begun here
    before (typst, say): they are not in the fork. The linear algebra knows of forks.
    """
    if jobs < 2 or not hasattr(os, "fork"):
        return work
    reader, writer = os.pipe()
    gc.freeze()  # what is there stays where it is: the collector of neither process has to look at it
    with warnings.catch_warnings():
        # the threads that Python warns of are those of the linear algebra, which are idle and know of forks
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        _answer(work, reader, writer)
    os.close(writer)
    gc.unfreeze()

    def wait() -> Result:
        with os.fdopen(reader, "rb") as pipe:
            answer = pipe.read()
        _, status = os.waitpid(child, 0)
        if status != 0:
            warnings.warn(f"a second process ended early (status {status}); its work is done again here", stacklevel=2)
            return work()
        result: Result = pickle.loads(answer)
        return result

    return wait


def _answer(work: Callable[[], object], reader: int, writer: int) -> None:
    """Do the work in the child, send what came out and end, without anything that this process would do at its end."""
    status = 1
    try:
        os.close(reader)
        answer = pickle.dumps(work(), protocol=pickle.HIGHEST_PROTOCOL)
        with os.fdopen(writer, "wb") as pipe:
            pipe.write(answer)
        status = 0
    finally:
        os._exit(status)
