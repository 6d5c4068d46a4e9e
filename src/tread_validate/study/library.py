"""Published compounds by name: files of ``reference_data/compounds``, each a study's compound with its source."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import BaseModel, ConfigDict

from ..errors import InputError
from ..model_file import as_model
from ..provenance import sha256_file
from ..yaml_text import read_yaml
from .compound import Compound, LibraryCompound, PronyFile
from .shift import OtherShift, Wlf

if TYPE_CHECKING:
    from .compound import NamedCompound

FOLDER = Path("reference_data/compounds")


class _Entry(BaseModel):
    """What a file of the library holds."""

    model_config = ConfigDict(extra="forbid", frozen=True)
    compound: Compound


class _OwnShift(BaseModel):
    """What a material file says of its shift."""

    model_config = ConfigDict(extra="ignore", frozen=True)
    wlf: Wlf | None = None
    shift: OtherShift | None = None


def named_compound(compound: NamedCompound, root: Path) -> Compound:
    """Return a compound as it is, or the one of the library that it names; `root` is the study's.

    A material file that the study names without a shift brings its own.
    """
    if isinstance(compound, LibraryCompound):
        return library_compound(compound.name, root)
    if isinstance(compound, PronyFile) and not compound.model_fields_set & {"wlf", "shift"}:
        path = root / compound.file
        return _with_own_shift(compound, path, sha256_file(path)) if path.is_file() else compound
    return compound


def library_names(root: Path) -> tuple[str, ...]:
    """Return the names of the compounds below `root`, in order."""
    return tuple(sorted(path.stem for path in (root / FOLDER).glob("*.yaml")))


def library_compound(name: str, root: Path) -> Compound:
    """Return a compound of the library; raises `InputError` where there is none of the name, or it is wrong."""
    path = library_file(name, root)
    if not path.is_file():
        known = ", ".join(library_names(root)) or f"a study beside a folder {FOLDER}"
        raise InputError(f"compounds: library compound {name}", "no such file", known)
    return _read(path, sha256_file(path))


def library_file(name: str, root: Path) -> Path:
    """Return where a compound of the library lies."""
    return root / FOLDER / f"{name}.yaml"


@lru_cache(maxsize=64)
def _with_own_shift(compound: PronyFile, path: Path, digest: str) -> PronyFile:
    """Read once per content: `digest` is there for the cache."""
    data = read_yaml(path)
    own = as_model(data, _OwnShift, path) if isinstance(data, dict) else _OwnShift()
    given = {name: value for name, value in (("wlf", own.wlf), ("shift", own.shift)) if value is not None}
    return compound.model_copy(update=given)


@lru_cache(maxsize=64)
def _read(path: Path, digest: str) -> Compound:
    """Read once per content: `digest` is there for the cache."""
    return as_model({"compound": read_yaml(path)}, _Entry, path).compound
