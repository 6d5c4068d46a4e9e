"""Names of a package that are loaded when first asked for (PEP 562): a command needs little of what is offered."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
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
