"""Finite element references, stored by the problem that was solved and found by it, whatever study asks.

Each run has a folder ``fe/<engine>/<case_id>-<digest>``: ``history.csv``, ``face.csv`` where there is one, ``deck.txt``
and, written last, ``record.yaml``. The name is for people; runs are found by their decks' content.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Any, Literal

from ..errors import InputError, one_line
from ..history import History
from ..inp import DeckFiles, Problem, agree, differences
from ..mending import mended_by
from ..provenance import sha256_file
from ..source_code import PARTS, UNKNOWN, code_digest
from ..yaml_text import read_mapping
from .deck_store import check_block, read_problem, used_blocks
from .mesh_errors import MeshErrors, is_error

Status = Literal["current", "other_code", "stale", "missing", "corrupt"]
ENGINE_PARTS: Mapping[str, str] = {"embedded": "fe", "abaqus": "abaqus", "calculix": "calculix"}
"""Which part of the code makes an engine's runs (for ABAQUS: what extracts and checks its forces)."""
NEEDED = ("case_id", "engine", "deck_digest", "deck_structure", "code", "history_sha256")
MESH_ERROR_KEYS = ("mesh_error", "mesh_error_estimate")
MOST_DIFFERENCES = 1000  # counted; a deck that differs in more is simply another one


@dataclass(frozen=True)
class Reference:
    """One finite element run, and how far it belongs to the deck and code of today.

    Attributes
    ----------
    case_id, engine : str
        What was asked for.
    status : str
        ``current``: of the problem that today's deck poses; ``other_code``: the same, made before the engine's code
        changed; ``stale``: of another problem, or not to be compared with one; ``missing``: no run; ``corrupt``:
        unreadable, without its record, or not what its record describes.
    reason : str
        Why it is not current, in one line; empty where it is.
    history : History or None
        The run, where it is current or of other code.
    record : mapping
        The record as read.
    digest : str
        SHA-256 of the history file, empty where there is none.
    folder : path or None
        Where it lies.
    """

    case_id: str
    engine: str
    status: Status
    reason: str = ""
    history: History | None = None
    record: Mapping[str, Any] = field(default_factory=dict)
    digest: str = ""
    folder: Path | None = None

    def fault(self) -> str:
        """Return why the run's own record says that it is no reference; empty where it does not.

        A record without ``reference_quality`` (of an engine that does not judge its runs) says nothing.
        """
        quality = self.record.get("reference_quality")
        if self.history is None or not isinstance(quality, Mapping) or quality.get("usable") is not False:
            return ""
        reasons = quality.get("reasons")
        return one_line("; ".join(map(str, reasons)) if isinstance(reasons, list) else "not usable")

    def stated_error(self) -> float | Mapping[str, float] | None:
        """Return the relative mesh error that the record itself states (for all forces, or by quantity), or None."""
        for key in MESH_ERROR_KEYS:
            value = self.record.get(key)
            if isinstance(value, Mapping):
                kept = {str(k): float(v) for k, v in value.items() if is_error(v)}
                return kept or None
            if is_error(value):
                return float(value)  # type: ignore[arg-type]  # a number, by the test above
        return None


@dataclass(frozen=True)
class Entry:
    """A folder of the store: its record, or what is wrong with it."""

    folder: Path
    record: Mapping[str, Any]
    fault: str = ""

    @property
    def history_file(self) -> Path:
        """The history's file."""
        return self.folder / "history.csv"


class FeStore:
    """The runs below ``<references>/fe``; records are read once."""

    def __init__(self, references: Path | str) -> None:
        self.root = Path(references) / "fe"
        self._entries: dict[str, tuple[Entry, ...]] = {}
        self._sound_blocks: set[str] = set()

    @property
    def blocks(self) -> Path:
        """Where long tables of decks lie."""
        return self.root / "blocks"

    @cached_property
    def mesh_errors(self) -> MeshErrors:
        """The mesh studies."""
        return MeshErrors(self.root / "mesh")

    def engines(self) -> tuple[str, ...]:
        """Return the engines that have a run."""
        return tuple(engine for engine in ENGINE_PARTS if self.entries(engine))

    def entries(self, engine: str) -> tuple[Entry, ...]:
        """Return every folder of an engine, sound or not; raises `InputError` for a store of the old layout."""
        if engine not in self._entries:
            place = self.root / engine
            found = sorted(place.iterdir()) if place.is_dir() else []
            old = next((path for path in found if path.is_file() and path.suffix in (".csv", ".yaml")), None)
            if old is not None:
                raise InputError(old, "a run of the layout before 0.2", "folders (tread-validate migrate-references)")
            self._entries[engine] = tuple(self._entry(path, engine) for path in found if path.is_dir())
        return self._entries[engine]

    def forget(self) -> None:
        """Read the records anew when next asked for."""
        self._entries.clear()
        self._sound_blocks.clear()

    def find(self, engine: str, case_id: str, today: DeckFiles | None) -> Reference:
        """Return the run of the problem that a deck poses; never raises for what lies in a run's folder.

        Parameters
        ----------
        engine, case_id : str
            The case's name serves messages, and to say how an earlier run of that name differs.
        today : DeckFiles or None
            None where no deck is at hand: nothing can then be shown to be current.
        """
        named = [entry for entry in self.entries(engine) if entry.record.get("case_id") == case_id]
        if today is None or not today.deck.is_file():
            if not named:
                return Reference(case_id, engine, "missing", "no run of this engine")
            return self._bad(
                named[0], case_id, engine, "stale", "no deck at hand to hold the run against (tread-validate deck)"
            )
        try:
            with mended_by("tread-validate deck STUDY --all"):
                entry = self._equal(engine, today)
        except InputError as error:
            return Reference(case_id, engine, "corrupt", one_line(str(error)))
        if entry is not None:
            return self._checked(entry, case_id, engine)
        broken = next((entry for entry in self.entries(engine) if entry.fault and _names(entry.folder, case_id)), None)
        if broken is not None:
            return self._bad(broken, case_id, engine, "corrupt", broken.fault)
        if not named:
            return Reference(case_id, engine, "missing", "no run of this engine")
        try:
            (_, reason), nearest = min(
                ((self._distance(entry, today.problem), entry) for entry in named), key=lambda found: found[0]
            )
        except InputError as error:
            return self._bad(named[0], case_id, engine, "corrupt", str(error))
        return self._bad(nearest, case_id, engine, "stale", reason)

    def equal_entry(self, engine: str, problem: Problem) -> Entry | None:
        """Return the folder of an engine's run of an equal problem; raises `InputError` for a damaged deck."""
        sound = [entry for entry in self.entries(engine) if not entry.fault]
        for entry in sound:
            if entry.record["deck_digest"] == problem.digest:
                return entry
        for entry in sound:
            if entry.record["deck_structure"] == problem.structure and agree(self._filed(entry), problem):
                return entry
        return None

    def check(self) -> tuple[tuple[str, str], ...]:
        """Return (``fe/<engine>``, ``<n> runs``) for each engine, and (folder, what is wrong) for each corrupt run."""
        found = []
        for engine in ENGINE_PARTS:
            entries = self.entries(engine)
            if entries:
                found.append((f"fe/{engine}", f"{sum(not entry.fault for entry in entries)} runs"))
            for entry in entries:
                fault = entry.fault or self._content_fault(entry)
                if fault:
                    found.append((f"fe/{engine}/{entry.folder.name}", f"corrupt, {fault}"))
        return tuple(found)

    def _equal(self, engine: str, today: DeckFiles) -> Entry | None:
        for entry in self.entries(engine):
            if not entry.fault and entry.record.get("deck_text_digest") == today.text_digest:
                return entry
        return self.equal_entry(engine, today.problem)

    def _filed(self, entry: Entry) -> Problem:
        filed = read_problem(self.blocks, entry.folder / "deck.txt")
        if filed.digest != entry.record["deck_digest"]:
            raise InputError(entry.folder / "deck.txt", f"digest {filed.digest[:12]}", "the deck_digest of record.yaml")
        return filed

    def _distance(self, entry: Entry, problem: Problem) -> tuple[int, str]:
        """Return in how many lines the run's deck differs from today's, and the first of them in words."""
        apart = list(islice(differences(self._filed(entry), problem), MOST_DIFFERENCES))
        more = "" if len(apart) < 2 else f" and {len(apart) - 1}{'+' * (len(apart) == MOST_DIFFERENCES)} more lines"
        return len(apart), f"made from another deck: {apart[0]}{more}"

    def _checked(self, entry: Entry, case_id: str, engine: str) -> Reference:
        fault = self._content_fault(entry)
        if fault:
            return self._bad(entry, case_id, engine, "corrupt", fault)
        history = History.read_csv(entry.history_file)
        made_by, today = str(entry.record["code"]), code_digest(ENGINE_PARTS[engine])
        status: Status = "current"
        reason = ""
        if made_by != today:
            status = "other_code"
            words = "code that its record does not name" if made_by == UNKNOWN else f"code {made_by}"
            reason = f"made by {words}; the part {ENGINE_PARTS[engine]} is {today} today"
        digest = str(entry.record["history_sha256"])
        return Reference(case_id, engine, status, reason, history, entry.record, digest, entry.folder)

    def _content_fault(self, entry: Entry) -> str:
        """Return what is wrong with history or deck of a sound record, in one line; empty where nothing is."""
        try:
            self._filed(entry)
            for name in used_blocks(entry.folder / "deck.txt") - self._sound_blocks:
                check_block(self.blocks, name)
                self._sound_blocks.add(name)
            if sha256_file(entry.history_file) != entry.record["history_sha256"]:
                return "history.csv: checksum is not that of record.yaml"
            History.read_csv(entry.history_file)
        except InputError as error:
            return one_line(str(error))
        except OSError as error:
            return f"{Path(error.filename or 'history.csv').name}: {error.strerror}"
        return ""

    def _entry(self, folder: Path, engine: str) -> Entry:
        record_file = folder / "record.yaml"
        if not record_file.is_file():
            return Entry(folder, {}, "no record.yaml: a run that was not filed to its end")
        try:
            record = read_mapping(record_file, fast=True)
        except InputError as error:
            return Entry(folder, {}, one_line(str(error)))
        missing = [key for key in NEEDED if not isinstance(record.get(key), str)]
        if missing:
            return Entry(folder, {}, f"record.yaml: no {missing[0]} (an older format: file the run again)")
        if record["engine"] != engine:
            return Entry(folder, record, f"record.yaml: engine {record['engine']}, but the folder is {engine}'s")
        if not _names(folder, record["case_id"]):
            return Entry(folder, record, f"record.yaml: case {record['case_id']}, but the folder is {folder.name}")
        return Entry(folder, record)

    def _bad(self, entry: Entry, case_id: str, engine: str, status: Status, reason: str) -> Reference:
        if status == "corrupt":
            reason = f"{entry.folder.name}: {reason} (mend: git checkout, or delete the folder and make reference)"
        return Reference(case_id, engine, status, one_line(reason), record=entry.record, folder=entry.folder)


def _names(folder: Path, case_id: str) -> bool:
    return folder.name.rpartition("-")[0] == case_id


def check_engine(engine: str) -> str:
    """Return the name of an engine; raises `InputError` where there is none of that name."""
    if engine not in ENGINE_PARTS:
        raise InputError("engine", engine, f"one of {', '.join(ENGINE_PARTS)}")
    assert ENGINE_PARTS[engine] in PARTS
    return engine
