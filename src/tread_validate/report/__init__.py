"""The report: what is said, as one HTML page and as a PDF."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..callable_module import make_callable
from ..later import loaded

if TYPE_CHECKING:
    from .build import build_report

__all__ = [
    "build_report",
]  # fmt: skip

_LATER = {
    "build_report": ".build",
}


def __getattr__(name: str) -> Any:
    return loaded(__name__, _LATER, name)


make_callable(__name__, "tread_validate.api:report")
