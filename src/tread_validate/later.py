"""What loads when first asked for: names of a package (PEP 562), modules. A command needs little of what is offered."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib import import_module
from types import ModuleType
from typing import Any


def loaded(package: str, places: Mapping[str, str], name: str) -> Any:
    """Return what a package (its ``__name__``) offers under a name.

    `places` gives the module of each name, relative to the package (``".rule"``). Another name raises
    `AttributeError`, as a module does. The package writes ``__getattr__`` and its table out, for there the digests of
    code (`tread_validate.source_code`) read where a name leads.
    """
    if name in places:
        return getattr(import_module(places[name], package), name)
    raise AttributeError(f"module {package!r} has no attribute {name!r}")


class _Later(ModuleType):
    """In the place of a module: loads it when anything of it is asked for."""

    def __getattr__(self, name: str) -> Any:
        return getattr(import_module(self.__name__), name)


@contextmanager
def lazily(*modules: str) -> Iterator[None]:
    """Let what is imported meanwhile import these modules without loading them; each loads when first used.

    For a library that imports at once what it draws with.
    """
    put: dict[str, _Later] = {}
    for module in modules:
        parts = module.split(".")
        for depth in range(1, len(parts) + 1):
            name = ".".join(parts[:depth])
            if name not in sys.modules:
                put[name] = sys.modules[name] = _Later(name)
            if depth > 1 and isinstance(above := sys.modules[".".join(parts[: depth - 1])], _Later):
                setattr(above, parts[depth - 1], sys.modules[name])
    try:
        yield
    finally:
        for name, stood_in in put.items():
            if sys.modules.get(name) is stood_in:
                del sys.modules[name]
