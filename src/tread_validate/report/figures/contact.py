"""Pressure along the contact face in the middle of the pass."""

from __future__ import annotations

from pathlib import Path

from ...study import Case
from ..content import Mark
from .style import Drawn


def pressure(folder: Path, case: Case, label: str, marks: tuple[Mark, ...]) -> Drawn:
    """Draw contact pressure and shear traction along the block."""
    return Drawn(None, f"{label}: not drawn.")
