"""What the mesh of a reference run is worth: mesh studies, each for one engine, block, path kind and element size."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..provenance import sha256_text
from ..source_code import UNKNOWN
from ..study import Case
from ..yaml_text import read_mapping, write_yaml

SCHEMA = 2
LENGTH_RATIO = "element_length_ratio"  # told where elements are not as long as wide
MESH_KEYS = ("element_size_mm", LENGTH_RATIO, "layers", "refinement", "hourglass", "bulk_viscosity")


def applies_to(case: Case, engine: str) -> dict[str, Any]:
    """Return what a mesh study must have in common with a run to say anything about it.

    Engine, kind of path, the block as the study gives it (less what is left at its default) and the mesh.
    """
    deck = case.deck.model_dump(mode="json")
    return {
        "engine": engine,
        "path_kind": case.path.kind,
        "block": case.block.model_dump(mode="json", exclude_defaults=True, exclude={"origin", "source"}),
        "mesh": {key: deck[key] for key in MESH_KEYS if key != LENGTH_RATIO or deck[key] != 1.0},
    }


class MeshErrors:
    """The mesh studies of a folder, read once."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @cached_property
    def studies(self) -> tuple[Mapping[str, Any], ...]:
        """Every study; raises `InputError` for a file that is none, or of an older format."""
        return tuple(read_mesh_study(path) for path in sorted(self.folder.glob("*.yaml")))

    def of(self, case: Case, engine: str) -> Mapping[str, Any] | None:
        """Return the study that applies to a case's runs by an engine, None where none does."""
        wanted = applies_to(case, engine)
        return next((study for study in self.studies if study["applies_to"] == wanted), None)

    def error(self, case: Case, engine: str) -> dict[str, float] | None:
        """Return the relative discretisation uncertainty, by quantity; None where no mesh study applies."""
        study = self.of(case, engine)
        if study is None:
            return None
        return {str(key): float(value) for key, value in study["mesh_error"].items() if is_error(value)} or None


def document(
    case: Case,
    study: str,
    records: Sequence[Mapping[str, Any]],
    sizes: Sequence[float],
    numbers: Mapping[str, Mapping[str, Any]],
) -> dict[str, Any]:
    """Return a mesh study as it is written.

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
    return {
        "schema": SCHEMA,
        "case_id": case.case_id,
        "study": study,
        "applies_to": applies_to(case, str(records[0]["engine"])),
        "code": str(records[0].get("code", UNKNOWN)),
        "element_size_mm": case.deck.element_size_mm,
        "method": "Richardson extrapolation from three meshes (doi:10.1115/1.2960953); errors are relative",
        "sizes_mm": [float(size) for size in sizes],
        "deck_digests": [record["deck_digest"] for record in records],
        "history_sha256": [record["history_sha256"] for record in records],
        **{key: dict(value) for key, value in numbers.items()},
    }


def read_mesh_study(path: Path) -> Mapping[str, Any]:
    """Read a mesh study; raises `InputError` where it is none."""
    data = read_mapping(path)
    if data.get("schema") != SCHEMA:
        words = f"schema {SCHEMA} (tread-validate migrate-references, or make it anew)"
        raise InputError(path, f"schema {data.get('schema', 'none')}", words)
    for key in ("applies_to", "mesh_error", "quantities"):
        if not isinstance(data.get(key), dict):
            raise InputError(f"{path}: {key}", type(data.get(key)).__name__, "a mapping, as `mesh-error` writes it")
    return data


def file_mesh_study(folder: Path, result: Path) -> Path:
    """File the result of a mesh study and return its place; it takes that of the one that held for the same runs."""
    data = read_mesh_study(result)
    applies = data["applies_to"]
    for file in folder.glob("*.yaml"):
        if read_mesh_study(file)["applies_to"] == applies:
            file.unlink()
    key = sha256_text(repr(sorted(applies.items(), key=str)))[:8]
    target = folder / f"{applies['engine']}-{applies['path_kind']}-{key}.yaml"
    write_yaml(target, dict(data))
    return target


def is_error(value: Any) -> bool:
    """Whether a value is a relative error: a finite number, 0 or more."""
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value) and value >= 0
