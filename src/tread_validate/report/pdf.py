"""The report as a PDF."""

from __future__ import annotations

from pathlib import Path

from .content import Report


def write_pdf(report: Report, path: Path) -> None:
    """Write the PDF."""
