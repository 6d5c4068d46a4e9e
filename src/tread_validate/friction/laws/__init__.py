"""The friction laws: one module each. A module here with a `FrictionEntry` in it is a law that studies can name."""

from __future__ import annotations

import pkgutil
from functools import reduce
from importlib import import_module
from operator import or_
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from ..law import FrictionEntry, LawForm

_MODULES = tuple(import_module(f"{__name__}.{item.name}") for item in pkgutil.iter_modules(__path__))

ENTRIES: tuple[type[FrictionEntry], ...] = tuple(
    value
    for module in _MODULES
    for value in vars(module).values()
    if isinstance(value, type) and issubclass(value, FrictionEntry) and value.__module__ == module.__name__
)
"""Every kind of law that a study can name."""

FORMS: dict[str, LawForm] = {
    value.name: value for module in _MODULES for value in vars(module).values() if isinstance(value, LawForm)
}
"""Every form, by its name."""

if TYPE_CHECKING:
    Friction = FrictionEntry
else:
    Friction = Annotated[reduce(or_, ENTRIES), Field(discriminator="kind")]
