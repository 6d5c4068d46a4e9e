"""Huemer's law from a friction file."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from ...fields import FileName
from ..law import FrictionEntry, FrictionLaw
from ..law_file import read_friction


class HuemerFile(FrictionEntry):
    """A friction file, as ``tread-validate fit-friction`` writes it."""

    kind: Literal["huemer_file"]
    file: FileName

    def law(self, root: Path) -> FrictionLaw:
        """Return the law of the file with the study's static coefficient."""
        path = root / self.file
        return read_friction(path).with_static(self.static_coefficient, str(path))
