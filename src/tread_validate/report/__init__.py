"""The report: what is said, as one HTML page and as a PDF."""

from .build import build_report

__all__ = ["build_report"]
