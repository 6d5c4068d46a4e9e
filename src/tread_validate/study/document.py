"""The study file as a whole."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from ..fields import Label, Line, Name, Numerics, Strict
from ..friction import Friction
from ..geometry import AnyPath, Block
from .compound import NamedCompound
from .own_model import OwnModel
from .run import Run
from .settings import DeckSettings, PathMesh, SpringSettings, ToleranceEntry


class Study(Strict):
    """A whole study file."""

    schema_version: Literal[1]
    name: Annotated[Name, Label("names the study")]
    title: Annotated[Line, Label("heads the report")]
    notes: Annotated[tuple[Line, ...], Label("for the reader")] = ()
    compounds: Annotated[dict[Name, NamedCompound], Field(min_length=1)]
    friction_laws: Annotated[dict[Name, Friction], Field(min_length=1)]
    blocks: Annotated[dict[Name, Block], Field(min_length=1)]
    paths: Annotated[dict[Name, AnyPath], Field(min_length=1)]
    runs: Annotated[tuple[Run, ...], Field(min_length=1)]
    models: Annotated[dict[Name, OwnModel], Label("which further models run; each result names its own code")] = Field(
        {}, description="models of your own, by name: Python functions, commands, or histories made elsewhere"
    )
    spring: Annotated[SpringSettings, Numerics("spring")] = SpringSettings()
    deck: Annotated[DeckSettings, Numerics("deck")] = DeckSettings()
    mesh_of_path: Annotated[dict[Name, PathMesh], Numerics("deck")] = Field(
        {}, description="what of the decks' mesh is not as `deck` says, by path"
    )
    tolerances: Annotated[dict[str, ToleranceEntry], Label("what is good enough: judges runs, changes none")] = Field(
        {}, description="errors that are good enough, by quantity or score; the rest keep their defaults"
    )
    engine: Annotated[
        Literal["embedded", "abaqus", "calculix"], Label("which solver makes references; each run names its own")
    ] = "embedded"

    @model_validator(mode="after")
    def _names_exist(self) -> Self:
        known: dict[str, dict[str, Any]] = {
            "compound": self.compounds,
            "friction": self.friction_laws,
            "block": self.blocks,
            "path": self.paths,
        }
        for index, run in enumerate(self.runs):
            for key, table in known.items():
                names = getattr(run, key)
                for name in (names,) if isinstance(names, str) else names:
                    if name not in table:
                        raise ValueError(f"runs[{index}].{key}: got {name}, expected one of {', '.join(sorted(table))}")
        for name in self.mesh_of_path:
            if name not in self.paths:
                raise ValueError(f"mesh_of_path: got {name}, expected one of {', '.join(sorted(self.paths))}")
        return self
