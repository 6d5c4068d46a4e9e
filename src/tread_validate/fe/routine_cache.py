"""Compiled friction routines kept from one process to the next: gfortran takes a tenth of a pass.

A library is filed under a digest of the source, the compiler and its options. Only sources that include no files of
their own are kept, as nothing tells when such a file has changed. Only speed depends on what is kept.
"""

from __future__ import annotations

import hashlib
import os
import re
import shutil
from collections.abc import Sequence
from pathlib import Path

from ..cache_folder import cache_folder
from ..errors import InputError
from ..files import write_bytes

MOST_KEPT = 50
"""Libraries; those used longest ago go first."""
INCLUDE = re.compile(r"^\s*(?:#\s*)?include\b\s*['\"<]([^'\">]*)", re.IGNORECASE | re.MULTILINE)
OWN_INCLUDE = "vaba_param.inc"


def kept_library(source: str, compiler: str, options: Sequence[str]) -> Path | None:
    """Return where the library of a source is or would be kept; None where it is not to be.

    Parameters
    ----------
    source : str
        The Fortran text.
    compiler : str
        Path of the compiler; another one, or another version of it, is told by size and time of its file.
    options : sequence of str
        Of the compile, and whatever else decides what comes out.
    """
    folder = cache_folder()
    if folder is None or any(name.lower() != OWN_INCLUDE for name in INCLUDE.findall(source)):
        return None
    try:
        real = Path(compiler).resolve()
        state = real.stat()
    except OSError:
        return None
    facts = "\n".join([source, str(real), str(state.st_size), str(state.st_mtime_ns), *options])
    return folder / "routines" / f"{hashlib.sha256(facts.encode()).hexdigest()[:32]}.so"


def fetch(kept: Path | None, library: Path) -> bool:
    """Copy a kept library to `library`; tell whether there was one."""
    if kept is None:
        return False
    try:
        shutil.copyfile(kept, library)
        os.utime(kept)
    except OSError:
        return False
    return True


def keep(kept: Path | None, library: Path) -> None:
    """File a library that has been compiled; where nothing can be written, nothing is kept."""
    if kept is None:
        return
    try:
        write_bytes(kept, library.read_bytes())
        by_age = sorted(kept.parent.glob("*.so"), key=lambda path: path.stat().st_mtime, reverse=True)
        for path in by_age[MOST_KEPT:]:
            path.unlink(missing_ok=True)
    except (OSError, InputError):
        return
