"""Who made a number, from what: digests, versions, commit."""

from __future__ import annotations

import hashlib
import os
import subprocess
from functools import cache
from pathlib import Path

from . import __version__


def sha256_text(text: str) -> str:
    """Return the SHA-256 of `text` in UTF-8, in hex."""
    return hashlib.sha256(text.encode("utf-8")).hexdigest()


def sha256_file(path: Path | str) -> str:
    """Return the SHA-256 of a file, in hex."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


@cache
def commit() -> str:
    """Return the commit of the code in use, with ``+changes`` for a dirty tree, or ``unknown`` outside git."""
    here = Path(__file__).resolve().parent
    environment = {**os.environ, "GIT_OPTIONAL_LOCKS": "0"}
    try:
        top = _git(here, environment, "rev-parse", "--show-toplevel")
        head = _git(here, environment, "rev-parse", "HEAD")
        changes = _git(Path(top), environment, "status", "--porcelain", "--untracked-files=no", "--", "src")
    except (OSError, subprocess.SubprocessError):
        return "unknown"
    return head[:12] + ("+changes" if changes else "")


@cache
def commit_date() -> str:
    """Return the day (ISO) of the commit of the code in use, which no run changes; empty outside git."""
    here = Path(__file__).resolve().parent
    try:
        return _git(here, {**os.environ, "GIT_OPTIONAL_LOCKS": "0"}, "log", "-1", "--format=%cs")
    except (OSError, subprocess.SubprocessError):
        return ""


def version() -> str:
    """Return the package version."""
    return __version__


def _git(folder: Path, environment: dict[str, str], *arguments: str) -> str:
    done = subprocess.run(
        ["git", "-C", str(folder), *arguments],
        check=True,
        capture_output=True,
        text=True,
        timeout=20,
        env=environment,
    )
    return done.stdout.strip()
