"""Verbs run side by side in processes that stay, so that imports and compiled kernels are loaded once a process.

A verb that takes its process with it (a routine of the user's that crashes, stops or never comes back) fails alone: the
next one gets a new process.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import time
import warnings
from collections import deque
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any

from ..errors import EngineError, one_line

PREFIX = "tread-validate: "
GRACE = 5.0  # s that a process has to clean up when it is told to end


@dataclass(frozen=True)
class VerbRun:
    """A verb's arguments, verb first, and the file that takes what it prints."""

    name: str
    arguments: tuple[str, ...]
    log: Path


@dataclass(frozen=True)
class Done:
    """How a job ended.

    Attributes
    ----------
    code : int
        The verb's exit code, see docs/exit_codes.md.
    fault : str
        Its last line where the code is not 0.
    seconds, cpu_seconds : float, s
        Wall and processor time of the job alone; processor time is nan where the process was lost.
    memory : float, MB
        The most that its process has held so far, this job and those before it; nan where the process was lost.
    """

    job: VerbRun
    code: int
    fault: str
    seconds: float
    cpu_seconds: float
    memory: float


def run_side_by_side(jobs: Sequence[VerbRun], processes: int) -> Generator[Done, None, None]:
    """Run jobs in the order given, `processes` at a time, and yield each as it ends.

    The iterator must be closed (`contextlib.closing`): what then still runs is ended and leaves nothing half-written.
    """
    waiting, idle, busy = deque(jobs), list[_Process](), dict[Connection, _Process]()
    try:
        while waiting or busy:
            while waiting and len(busy) < processes:
                process = idle.pop() if idle else _Process()
                process.begin(waiting.popleft())
                busy[process.connection] = process
            ended = [busy.pop(connection) for connection in wait(list(busy)) if isinstance(connection, Connection)]
            done = [process.end() for process in ended]
            idle += [process for process in ended if process.lives]
            while waiting and idle:  # work first: whoever takes what is yielded may take his time
                process = idle.pop()
                process.begin(waiting.popleft())
                busy[process.connection] = process
            yield from done
    finally:
        for process in [*idle, *busy.values()]:
            process.stop()


class _Process:
    """A process that runs one job after another."""

    def __init__(self) -> None:
        context = get_context("spawn")
        self.connection, theirs = context.Pipe()
        self.process = context.Process(target=_serve, args=(theirs,), daemon=True)
        self.process.start()
        theirs.close()
        self.lives = True
        self.job = VerbRun("", (), Path(os.devnull))
        self.begun = 0.0

    def begin(self, job: VerbRun) -> None:
        self.job, self.begun = job, time.monotonic()
        with contextlib.suppress(BrokenPipeError):  # a process that is gone is told of by `end`
            self.connection.send(job)

    def end(self) -> Done:
        try:
            code, cpu_seconds, memory = self.connection.recv()
        except (EOFError, ConnectionResetError):
            self.lives = False
            self.process.join()
            code, cpu_seconds, memory = self.process.exitcode or 0, float("nan"), float("nan")
        fault = "" if code == 0 and self.lives else _last_words(self.job.log) or _death(code)
        code = code if code > 0 or self.lives else EngineError.exit_code
        return Done(self.job, code, fault, time.monotonic() - self.begun, cpu_seconds, memory)

    def stop(self) -> None:
        self.connection.close()
        self.process.terminate()
        self.process.join(GRACE)
        if self.process.is_alive():  # in a routine that never comes back
            self.process.kill()
            self.process.join()


def _last_words(log: Path) -> str:
    """Return the last line that a verb printed on its way out, or nothing."""
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.is_file() else []
    said = [line for line in lines if line.startswith(PREFIX) and not line.startswith(f"{PREFIX}warning:")]
    return one_line(said[-1].removeprefix(PREFIX)) if said else ""


def _death(code: int) -> str:
    if code < 0:
        return f"its process was ended by {signal.Signals(-code).name}"
    return f"its process ended with {code} before the job did"


def _serve(connection: Any) -> None:
    """Run the jobs that come, until no more can; an interrupt from the keyboard is the parent's business."""
    from .app import EXIT_INTERRUPTED, run, say_warning

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, _interrupt)
    while True:
        try:
            job = connection.recv()
            _print_into(job.log)
            begun = time.process_time()
            with warnings.catch_warnings():  # so that each job says its own
                warnings.showwarning = say_warning
                code = run(job.arguments)
            connection.send((code, time.process_time() - begun, _memory()))
        except (EOFError, BrokenPipeError, ConnectionResetError, KeyboardInterrupt):  # the parent is gone, or is going
            return
        if code == EXIT_INTERRUPTED:
            return


def _interrupt(*_of: object) -> None:
    raise KeyboardInterrupt


def _print_into(log: Path) -> None:
    """Let this process, compiled routines included, print into a file of its own."""
    log.parent.mkdir(parents=True, exist_ok=True)
    sys.stdout.flush()
    sys.stderr.flush()
    file = os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o666)
    for printed in (1, 2):
        os.dup2(file, printed)
    os.close(file)


def _memory() -> float:
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
