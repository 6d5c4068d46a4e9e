"""The report: what is said, as one HTML page and as a PDF."""

from ..callable_module import make_callable
from .build import build_report

__all__ = ["build_report"]

make_callable(__name__, "tread_validate.api:report")
