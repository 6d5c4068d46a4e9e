"""One run of a study, in SI, with everything that decides its result."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

from ..fields import Label, Numerics, Sourced
from ..friction import Friction
from ..geometry import Block, PathEntry
from ..model_file import as_model
from ..units import MM, PERCENT
from .compound import Compound
from .digest import digest_of
from .settings import DeckSettings, SpringSettings


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

    case_id: Annotated[str, Label("names the case")]
    study_name: Annotated[str, Label("names the study")]
    study_digest: Annotated[str, Label("of the study's text, comments and all")]
    run: Annotated[str, Label("names the run")]
    compound_name: Annotated[str, Label("the compound itself counts")]
    friction_name: Annotated[str, Label("the law itself counts")]
    block_name: Annotated[str, Label("the block itself counts")]
    path_name: Annotated[str, Label("the path itself counts")]
    compound: Compound
    friction: Friction
    block: Block
    path: PathEntry
    temperature: float
    interference: float
    speed: float
    creep_ratio: float | None
    free_rolling: Annotated[bool, Label("how the creep ratio was found; the ratio itself counts")]
    spring: Annotated[SpringSettings, Numerics("spring")]
    deck: Annotated[DeckSettings, Numerics("deck")]
    root: Annotated[Path, Label("where the data files lie; their contents count")]
    speed_rpm: Annotated[float | None, Label("the speed in other words")] = None

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
        """Name the assumed and synthetic inputs that this case depends on."""
        inputs: tuple[tuple[str, Sourced], ...] = (
            (f"compound {self.compound_name}", self.compound),
            (f"friction law {self.friction_name}", self.friction),
            (f"block {self.block_name}", self.block),
            (f"path {self.path_name}", self.path),
        )
        return tuple(f"{name} ({item.origin})" for name, item in inputs if item.origin in ("assumed", "synthetic"))

    def input_files(self) -> tuple[Path, ...]:
        """Return the data files that this case reads."""
        named = [getattr(item, "file", None) for item in (self.compound, self.friction, self.path)] + [self.block.mesh]
        return tuple(self.root / name for name in named if name is not None)

    def problem_digest(self) -> str:
        """Return the SHA-256 of the physical problem, in hex: all but labels and the solvers' settings."""
        return digest_of(self, self.root)

    def digest(self, *solvers: str) -> str:
        """Return the SHA-256 of the problem and of the settings of `solvers`, in hex.

        ``spring`` and ``deck`` are the settings there are; without a name both count. Labels never do: they are
        declared where the fields are, so that a new field counts until somebody says otherwise.
        """
        return digest_of(self, self.root, solvers or ("spring", "deck"))

    def conditions(self) -> dict[str, str | float | bool | None]:
        """Return the conditions as one table row, with units in the keys."""
        return {
            "case_id": self.case_id,
            "run": self.run,
            "path": self.path_name,
            "block": self.block_name,
            "compound": self.compound_name,
            "friction": self.friction_name,
            "poissons_ratio": self.compound.poissons_ratio,
            "temperature_degC": self.temperature,
            "interference_mm": round(self.interference / MM, 9),
            "speed_m_s": round(self.speed, 6),
            "speed_rpm": self.speed_rpm,
            "creep_percent": None if self.creep_ratio is None else round(self.creep_ratio / PERCENT, 9),
            "free_rolling": self.free_rolling,
            "measured_profile": self.path.is_measured,
            "assumed": "; ".join(self.assumed()),
        }


def with_mesh(case: Case, settings: Mapping[str, object]) -> Case:
    """Return the case with some deck settings changed (``element_size_mm``, ``layers``); they are validated anew."""
    if not settings:
        return case
    return replace(case, deck=as_model({**case.deck.model_dump(), **settings}, DeckSettings, "deck"))


def conditions_digest(cases: Iterable[Case]) -> str:
    """Return one SHA-256 for the conditions of all cases, in hex: labels do not change it."""
    return hashlib.sha256("\n".join(f"{case.case_id} {case.digest()}" for case in cases).encode()).hexdigest()


def problems_digest(cases: Iterable[Case]) -> str:
    """Return one SHA-256 for the physical problems of all cases, in hex: no solver's settings change it."""
    return hashlib.sha256("\n".join(f"{case.case_id} {case.problem_digest()}" for case in cases).encode()).hexdigest()
