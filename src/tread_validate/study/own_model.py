"""Models of the user's own that a study names: a Python function, a command, or a folder of histories.

Reading a study executes nothing of what stands here; `tread_validate.models` runs it, and only once it is trusted.
"""

from __future__ import annotations

import shlex
import string
from typing import Annotated, Literal, Self

from pydantic import Field, FiniteFloat, StringConstraints, model_validator

from ..fields import FileName, Line, Strict

ObjectName = Annotated[str, StringConstraints(pattern=r"^[A-Za-z_][\w.]*:[A-Za-z_][\w.]*$", max_length=200)]
EntryPoint = Annotated[str, StringConstraints(pattern=r"^[A-Za-z0-9_.-]{1,80}$")]
FolderName = Annotated[str, StringConstraints(min_length=1, max_length=200, pattern=r"^[^\x00-\x1f\x7f]+$")]
Seconds = Annotated[FiniteFloat, Field(gt=0, le=86400)]
Digest = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]
Variable = Annotated[str, StringConstraints(pattern=r"^[A-Za-z_][A-Za-z0-9_]*$")]

ONE_CASE, ALL_CASES = frozenset({"case", "history"}), frozenset({"cases", "folder"})
"""Placeholders of a command that runs one case, and of one that runs all of them."""


class OwnModelBase(Strict):
    """What every model of the user's own says about itself."""

    description: Line = Field(description="what the model is, in one line")
    origin: Line = Field(description="whose model it is: author or group, version, publication")
    files: tuple[FileName, ...] = Field((), description="files the model consists of; a change in them runs it again")


class PythonModel(OwnModelBase):
    """A function from a case to a history, in an installed package."""

    kind: Literal["python"]
    object: ObjectName | None = Field(None, description="package.module:function")
    entry_point: EntryPoint | None = Field(
        None, description="in place of `object`: a name in the entry-point group tread_validate.models"
    )
    time_limit_s: Seconds = Field(60.0, description="for one case")

    @model_validator(mode="after")
    def _one_way_in(self) -> Self:
        if (self.object is None) == (self.entry_point is None):
            raise ValueError("give either object or entry_point")
        return self


class CommandModel(OwnModelBase):
    """Any executable: ``{case}`` and ``{history}`` for one case, ``{cases}`` and ``{folder}`` for all in one run."""

    kind: Literal["command"]
    command: Line = Field(description="program and arguments; run without a shell")
    time_limit_s: Seconds = Field(60.0, description="for one case; a run of all cases has it times their number")
    working_folder: FolderName = Field(".", description="relative to the study's folder")
    environment: dict[Variable, str] = Field({}, description="variables added to the environment")

    @model_validator(mode="after")
    def _placeholders(self) -> Self:
        try:
            parts = shlex.split(self.command)
        except ValueError as error:
            raise ValueError(f"command cannot be split into arguments: {error}") from None
        try:
            named = {field for part in parts for _, field, _, _ in string.Formatter().parse(part) if field is not None}
        except ValueError as error:
            raise ValueError(f"command: {error}") from None
        if named not in (ONE_CASE, ALL_CASES):
            raise ValueError(
                "command must name {case} and {history} (one run a case) or {cases} and {folder} (one run for all), "
                f"got {', '.join(sorted(named)) or 'neither'}"
            )
        if any(field in parts[0] for field in ("{", "}")):
            raise ValueError("command: the program itself must be written out")
        return self

    @property
    def arguments(self) -> tuple[str, ...]:
        """The command's parts, placeholders unfilled."""
        return tuple(shlex.split(self.command))

    @property
    def runs_all(self) -> bool:
        """Whether one run computes all cases."""
        return "{cases}" in self.command


class HistoriesModel(OwnModelBase):
    """Histories made elsewhere: ``ID.csv`` for each case in a folder."""

    kind: Literal["histories"]
    folder: FolderName = Field(description="relative to the study's folder")
    made_for: Digest | None = Field(
        None,
        description="digest of the study's problems, as `tread-validate case --all` prints it, that histories without "
        "a case_digest of their own were made for",
    )
    statement: Line | None = Field(None, description="with made_for: who says so, and why it is so")

    @model_validator(mode="after")
    def _bound(self) -> Self:
        if (self.made_for is None) != (self.statement is None):
            raise ValueError("made_for and statement belong together")
        return self


OwnModel = Annotated[PythonModel | CommandModel | HistoriesModel, Field(discriminator="kind")]
