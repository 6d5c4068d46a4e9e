"""Compiled kernels whose cache on disk knows everything that went into them.

Numba's own cache looks at the file of the kernel alone: a kernel that calls one in another file would go on with the
old machine code after that file has changed. Here the cache is bound to a digest of what Numba compiles: the byte code
of the kernel, of every function it reaches and the values of the globals they use, found from the functions in
memory. So nothing has to be listed by hand, an edit while a process runs cannot be filed under the new source, and an
edit taken back finds its own code again.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import sys
import types
from collections.abc import Callable, Iterator, Set
from functools import cached_property
from pathlib import Path
from typing import Any, TypeVar, cast

import llvmlite  # type: ignore[import-untyped]  # numba and llvmlite have no types
import numba
import numpy as np
from numba.core import config, serialize
from numba.core.types import BaseNamedTuple

from .files import write_bytes

Function = TypeVar("Function", bound=Callable[..., Any])

REORDER = frozenset({"reassoc", "nsz", "contract"})  # sums in any order; infinities and nans keep their meaning
KEPT = 4  # versions of a kernel kept on disk: an edit taken back, another branch
ROOT = __name__.split(".", maxsplit=1)[0]
PLAIN = (bool, int, float, complex, str, bytes, type(None), np.generic)


def kernel(
    reorder: bool = False, fastmath: Set[str] | bool = False, parallel: bool = False, boundscheck: bool | None = None
) -> Callable[[Function], Function]:
    """Compile a function with Numba (NumPy's error model, GIL released), cached on disk.

    Parameters
    ----------
    reorder : bool
        Sums may be taken in any order, so that they use vector units.
    fastmath : set of LLVM flags, or True for all
        More liberties than `reorder`.
    parallel, boundscheck : as of `numba.njit`

    Raises
    ------
    RuntimeError
        This version of Numba does not let its cache be bound to the callees. Going on would run stale code.
    """
    liberties = set(REORDER) if reorder else set(fastmath) if isinstance(fastmath, Set) else fastmath
    options: dict[str, Any] = {"error_model": "numpy", "nogil": True, "fastmath": liberties, "parallel": parallel}
    if boundscheck is not None:
        options["boundscheck"] = boundscheck

    def compiled(function: Function) -> Function:
        dispatcher = numba.njit(cache=True, **options)(function)
        if not getattr(config, "DISABLE_JIT", 0):  # NUMBA_DISABLE_JIT: the plain function, for debuggers
            _bind_cache(dispatcher, options)
        return cast(Function, dispatcher)

    return compiled


def _bind_cache(dispatcher: Any, options: dict[str, Any]) -> None:
    """Put a `KernelCache` in the place of the files of Numba's cache."""
    cache = getattr(dispatcher, "_cache", None)
    plain = getattr(cache, "_cache_file", None)
    if not all(hasattr(plain, name) for name in ("load", "save", "flush")):
        raise RuntimeError(
            f"numba {numba.__version__} keeps its cache in another way: {dispatcher} cannot be bound to its callees"
            " (constraints.txt names a version that can)"
        )
    cast(Any, cache)._cache_file = KernelCache(Path(cast(Any, cache).cache_path), dispatcher, options)


class KernelCache:
    """Machine code of one kernel on disk, one file for each digest and signature."""

    def __init__(self, folder: Path, dispatcher: Any, options: dict[str, Any]) -> None:
        self.folder, self.dispatcher, self.options = folder, dispatcher, options
        function = dispatcher.py_func
        self.base = f"{function.__module__}.{function.__qualname__}-{sys.implementation.cache_tag}"

    @cached_property
    def digest(self) -> str:
        """SHA-256 in hex of all that decides the machine code, but for signature and processor.

        Taken when first asked for: a kernel may call one that stands below it.
        """
        made_by = [numba.__version__, llvmlite.__version__, _value(self.options)]
        return hashlib.sha256("\n".join([*made_by, *_facts(self.dispatcher)]).encode()).hexdigest()

    def load(self, key: object) -> Any:
        """Return what was saved under `key` by a kernel with the same digest, or None."""
        try:
            found, data = pickle.loads(self._path(key).read_bytes())
        except (OSError, EOFError, pickle.UnpicklingError, AttributeError, ImportError):
            return None
        return data if found == key else None

    def save(self, key: object, data: Any) -> None:
        """File `data`, atomically, and drop the files of digests long gone."""
        write_bytes(self._path(key), serialize.dumps((key, data)))  # type: ignore[no-untyped-call]  # numba and llvmlite have no types
        by_age = sorted(self.folder.glob(f"{self.base}.*.nbx"), key=_changed, reverse=True)
        kept = list(dict.fromkeys(path.name.split(".")[-3] for path in by_age))[:KEPT]
        for path in by_age:
            if path.name.split(".")[-3] not in kept:
                path.unlink(missing_ok=True)

    def flush(self) -> None:
        """Forget all versions of the kernel."""
        for path in self.folder.glob(f"{self.base}.*.nbx"):
            path.unlink(missing_ok=True)

    def _path(self, key: object) -> Path:
        signature = hashlib.sha256(f"{key} {_fields(key)}".encode()).hexdigest()
        return self.folder / f"{self.base}.{self.digest[:16]}.{signature[:16]}.nbx"


def _fields(key: object) -> str:
    """Return the fields of all named tuples in a signature, in order: Numba's names of the types leave them out."""
    if isinstance(key, tuple):
        return "".join(map(_fields, key))
    own = repr(getattr(key, "fields", ())) if isinstance(key, BaseNamedTuple) else ""
    return own + _fields(getattr(key, "types", ()))


def _changed(path: Path) -> float:
    try:
        return os.stat(path).st_mtime
    except OSError:  # dropped by another process
        return 0.0


def _facts(kernel_function: Any) -> Iterator[str]:
    """Yield a line for each function that the kernel reaches and each value that they use, in a fixed order."""
    seen: set[int] = set()
    waiting = [kernel_function]
    while waiting:
        item = waiting.pop()
        if id(item) in seen:
            continue
        seen.add(id(item))
        function = _function(item)
        yield f"{function.__module__}.{function.__qualname__} {_value(function.__defaults__)}"
        yield from _code(function.__code__)
        for name, value in _globals(function):
            if _function(value) is not None:
                waiting.append(value)
                yield f"{name}: {value.__module__}.{_function(value).__qualname__}"
            else:
                yield f"{name}: {_value(value)}"
        targets = getattr(item, "targetoptions", None)
        yield f"options {_value(targets)}"


def _function(item: Any) -> Any:
    """Return the Python function of a kernel, an intrinsic or a function of this package; None for anything else."""
    inner = getattr(item, "py_func", None) or getattr(item, "_defn", None) or item
    ours = isinstance(inner, types.FunctionType) and inner.__module__.split(".", maxsplit=1)[0] == ROOT
    return inner if ours or (isinstance(inner, types.FunctionType) and inner is not item) else None


def _globals(function: types.FunctionType) -> Iterator[tuple[str, Any]]:
    """Yield the globals and closure variables that a function uses, modules of this package opened."""
    names = sorted(set(_names(function.__code__)))
    for name in names:
        value = function.__globals__.get(name)
        if isinstance(value, types.ModuleType) and value.__name__.split(".", maxsplit=1)[0] == ROOT:
            yield from ((f"{name}.{part}", getattr(value, part)) for part in names if hasattr(value, part))
        elif name in function.__globals__:
            yield name, value
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        yield name, cell.cell_contents


def _names(code: types.CodeType) -> Iterator[str]:
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _names(constant)


def _code(code: types.CodeType) -> Iterator[str]:
    """Yield what a code object does: no file name, no line numbers."""
    yield code.co_code.hex()
    yield repr((code.co_argcount, code.co_kwonlyargcount, code.co_flags, code.co_names, code.co_varnames))
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            yield from _code(constant)
        else:
            yield _value(constant)


def _value(value: Any) -> str:
    """Return a value that Numba freezes into machine code as text that is equal where the value is."""
    if isinstance(value, PLAIN):
        return f"{type(value).__name__} {value!r}"
    if isinstance(value, tuple | list):
        return f"{type(value).__name__}({', '.join(map(_value, value))})"
    if isinstance(value, Set):
        return f"set({', '.join(sorted(map(_value, value)))})"
    if isinstance(value, dict):
        return f"dict({', '.join(sorted(f'{_value(key)}: {_value(item)}' for key, item in value.items()))})"
    if isinstance(value, np.ndarray):
        return f"array {value.dtype.str} {value.shape} {hashlib.sha256(value.tobytes()).hexdigest()}"
    if isinstance(value, type) and issubclass(value, tuple):
        return f"{value.__module__}.{value.__qualname__} {getattr(value, '_fields', ())!r}"
    home = value.__name__ if isinstance(value, types.ModuleType) else getattr(value, "__module__", None) or ""
    if home.split(".", maxsplit=1)[0] == ROOT:
        raise RuntimeError(f"a compiled kernel uses {value!r}: its cache cannot be bound to that")
    return f"{home}.{getattr(value, '__qualname__', type(value).__qualname__)}"
