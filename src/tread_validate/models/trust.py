"""Whether what a study names may be executed: only after the user has said so.

A study is data, and reading one executes nothing. A study that names a command or a Python object is run with
``--trust-models`` (``make report TRUST_MODELS=1``), with ``TREAD_VALIDATE_TRUST_MODELS=1`` in the environment, or where
the user's own settings (``~/.config/tread_validate/settings.yaml``) list a folder above it under ``trusted_folders``.
"""

from __future__ import annotations

import os
from pathlib import Path

from pydantic import BaseModel, ConfigDict

from ..errors import InputError
from ..model_file import read_model
from ..study import LoadedStudy
from ..study.own_model import HistoriesModel, OwnModel

VARIABLE = "TREAD_VALIDATE_TRUST_MODELS"


class TrustSettings(BaseModel):
    """The user's own settings on this computer."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    trusted_folders: tuple[Path, ...] = ()


def settings_file() -> Path:
    """Return where the user's settings stand."""
    base = os.environ.get("XDG_CONFIG_HOME") or str(Path.home() / ".config")
    return Path(base) / "tread_validate" / "settings.yaml"


def untrusted(study: LoadedStudy, said: bool = False) -> tuple[str, ...]:
    """Return the names of the study's models that would execute something nobody has agreed to."""
    runs = tuple(name for name, model in study.model.models.items() if executes(model))
    if not runs or said or os.environ.get(VARIABLE) == "1" or _in_trusted_folder(study.source):
        return ()
    return runs


def executes(model: OwnModel) -> bool:
    """Return whether the model is run here; histories made elsewhere are only read."""
    return not isinstance(model, HistoriesModel)


def require_trust(study: LoadedStudy, said: bool = False) -> None:
    """Raise `InputError` where the study names a command or a Python object and the user has not agreed to it."""
    names = untrusted(study, said)
    if names:
        model = study.model.models[names[0]]
        what = getattr(model, "command", None) or getattr(model, "object", None) or getattr(model, "entry_point", None)
        raise InputError(
            f"{study.source}: models.{names[0]}",
            f"{model.kind} {what}, which this study would run on your computer",
            "your word for it after reading it: --trust-models, or TRUST_MODELS=1 with make",
        )


def _in_trusted_folder(source: Path) -> bool:
    file = settings_file()
    if not file.is_file():
        return False
    place = source.resolve()
    folders = read_model(file, TrustSettings).trusted_folders
    return any(place.is_relative_to(folder.expanduser().resolve()) for folder in folders)
