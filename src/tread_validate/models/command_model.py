"""A model that is an executable: one run a case, or one run for all."""

from __future__ import annotations

import shutil
from collections.abc import Mapping
from pathlib import Path

from ..errors import InputError
from ..study.own_model import CommandModel
from .process import Finished, run_process


def run_command(model: CommandModel, root: Path, fill: Mapping[str, Path], log: Path, runs: int = 1) -> Finished:
    """Run the command with its placeholders filled.

    Parameters
    ----------
    root : Path
        The study's folder.
    fill : mapping
        Placeholder to path: ``case`` and ``history``, or ``cases`` and ``folder``.
    runs : int
        Cases that this run computes; the time limit is for one.

    Raises
    ------
    InputError
        Where the working folder or the program does not exist, before anything runs.
    """
    folder = working_folder(model, root)
    program = find_program(model, root)
    paths = {name: str(path.resolve()) for name, path in fill.items()}
    arguments = [str(program), *(_filled(part, paths) for part in model.arguments[1:])]
    return run_process(arguments, folder, model.environment, model.time_limit_s * runs, log)


def working_folder(model: CommandModel, root: Path) -> Path:
    """Return the folder that the command runs in; raises `InputError` where there is none."""
    folder = root / model.working_folder
    if not folder.is_dir():
        raise InputError("models: working_folder", model.working_folder, f"an existing folder below {root.name}/")
    return folder


def find_program(model: CommandModel, root: Path) -> Path:
    """Return the program: a path relative to the working folder where it has a slash, else found on PATH."""
    name = model.arguments[0]
    if "/" in name:
        program = (working_folder(model, root) / name).resolve()
        found = str(program) if program.is_file() else None
    else:
        found = shutil.which(name)
    if found is None:
        raise InputError("models: command", name, "a program that exists here (is it built and installed?)")
    return Path(found)


def _filled(part: str, paths: Mapping[str, str]) -> str:
    for name, path in paths.items():
        part = part.replace("{" + name + "}", path)
    return part
