"""A model that is a Python function, in a process of its own: it may hang or crash and loses that case only."""

from __future__ import annotations

import contextlib
import json
import os
import selectors
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType
from typing import Any, BinaryIO, Self

from ..errors import one_line
from ..study.own_model import PythonModel
from .process import Finished, last_line

START_LIMIT = 60.0
"""Time allowed to the import of the model, s, beside its limit for a case."""


class PythonRunner:
    """One worker process, started again after a case that hung or crashed.

    Use as a context manager; `run` hands it a case file and the history to write.
    """

    def __init__(self, model: PythonModel, root: Path, log: Path) -> None:
        self._name = model.object or model.entry_point or ""
        self._limit = model.time_limit_s
        self._root = root
        self._log_path = log
        self._log: BinaryIO | None = None
        self._child: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> Self:
        self._log_path.parent.mkdir(parents=True, exist_ok=True)
        self._log = self._log_path.open("wb")
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, tb: TracebackType | None) -> None:
        self._stop()
        if self._log is not None:
            self._log.close()

    def run(self, case: Path, history: Path) -> Finished:
        """Run one case; never raises for what the model does."""
        if self._child is None:
            fault = self._start()
            if fault:
                return Finished(fault, 0.0, None)
        request = json.dumps({"case": str(case.resolve()), "history": str(history.resolve())}) + "\n"
        answer = self._ask(request.encode(), self._limit)
        if isinstance(answer, str):
            return Finished(answer, 0.0, None)
        fault = "" if answer["ok"] else str(answer["message"])
        return Finished(fault, float(answer["cpu_s"]), float(answer["memory_MB"]))

    def _start(self) -> str:
        # the study's own folder comes last: a model may lie beside its study without being installed
        search = os.pathsep.join(part for part in (os.environ.get("PYTHONPATH", ""), str(self._root)) if part)
        self._child = subprocess.Popen(
            [sys.executable, "-P", "-m", "tread_validate.models.python_worker", self._name],
            cwd=self._root,
            env={**os.environ, "PYTHONPATH": search},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            start_new_session=True,
        )
        answer = self._ask(b"", self._limit + START_LIMIT)
        if isinstance(answer, str):
            return answer
        if not answer["ready"]:
            self._stop()
            return str(answer["message"])
        return ""

    def _ask(self, request: bytes, limit: float) -> dict[str, Any] | str:
        """Send a request and return the answer, or why there is none."""
        child = self._child
        assert child is not None
        assert child.stdin is not None
        assert child.stdout is not None
        try:
            child.stdin.write(request)
            child.stdin.flush()
        except BrokenPipeError:
            return self._ended()
        line = _line(child.stdout, limit)
        if line is None:
            self._stop()
            return f"no answer within its time limit of {limit:g} s"
        if not line:
            return self._ended()
        answer: dict[str, Any] = json.loads(line)
        return answer

    def _ended(self) -> str:
        assert self._child is not None
        code = self._child.wait()
        self._stop()
        said = last_line(self._log_path)
        ended = f"its process ended with exit code {code}" if code >= 0 else f"its process died of signal {-code}"
        return one_line(f"{ended}: {said}" if said else ended)

    def _stop(self) -> None:
        child, self._child = self._child, None
        if child is None:
            return
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        for pipe in (child.stdin, child.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()


def _line(stream: Any, limit: float) -> bytes | None:
    """Return one line of a pipe, b"" at its end, None where it does not come in time (s)."""
    end = time.monotonic() + limit
    read = bytearray()
    with selectors.DefaultSelector() as selector:
        selector.register(stream, selectors.EVENT_READ)
        for chunk in _chunks(stream, selector, end):
            if chunk is None:
                return None
            read += chunk
            if not chunk or read.endswith(b"\n"):
                break
    return bytes(read)


def _chunks(stream: Any, selector: selectors.BaseSelector, end: float) -> Iterator[bytes | None]:
    while True:
        left = end - time.monotonic()
        if left <= 0.0 or not selector.select(left):
            yield None
            return
        yield os.read(stream.fileno(), 65536)
