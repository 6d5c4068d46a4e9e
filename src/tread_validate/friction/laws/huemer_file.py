"""Huemer's law from a friction file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Literal

from ...fields import FileName
from ..law import FrictionEntry, FrictionLaw
from ..law_file import read_friction


class HuemerFile(FrictionEntry):
    """A friction file, as ``tread-validate fit-friction`` writes it."""

    example: ClassVar[Mapping[str, Any]] = {"file": "friction.yaml"}

    kind: Literal["huemer_file"]
    file: FileName

    def law(self, root: Path) -> FrictionLaw:
        """Return the law of the file with the study's static coefficient."""
        path = root / self.file
        return read_friction(path).with_static(self.static_coefficient, str(path))
