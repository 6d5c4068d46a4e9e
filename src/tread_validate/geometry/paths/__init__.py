"""The kinds of path: one module each. A module here with a `PathEntry` in it is a path that studies can name."""

from __future__ import annotations

import pkgutil
from functools import reduce
from importlib import import_module
from operator import or_
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from ..path_entry import PathEntry

ENTRIES: tuple[type[PathEntry], ...] = tuple(
    value
    for module in (import_module(f"{__name__}.{item.name}") for item in pkgutil.iter_modules(__path__))
    for value in vars(module).values()
    if isinstance(value, type) and issubclass(value, PathEntry) and value.__module__ == module.__name__
)
"""Every kind of path that a study can name."""

if TYPE_CHECKING:
    AnyPath = PathEntry
else:
    AnyPath = Annotated[reduce(or_, ENTRIES), Field(discriminator="kind")]
