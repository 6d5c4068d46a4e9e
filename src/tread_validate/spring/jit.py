"""Compiled kernels whose cache on disk knows all the sources that went into them.

Numba's cache looks at the file of the kernel alone. A kernel that calls one in another file would go on with the old
code after that file has changed, so the stamp here is the digest of every file with kernels in it.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TypeVar, cast

import numba

from ..friction import kernel as friction_kernel

Function = TypeVar("Function", bound=Callable[..., object])

KERNEL_FILES = (
    "inputs.py", "memory.py", "kinematics.py", "slip.py", "element.py", "assembly.py", "jit.py",
    "coupled/contact.py", "coupled/march.py",
)  # fmt: skip


@cache
def sources_digest() -> str:
    """Return the SHA-256 of the sources of all kernels, in hex."""
    here = Path(__file__).resolve().parent
    digest = hashlib.sha256()
    for path in (*(here / name for name in KERNEL_FILES), Path(friction_kernel.__file__)):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def kernel(reorder: bool = False) -> Callable[[Function], Function]:
    """Compile a function with Numba, cached on disk.

    `reorder` lets sums be taken in any order (so that they use vector units); infinities and nans keep their meaning.
    """

    def compiled(function: Function) -> Function:
        fast = {"reassoc", "nsz", "contract"} if reorder else False
        dispatcher = numba.njit(cache=True, error_model="numpy", fastmath=fast)(function)
        stamped = getattr(getattr(dispatcher, "_cache", None), "_cache_file", None)
        if stamped is not None and hasattr(stamped, "_source_stamp"):
            stamped._source_stamp = sources_digest()
        return cast(Function, dispatcher)

    return compiled
