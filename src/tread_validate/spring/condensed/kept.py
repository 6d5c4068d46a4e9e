"""Arrays kept on disk from one process to the next, under a digest of what they were made from and of the code.

They lie below ``$TREAD_VALIDATE_CACHE`` (``off``: nothing is kept), else ``$XDG_CACHE_HOME/tread-validate``, else
``~/.cache/tread-validate``. A file that cannot be read, or whose checksum is wrong, is made anew; where nothing can be
written, nothing is kept. Only speed depends on these files.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray

from ...cache_folder import cache_folder as folder
from ...errors import InputError
from ...files import write_bytes

MOST_BYTES = 500_000_000
"""The files used longest ago go when the folder grows beyond this."""
PAGE, ALIGNED = 4096, 64
"""Bytes of a file's head, and what its arrays are aligned to."""
SOURCES = (
    "body.py", "condense.py", "element.py", "finite_strain.py", "inputs.py", "mesh_body.py", "mesh_condense.py",
    "operators.py", "polygon.py", "store.py", "stuck.py", "symmetry.py", "../stiffness.py",
    "../../geometry/mesh_file.py", "../../units.py",
)  # fmt: skip
"""What decides the arrays, beside NumPy and SciPy; a test holds the list to the import graph."""

Arrays = Mapping[str, NDArray[Any]]


@cache
def code() -> str:
    """Return a digest of the code that makes the arrays."""
    here = Path(__file__).resolve().parent
    digest = hashlib.sha256(f"{np.__version__} {scipy.__version__}".encode())
    for name in SOURCES:
        digest.update((here / name).read_bytes())
    return digest.hexdigest()


def kept(name: str, key: str, make: Callable[[], Arrays]) -> Arrays:
    """Return the arrays of `name` and `key`, made if they are not there."""
    found = load(name, key)
    if found is None:
        found = make()
        keep(name, key, found)
    return found


def load(name: str, key: str) -> Arrays | None:
    """Return what is kept, mapped into memory, or None."""
    path = _path(name, key)
    if path is None:
        return None
    try:
        whole = np.memmap(path, dtype=np.uint8, mode="c")  # pages that are written to are this process's own
        head = json.loads(bytes(whole[:PAGE]).rstrip(b"\0"))
        body = whole[PAGE:]
        if body.size != head["bytes"] or _checksum(body) != head["checksum"]:
            return None
        arrays = {}
        for each, (kind, shape, begin, end) in head["arrays"].items():
            arrays[each] = np.asarray(body[begin:end]).view(kind).reshape(shape)
        os.utime(path)
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return arrays


def keep(name: str, key: str, arrays: Arrays) -> None:
    """Write arrays for the next process."""
    path = _path(name, key)
    if path is None:
        return
    places, end = {}, 0
    for each, array in arrays.items():
        places[each] = (array.dtype.str, array.shape, end, end + array.nbytes)
        end += array.nbytes + (-array.nbytes) % ALIGNED
    whole = np.zeros(PAGE + end, dtype=np.uint8)
    for each, (_, _, begin, last) in places.items():
        whole[PAGE + begin : PAGE + last] = np.ascontiguousarray(arrays[each]).reshape(-1).view(np.uint8)
    text = json.dumps({"arrays": places, "bytes": end, "checksum": _checksum(whole[PAGE:])}).encode()
    assert len(text) <= PAGE
    whole[: len(text)] = np.frombuffer(text, dtype=np.uint8)
    try:
        write_bytes(path, whole.data)
        _prune(path.parent)
    except (OSError, InputError):
        return


def _checksum(body: NDArray[np.uint8]) -> str:
    words = body.view(np.uint64)
    return f"{int(np.add.reduce(words)):x} {int(np.bitwise_xor.reduce(words)):x}"


def _path(name: str, key: str) -> Path | None:
    where = folder()
    if where is None:
        return None
    return where / f"{name}-{hashlib.sha256(f'{code()} {key}'.encode()).hexdigest()[:32]}.arrays"


def _prune(where: Path) -> None:
    files = sorted((path.stat().st_mtime, path.stat().st_size, path) for path in where.glob("*.arrays"))
    total = sum(size for _, size, _ in files)
    for _, size, path in files:
        if total <= MOST_BYTES:
            return
        path.unlink(missing_ok=True)
        total -= size
