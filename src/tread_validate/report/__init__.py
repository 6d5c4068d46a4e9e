"""The report: what is said, as one HTML page and as a PDF."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..callable_module import make_callable
from ..later import loader

if TYPE_CHECKING:
    from .build import build_report

__all__ = [
    "build_report",
]  # fmt: skip

__getattr__ = loader(
    __name__,
    {
        "build_report": ".build",
    },
)


make_callable(__name__, "tread_validate.api:report")
