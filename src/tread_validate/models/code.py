"""The code of a model of the user's own, as a digest: what changes it must run the model again."""

from __future__ import annotations

import hashlib
import importlib.metadata
import importlib.util
from collections.abc import Iterator
from pathlib import Path

from ..errors import InputError
from ..study import LoadedStudy
from ..study.own_model import CommandModel, HistoriesModel, OwnModel, PythonModel
from .command_model import find_program, working_folder
from .python_worker import GROUP


def code_of(study: LoadedStudy, name: str) -> str:
    """Return the SHA-256 of a model's statement in the study and of all files that it consists of, in hex.

    Of a command: the program where it lies below the study's folder, and arguments that are files; of a Python object:
    the source files of its top-level module or package; of histories: the files themselves; and always what stands
    under ``files``. A program from the system counts by its name.
    """
    model = study.model.models[name]
    digest = hashlib.sha256(model.model_dump_json(exclude={"description", "origin"}).encode())
    for file in sorted({path.resolve() for path in source_files(model, study.root)}):
        digest.update(f"\n{_shown(file, study.root)} {hashlib.sha256(file.read_bytes()).hexdigest()}".encode())
    return digest.hexdigest()


def source_files(model: OwnModel, root: Path) -> tuple[Path, ...]:
    """Return the files that decide what a model computes, as far as they can be known without running it."""
    listed = []
    for name in model.files:
        path = root / name
        if not path.is_file():
            raise InputError("models: files", name, f"an existing file below {root.name}/")
        listed.append(path)
    if isinstance(model, HistoriesModel):
        return (*listed, *sorted((root / model.folder).glob("*.csv")))
    if isinstance(model, CommandModel):
        return (*listed, *_of_command(model, root))
    return (*listed, *_of_module(model, root))


def _of_command(model: CommandModel, root: Path) -> Iterator[Path]:
    program = find_program(model, root)
    if program.resolve().is_relative_to(root.resolve()):
        yield program
    folder = working_folder(model, root)
    for part in model.arguments[1:]:
        path = folder / part
        if "{" not in part and path.is_file():
            yield path


def _of_module(model: PythonModel, root: Path) -> Iterator[Path]:
    """Yield the files of the model's top-level module or package, found without importing it."""
    name = model.object
    if name is None:
        points = [point for point in importlib.metadata.entry_points(group=GROUP) if point.name == model.entry_point]
        if not points:
            return  # the run itself says that there is none
        name = points[0].value
    top = name.partition(":")[0].partition(".")[0]
    beside = [root / f"{top}.py", root / top / "__init__.py"]
    spec = importlib.util.find_spec(top)
    origin = Path(spec.origin) if spec is not None and spec.origin is not None else None
    place = origin if origin is not None else next((path for path in beside if path.is_file()), None)
    if place is None:
        return
    if place.name == "__init__.py":
        yield from (path for path in sorted(place.parent.rglob("*.py")))
    else:
        yield place


def _shown(file: Path, root: Path) -> str:
    """Name a file the same way on every computer."""
    return str(file.relative_to(root.resolve())) if file.is_relative_to(root.resolve()) else file.name
