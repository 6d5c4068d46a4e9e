"""Digests by exclusion: every field of a model counts unless it is declared a label, where it is declared.

A new key of the study therefore changes the digest of the cases that have it until somebody says that it is a label,
and why. The numbers that decide only how finely a solver works are marked too, so that the physical problem has a
digest of its own, which a run of any solver may be compared with.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import Any, get_type_hints

from pydantic import BaseModel

from ..fields import DataFile, Label, Numerics, WhereGiven


@cache
def marks(owner: type[Any]) -> dict[str, tuple[object, ...]]:
    """Return the annotations' marks of every field of a pydantic model or a dataclass, by field name."""
    if issubclass(owner, BaseModel):
        return {name: tuple(item.metadata) for name, item in owner.model_fields.items()}
    hints = get_type_hints(owner, include_extras=True)
    return {item.name: tuple(getattr(hints[item.name], "__metadata__", ())) for item in dataclasses.fields(owner)}


def digest_of(item: object, root: Path, solvers: tuple[str, ...] = ()) -> str:
    """Return the SHA-256 of all that decides in a model or dataclass, in hex.

    `solvers` names whose settings count. Relative file names are looked up below `root`; a missing file counts by its
    name, so that it equals no file that is there.
    """
    content = _content(item, root, solvers)
    return hashlib.sha256(json.dumps(content, sort_keys=True, ensure_ascii=False).encode()).hexdigest()


def _content(value: Any, root: Path, solvers: tuple[str, ...]) -> Any:
    if isinstance(value, BaseModel) or (dataclasses.is_dataclass(value) and not isinstance(value, type)):
        return dict(_decisive(value, root, solvers))
    if isinstance(value, Mapping):
        return {str(key): _content(inner, root, solvers) for key, inner in value.items()}
    if isinstance(value, tuple | list):
        return [_content(inner, root, solvers) for inner in value]
    if value is None or isinstance(value, str | bool | int | float):
        return value
    raise TypeError(f"a {type(value).__name__} has no digest")


def _decisive(owner: Any, root: Path, solvers: tuple[str, ...]) -> Iterator[tuple[str, Any]]:
    for name, found in marks(owner.__class__).items():
        value = getattr(owner, name)
        if any(
            isinstance(mark, Label) or (isinstance(mark, Numerics) and mark.solver not in solvers) for mark in found
        ):
            continue
        if any(isinstance(mark, WhereGiven) and value == mark.absent for mark in found):
            continue
        if value is not None and any(isinstance(mark, DataFile) for mark in found):
            yield name, _file(root / value)
        else:
            yield name, _content(value, root, solvers)


def _file(path: Path) -> dict[str, str]:
    if not path.is_file():
        return {"missing": path.name}
    return {"sha256": hashlib.sha256(path.read_bytes()).hexdigest(), "suffix": path.suffix.lower()}
