"""One run at a time in a folder; a killed run leaves nothing in the way of the next."""

from __future__ import annotations

import signal
import subprocess
import time
from pathlib import Path

import pytest


@pytest.fixture
def call(root: Path, tmp_path: Path):
    """Start the lock with a program that stands in for Snakemake and stays as long as the file `stay` is there."""
    program = tmp_path / "snakemake"
    program.write_text('#!/bin/sh\necho "$@" >> calls\nif [ -e stay ]; then exec sleep 60; fi\n')
    program.chmod(0o755)
    command = ["sh", str(root / "workflow" / "setup" / "locked.sh"), str(program), "report"]

    def start() -> subprocess.Popen[str]:
        return subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True)

    return start


def _begun(folder: Path, times: int) -> None:
    for _ in range(200):
        if (folder / "calls").exists() and (folder / "calls").read_text().count("\n") >= times:
            return
        time.sleep(0.05)
    raise AssertionError("the run did not begin")


def test_second_run_in_one_folder_is_refused_in_one_line(call, tmp_path):
    (tmp_path / "stay").touch()
    first = call()
    _begun(tmp_path, 1)
    second = call()
    _, line = second.communicate(timeout=30)
    assert second.returncode == 2
    assert line.startswith("another run is at work in ")
    assert line.count("\n") == 1
    assert first.poll() is None
    first.kill()
    first.wait(timeout=30)
    assert first.stderr.read() == ""
    first.stderr.close()


def test_killed_run_frees_the_folder_at_once(call, tmp_path):
    (tmp_path / "stay").touch()
    first = call()
    _begun(tmp_path, 1)
    first.send_signal(signal.SIGKILL)
    first.wait(timeout=30)
    first.stderr.close()
    (tmp_path / "stay").unlink()
    second = call()
    _, line = second.communicate(timeout=30)
    assert (second.returncode, line) == (0, "")
    assert (tmp_path / "calls").read_text() == "--nolock report\n" * 2
