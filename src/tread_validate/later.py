"""Names of a package that are loaded when first asked for (PEP 562): a command needs little of what is offered."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def loader(package: str, places: Mapping[str, str]) -> Callable[[str], Any]:
    """Return the ``__getattr__`` of a package (its ``__name__``) whose names are defined in the modules `places`.

    A module is given relative to the package (``".rule"``). Another name raises `AttributeError`, as a module does.
    """

    def load(name: str) -> Any:
        if name in places:
            return getattr(import_module(places[name], package), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return load
