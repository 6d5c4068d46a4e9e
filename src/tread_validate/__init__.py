"""How far can a tread-block model be trusted?

Decks, spring models, an explicit finite element engine and the comparison between them, for the tread block of
a free-rolling tyre (Liu, Sutcliffe and Graham, Wear 269 (2010) 672-683, doi:10.1016/j.wear.2010.07.006).

>>> import tread_validate as tv
>>> study = tv.load_study("config/study.yaml")
>>> case = study.case("rig-rectangle-22c-0p2mm-300rpm")
>>> tv.run(case, model="paper")
<History spring/paper rig-rectangle-22c-0p2mm-300rpm: 722 samples to 11.48 ms, peak N 92.82 N, T -0.7512 to 0.1594 N>
"""

from __future__ import annotations

import importlib
from typing import Any

__version__ = "0.2.0"

# the front door: each name loads its part of the package when it is first used, so that `import` itself is quick
_DOOR = {
    "History": "history",
    "TreadBlock": "spring.stepping",
    "compare": "api",
    "load_study": "api",
    "report": "api",
    "run": "api",
    "run_fe": "api",
    "write_deck": "api",
}
__all__ = ["__version__", *sorted(_DOOR)]  # noqa: PLE0604  # the door's own names, each resolved by __getattr__


def __getattr__(name: str) -> Any:
    if name not in _DOOR:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f"{__name__}.{_DOOR[name]}"), name)


def __dir__() -> list[str]:
    return __all__
