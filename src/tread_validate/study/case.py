"""One run of a study, in SI, with everything that decides its result."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from pydantic import ValidationError

from ..errors import InputError
from ..units import MM, PERCENT
from .models import Block, Compound, DeckSettings, Friction, MeasuredBelt, Rig, Sourced, SpringSettings, Wheel


@dataclass(frozen=True)
class Case:
    """One block pass: who rolls where, how fast, how deep and how warm.

    Attributes
    ----------
    case_id : str
        Readable and safe as a file and job name: ``[a-z0-9-]``, at most 64 characters.
    run, compound_name, friction_name, block_name, path_name : str
        Names in the study.
    temperature : float, degC
    interference : float, m
        Largest compression of the block.
    speed : float, m/s
        Speed of the tread surface (rig) or of the belt along its arc (tyre), > 0.
    creep_ratio : float or None
        Road speed over block speed less 1; None as long as a free-rolling case has not been resolved.
    free_rolling : bool
        Whether the creep ratio is the one without net tangential impulse.
    root : Path
        Folder that relative file names in the study refer to.
    """

    case_id: str
    study_name: str
    study_digest: str
    run: str
    compound_name: str
    friction_name: str
    block_name: str
    path_name: str
    compound: Compound
    friction: Friction
    block: Block
    path: Wheel
    temperature: float
    interference: float
    speed: float
    creep_ratio: float | None
    free_rolling: bool
    spring: SpringSettings
    deck: DeckSettings
    root: Path
    speed_rpm: float | None = None

    @property
    def is_rig(self) -> bool:
        """Whether the block rolls on the two-wheel rig."""
        return isinstance(self.path, Rig)

    @property
    def length(self) -> float:
        """Block length in the rolling direction, m."""
        return self.block.length_mm * MM

    @property
    def width(self) -> float:
        """Block width along the axle, m."""
        return self.block.width_mm * MM

    @property
    def height(self) -> float:
        """Block height, m."""
        return self.block.height_mm * MM

    def with_creep(self, creep_ratio: float) -> Case:
        """Return the case at a given creep ratio."""
        return replace(self, creep_ratio=creep_ratio)

    def assumed(self) -> tuple[str, ...]:
        """Name the assumed and synthetic inputs that this case rests on."""
        inputs: tuple[tuple[str, Sourced], ...] = (
            (f"compound {self.compound_name}", self.compound),
            (f"friction law {self.friction_name}", self.friction),
            (f"block {self.block_name}", self.block),
            (f"path {self.path_name}", self.path),
        )
        return tuple(f"{name} ({item.origin})" for name, item in inputs if item.origin in ("assumed", "synthetic"))

    def input_files(self) -> tuple[Path, ...]:
        """Return the data files that this case reads."""
        named = [getattr(item, "file", None) for item in (self.compound, self.friction, self.path)]
        return tuple(self.root / name for name in named if name is not None)

    def digest(self) -> str:
        """Return the SHA-256 of all that decides the result (not of labels and notes), in hex."""
        decides = {
            "compound": self.compound.model_dump(mode="json", exclude={"origin", "source"}),
            "friction": self.friction.model_dump(mode="json", exclude={"origin", "source"}),
            "block": self.block.model_dump(mode="json", exclude={"origin", "source"}),
            "path": self.path.model_dump(mode="json", exclude={"origin", "source"}),
            "temperature": self.temperature,
            "interference": self.interference,
            "speed": self.speed,
            "creep_ratio": self.creep_ratio,
            "spring": self.spring.model_dump(mode="json", exclude={"variants"}),
            "files": [hashlib.sha256(path.read_bytes()).hexdigest() for path in self.input_files() if path.is_file()],
        }
        return hashlib.sha256(json.dumps(decides, sort_keys=True).encode()).hexdigest()

    def conditions(self) -> dict[str, str | float | bool | None]:
        """Return the conditions as one table row, with units in the keys."""
        return {
            "case_id": self.case_id,
            "run": self.run,
            "path": self.path_name,
            "block": self.block_name,
            "compound": self.compound_name,
            "friction": self.friction_name,
            "temperature_degC": self.temperature,
            "interference_mm": round(self.interference / MM, 9),
            "speed_m_s": round(self.speed, 6),
            "speed_rpm": self.speed_rpm,
            "creep_percent": None if self.creep_ratio is None else round(self.creep_ratio / PERCENT, 9),
            "free_rolling": self.free_rolling,
            "measured_profile": isinstance(self.path, MeasuredBelt),
            "assumed": "; ".join(self.assumed()),
        }


def with_mesh(case: Case, settings: Mapping[str, object]) -> Case:
    """Return the case with some deck settings changed (``element_size_mm``, ``layers``); they are validated anew."""
    if not settings:
        return case
    try:
        deck = DeckSettings.model_validate({**case.deck.model_dump(), **settings})
    except ValidationError as error:
        fault = error.errors(include_url=False)[0]
        raise InputError(
            f"deck.{fault['loc'][0]}", fault["input"], fault["msg"].removeprefix("Input should be ")
        ) from None
    return replace(case, deck=deck)


def conditions_digest(cases: Iterable[Case]) -> str:
    """Return one SHA-256 for the conditions of all cases, in hex: labels, notes and variants do not change it."""
    return hashlib.sha256("\n".join(f"{case.case_id} {case.digest()}" for case in cases).encode()).hexdigest()
