"""Reading the store's layout before 0.2 once: ``fe/<engine>/<case_id>.csv`` and ``.yaml``, ``fe/mesh/<kind>.yaml``."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import read_text
from ..inp import DeckFiles, deck_files
from ..inp.problem import FORTRAN_COMMENTS
from ..provenance import sha256_file
from ..source_code import UNKNOWN
from ..study import Case
from ..yaml_text import read_mapping, write_yaml
from .fe_store import ENGINE_PARTS, FeStore
from .filing import FinishedRun, file_run
from .mesh_errors import SCHEMA, applies_to


@dataclass(frozen=True)
class Migrated:
    """What was moved, and what was left where it is, with the reason."""

    moved: tuple[str, ...]
    left: tuple[tuple[str, str], ...]


def migrate(references: Path, cases: Sequence[Case], decks: Path, study: str) -> Migrated:
    """Move the runs of the old layout whose decks are at hand, unchanged; leave the others and say why.

    A run's record becomes that of today's form; its code is ``unknown``, so that it shows as made by other code.
    """
    store = FeStore(references)
    moved: list[str] = []
    left: list[tuple[str, str]] = []
    for engine in ENGINE_PARTS:
        for record_file in sorted((store.root / engine).glob("*.yaml")):
            try:
                run = _old_run(record_file, engine, deck_files(decks, record_file.stem))
            except InputError as error:
                left.append((f"{engine}/{record_file.stem}", str(error)))
                continue
            old = [record_file, run.history_file, run.history_file.with_name(f"{record_file.stem}_face.csv")]
            store = _Aside(references, engine)
            file_run(store, run, study=study)
            for file in old:
                file.unlink(missing_ok=True)
            moved.append(f"{engine}/{record_file.stem}")
    by_id = {case.case_id: case for case in cases}
    for file in sorted((store.root / "mesh").glob("*.yaml")):
        _migrate_mesh(file, by_id, study, moved, left)
    return Migrated(tuple(moved), tuple(left))


class _Aside(FeStore):
    """A store that does not mind files of the old layout beside the new folders."""

    def __init__(self, references: Path, engine: str) -> None:
        super().__init__(references)
        place = self.root / engine
        folders = sorted(path for path in place.iterdir() if path.is_dir())
        self._entries[engine] = tuple(self._entry(path, engine) for path in folders)


def _old_run(record_file: Path, engine: str, deck: DeckFiles) -> FinishedRun:
    record = read_mapping(record_file)
    history = record_file.with_suffix(".csv")
    if not history.is_file() or record.get("history_sha256") != sha256_file(history):
        raise InputError(record_file, "another checksum", f"history_sha256 of {history.name}")
    if not deck.deck.is_file():
        raise InputError(deck.deck, "no such file", "the deck of the run (tread-validate deck)")
    if record.get("deck_digest") != old_deck_digest(deck):
        raise InputError(
            record_file, "another deck_digest", f"that of {deck.deck.name}: the run is stale, make it anew"
        )
    kept = {key: value for key, value in record.items() if not key.startswith("mesh_error")}
    new = {"case_id": record_file.stem, **kept, "engine": engine, "code": UNKNOWN, "deck_digest": deck.problem.digest}
    return FinishedRun(history, new, deck.problem, deck.text_digest)


def old_deck_digest(deck: DeckFiles) -> str:
    """Return the digest that records of the old layout carry: all lines but comments, deck and routine."""
    lines = [line.rstrip() for line in read_text(deck.deck).splitlines() if not line.startswith("**")]
    if deck.user is not None and deck.user.is_file():
        user = read_text(deck.user).splitlines()
        lines += [line.rstrip() for line in user if line[:1] not in FORTRAN_COMMENTS]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()


def _migrate_mesh(
    file: Path, cases: Mapping[str, Case], study: str, moved: list[str], left: list[tuple[str, str]]
) -> None:
    data = read_mapping(file)
    if data.get("schema") == SCHEMA:
        return
    case = cases.get(str(data.get("case_id")))
    if case is None:
        left.append((f"mesh/{file.name}", f"case {data.get('case_id')} is not in the study"))
        return
    size = data.get("element_size_mm")
    if size != case.deck.element_size_mm:
        left.append((f"mesh/{file.name}", f"made for {size} mm, the study has {case.deck.element_size_mm} mm"))
        return
    document: dict[str, Any] = {
        "schema": SCHEMA,
        "case_id": case.case_id,
        "study": study,
        "applies_to": applies_to(case, "embedded").model_dump(),
        "code": UNKNOWN,
        **{key: value for key, value in data.items() if key not in ("kind", "case_id")},
    }
    target = file.with_name(f"embedded-{case.case_id}.yaml")
    write_yaml(target, document)
    file.unlink()
    moved.append(f"mesh/{file.stem}")
