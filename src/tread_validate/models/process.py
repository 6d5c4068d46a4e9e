"""One child process: no shell, its own log, a time limit for it and all it started, and what it cost."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import one_line
from ..files import atomic_path
from ..units import MEGABYTE

POLL = 0.002
"""Longest time between looks at a running child, s."""


@dataclass(frozen=True)
class Finished:
    """How a child process ended.

    Attributes
    ----------
    fault : str
        Why it did not do its work, in one line; empty where it ended with code 0 in time.
    cpu_s : float, s
    memory_MB : float or None
        Largest resident memory; None where the run was too short to be looked at.
    """

    fault: str
    cpu_s: float
    memory_MB: float | None


def run_process(
    arguments: Sequence[str], folder: Path, environment: Mapping[str, str], time_limit: float, log: Path
) -> Finished:
    """Run a program to its end or its time limit (s), with its output in `log`; never raises for what it does."""
    with atomic_path(log) as temporary, temporary.open("wb") as output:
        try:
            child = subprocess.Popen(
                list(arguments),
                cwd=folder,
                env={**os.environ, **environment},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except OSError as error:
            return Finished(one_line(f"{arguments[0]} does not start: {error.strerror or error}"), 0.0, None)
        code, cpu, memory, late = _wait(child, time_limit)
    if late:
        return Finished(f"no end within its time limit of {time_limit:g} s", cpu, memory)
    if code == 0:
        return Finished("", cpu, memory)
    ended = f"exit code {code}" if code > 0 else f"signal {signal.Signals(-code).name}"
    said = last_line(log)
    return Finished(one_line(f"{ended}: {said}" if said else ended), cpu, memory)


def last_line(log: Path) -> str:
    """Return the last line of a log that says anything."""
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines() if log.is_file() else []
    said = [line.strip() for line in lines if line.strip()]
    return one_line(said[-1], 200) if said else ""


def _wait(child: subprocess.Popen[bytes], time_limit: float) -> tuple[int, float, float | None, bool]:
    """Return exit code, processor time (s), memory (MB) and whether it ran out of time; all it started is ended."""
    end, pause = time.monotonic() + time_limit, 1e-4
    memory: float | None = None
    late = False
    while True:
        # what wait4 gives as largest memory may be that of this process, which the child was forked from
        memory = _memory(child.pid) or memory
        pid, status, usage = os.wait4(child.pid, os.WNOHANG)
        if pid:
            break
        if time.monotonic() > end:
            late = True
            _kill(child.pid)
            _, status, usage = os.wait4(child.pid, 0)
            break
        time.sleep(pause)
        pause = min(2.0 * pause, POLL)
    child.returncode = os.waitstatus_to_exitcode(status)
    _kill(child.pid)  # what it left running in the background
    return child.returncode, usage.ru_utime + usage.ru_stime, memory, late


def _memory(pid: int) -> float | None:
    """Return the largest resident memory of a running process so far, MB."""
    try:
        lines = Path(f"/proc/{pid}/status").read_text(encoding="ascii", errors="replace").splitlines()
    except OSError:
        return None
    return next((float(line.split()[1]) * 1024 / MEGABYTE for line in lines if line.startswith("VmHWM:")), None)


def _kill(group: int) -> None:
    try:
        os.killpg(group, signal.SIGKILL)
    except (ProcessLookupError, PermissionError):
        return
