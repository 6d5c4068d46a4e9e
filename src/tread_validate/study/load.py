"""Reading a study file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError, one_line
from ..files import read_text
from ..model_file import as_model
from ..provenance import sha256_text
from ..yaml_text import load_yaml
from .case import Case
from .compound import Compound, LibraryCompound
from .document import Study
from .grid import expand
from .library import library_compound, library_file, named_compound

LARGEST_FILE = 1_000_000


@dataclass(frozen=True)
class LoadedStudy:
    """A validated study with the place it came from."""

    model: Study
    source: Path
    root: Path
    digest: str

    def cases(self) -> tuple[Case, ...]:
        """Return every case; free-rolling ones still without a creep ratio."""
        return expand(self.model, self.source, self.root, self.digest)

    def compounds(self) -> dict[str, Compound]:
        """Return the compounds by their names in the study, those of the library read."""
        return {name: named_compound(item, self.root) for name, item in self.model.compounds.items()}

    def library_files(self) -> tuple[Path, ...]:
        """Return the files of the library that the study names."""
        named = (item for item in self.model.compounds.values() if isinstance(item, LibraryCompound))
        return tuple(library_file(item.name, self.root) for item in named)

    def case(self, case_id: str) -> Case:
        """Return one case by its id; raises `InputError` where there is none."""
        cases = {case.case_id: case for case in self.cases()}
        if case_id not in cases:
            near = ", ".join(list(cases)[:3])
            raise InputError(f"{self.source}: case {one_line(case_id, 80)}", "no such case", f"one of {near}, ...")
        return cases[case_id]


def load_study(path: Path | str) -> LoadedStudy:
    """Read and validate a study; every fault is one `InputError` line with the key that is wrong.

    File names in the study are relative to the folder that holds ``config/``, or to the study's own folder where it
    is not in a ``config`` folder.
    """
    source = Path(path)
    text = read_text(source)
    if len(text) > LARGEST_FILE:
        raise InputError(source, f"{len(text)} characters", f"at most {LARGEST_FILE}")
    model = as_model(load_yaml(text, source), Study, source)
    root = source.resolve().parent
    if root.name == "config":
        root = root.parent
    study = LoadedStudy(model=model, source=source, root=root, digest=sha256_text(text))
    for section, table in (
        ("compounds", model.compounds),
        ("friction_laws", model.friction_laws),
        ("paths", model.paths),
    ):
        for name, item in table.items():
            if isinstance(item, LibraryCompound):
                library_compound(item.name, root)
            file = getattr(item, "file", None)
            if file is not None and not (root / file).is_file():
                raise InputError(f"{source}: {section}.{name}.file", file, f"an existing file below {root.name}/")
    for name, block in model.blocks.items():
        if block.mesh is not None and not (root / block.mesh).is_file():
            raise InputError(f"{source}: blocks.{name}.mesh", block.mesh, f"an existing file below {root.name}/")
    return study
