"""Sub-packages that the front door calls: ``tv.compare`` is the package and the function, ``tv.report`` likewise.

Python sets a loaded sub-package as an attribute of its parent, in front of anything else of that name.
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any


def make_callable(module: str, function: str) -> None:
    """Let a call of `module` (its ``__name__``) be one of ``package.module:function``, loaded on the first call."""
    owner, _, name = function.partition(":")

    class Callable(ModuleType):
        def __call__(self, *arguments: Any, **keywords: Any) -> Any:
            return getattr(importlib.import_module(owner), name)(*arguments, **keywords)

    sys.modules[module].__class__ = Callable
