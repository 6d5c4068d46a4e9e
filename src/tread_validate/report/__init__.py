"""The report: what is said, as one HTML page and as a PDF."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ..callable_module import make_callable

if TYPE_CHECKING:
    from .build import build_report

__all__ = [
    "build_report",
]  # fmt: skip

_LATER = {
    "build_report": ".build",
}


def __getattr__(name: str) -> Any:
    """Load what is offered when it is first asked for: a command needs little of it."""
    if name in _LATER:
        return getattr(import_module(_LATER[name], __name__), name)
    raise AttributeError(f"module {__name__} has no attribute {name}")


make_callable(__name__, "tread_validate.api:report")
