"""What the mesh of a reference run is worth: mesh studies, each for one engine, block, path kind and element size."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat

from ..errors import InputError
from ..model_file import as_model
from ..provenance import sha256_text
from ..source_code import UNKNOWN
from ..study import Case
from ..yaml_text import read_mapping, write_yaml

SCHEMA = 2
METHOD = "Richardson extrapolation from three meshes (doi:10.1115/1.2960953); errors are relative"
LENGTH_RATIO = "element_length_ratio"  # told where elements are not as long as wide
MESH_KEYS = ("element_size_mm", LENGTH_RATIO, "layers", "refinement", "hourglass", "bulk_viscosity")


class _Kept(BaseModel):
    """A frozen part of a mesh study's file; keys of other versions are left aside."""

    model_config = ConfigDict(frozen=True, extra="ignore")


class Applies(_Kept):
    """What a run must have in common with a mesh study for it to say anything about the run.

    Engine, kind of path, the block as the study gives it (less what is left at its default) and the mesh.
    """

    engine: str
    path_kind: str
    block: dict[str, Any]
    mesh: dict[str, Any]


class MeshQuantity(_Kept):
    """One scalar on every mesh, its limit at size 0 and the observed order; None without monotonic convergence."""

    values: tuple[FiniteFloat, ...]
    limit: FiniteFloat
    order: FiniteFloat | None


class MeshStudy(_Kept):
    """Three meshes of one case, extrapolated: the file as it is written and read."""

    schema_version: Literal[2] = Field(alias="schema")
    case_id: str
    study: str
    applies_to: Applies
    code: str
    element_size_mm: FiniteFloat
    method: str = METHOD
    sizes_mm: tuple[FiniteFloat, ...]
    deck_digests: tuple[str, ...] = ()
    history_sha256: tuple[str, ...] = ()
    mesh_error: dict[str, float]
    quantities: dict[str, MeshQuantity]


def applies_to(case: Case, engine: str) -> Applies:
    """Return what a mesh study must have in common with a run of the case."""
    deck = case.deck.model_dump(mode="json")
    return Applies(
        engine=engine,
        path_kind=case.path.kind,
        block=case.block.model_dump(mode="json", exclude_defaults=True, exclude={"origin", "source"}),
        mesh={key: deck[key] for key in MESH_KEYS if key != LENGTH_RATIO or deck[key] != 1.0},
    )


class MeshErrors:
    """The mesh studies of a folder, read once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @cached_property
    def studies(self) -> tuple[MeshStudy, ...]:
        """Every study; raises `InputError` for a file that is none, or of an older format."""
        return tuple(read_mesh_study(path) for path in sorted(self.folder.glob("*.yaml")))

    def of(self, case: Case, engine: str) -> MeshStudy | None:
        """Return the study that applies to a case's runs by an engine, None where none does."""
        wanted = applies_to(case, engine)
        return next((study for study in self.studies if study.applies_to == wanted), None)

    def error(self, case: Case, engine: str) -> dict[str, float] | None:
        """Return the relative discretisation uncertainty, by quantity; None where no mesh study applies."""
        study = self.of(case, engine)
        if study is None:
            return None
        return {key: value for key, value in study.mesh_error.items() if is_error(value)} or None


def document(
    case: Case,
    study: str,
    records: Sequence[Mapping[str, Any]],
    sizes: Sequence[float],
    numbers: Mapping[str, Mapping[str, Any]],
) -> MeshStudy:
    """Return a mesh study.

    Parameters
    ----------
    case : Case
        The case that was run on every mesh; its deck settings are those in use.
    study : str
        Name of its study.
    records : sequence of mapping
        Of the runs, coarse to fine, all of one engine and code.
    sizes : sequence of float, mm
    numbers : mapping
        ``mesh_error`` and ``quantities`` of `compare.scores.convergence.mesh_study`.
    """
    return MeshStudy(
        schema=SCHEMA,
        case_id=case.case_id,
        study=study,
        applies_to=applies_to(case, str(records[0]["engine"])),
        code=str(records[0].get("code", UNKNOWN)),
        element_size_mm=case.deck.element_size_mm,
        sizes_mm=tuple(float(size) for size in sizes),
        deck_digests=tuple(record["deck_digest"] for record in records),
        history_sha256=tuple(record["history_sha256"] for record in records),
        mesh_error=dict(numbers["mesh_error"]),
        quantities={name: MeshQuantity(**item) for name, item in numbers["quantities"].items()},
    )


def write_mesh_study(path: Path, study: MeshStudy) -> None:
    """Write a mesh study, atomically."""
    write_yaml(path, study.model_dump(mode="json", by_alias=True))


def read_mesh_study(path: Path) -> MeshStudy:
    """Read a mesh study; raises `InputError` where it is none."""
    data = read_mapping(path)
    if data.get("schema") != SCHEMA:
        words = f"schema {SCHEMA} (tread-validate migrate-references, or make it anew)"
        raise InputError(path, f"schema {data.get('schema', 'none')}", words)
    return as_model(data, MeshStudy, path)


def file_mesh_study(folder: Path, result: Path) -> Path:
    """File the result of a mesh study and return its place; it takes that of the one that held for the same runs."""
    study = read_mesh_study(result)
    applies = study.applies_to
    for file in folder.glob("*.yaml"):
        if read_mesh_study(file).applies_to == applies:
            file.unlink()
    key = sha256_text(repr(sorted(applies.model_dump().items(), key=str)))[:8]
    target = folder / f"{applies.engine}-{applies.path_kind}-{key}.yaml"
    write_mesh_study(target, study)
    return target


def is_error(value: Any) -> bool:
    """Whether a value is a relative error: a finite number, 0 or more."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value) and value >= 0
