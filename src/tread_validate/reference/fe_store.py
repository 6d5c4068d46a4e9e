"""Finite element references: a history, its record, and whether both still belong to the deck of today."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from ..errors import InputError, one_line
from ..history import History
from ..provenance import sha256_file
from ..yaml_text import read_mapping

Status = Literal["current", "stale", "missing", "corrupt"]
MESH_ERROR_KEYS = ("mesh_error", "mesh_error_estimate")


@dataclass(frozen=True)
class Reference:
    """One finite element run as it lies in the store.

    Attributes
    ----------
    case_id, engine : str
        Whose run it is.
    status : str
        ``current``: made from the deck of today; ``stale``: made from another deck; ``missing``: no run;
        ``corrupt``: unreadable, without its record or not the history that its record describes.
    reason : str
        Why it is not current, in one line; empty where it is.
    history : History or None
        The run, where it is current or stale.
    record : mapping
        The record as read.
    digest : str
        SHA-256 of the history file, empty where there is none.
    """

    case_id: str
    engine: str
    status: Status
    reason: str = ""
    history: History | None = None
    record: Mapping[str, Any] = field(default_factory=dict)
    digest: str = ""

    def uncertainty(self) -> float | Mapping[str, float] | None:
        """Return the relative mesh error of the record (for all forces, or by quantity), or None where unknown."""
        for key in MESH_ERROR_KEYS:
            value = self.record.get(key)
            if isinstance(value, Mapping):
                kept = {str(k): float(v) for k, v in value.items() if _is_error(v)}
                return kept or None
            if _is_error(value):
                return float(value)  # type: ignore[arg-type]
        return None


def fe_path(folder: Path | str, engine: str, case_id: str) -> Path:
    """Return where a case's history lies below the reference folder; its record is the ``.yaml`` beside it."""
    return Path(folder) / "fe" / engine / f"{case_id}.csv"


def load_fe(folder: Path | str, engine: str, case_id: str, deck_digest: str | None) -> Reference:
    """Load one run and say whether it is still the reference of the case; never raises for what lies in the store.

    Parameters
    ----------
    folder : path
        The reference folder (``reference_data``).
    engine, case_id : str
        Which run.
    deck_digest : str or None
        Digest of the case's deck as it is written today (`provenance.deck_digest`); None where no deck is at hand,
        which leaves every run stale, because it cannot be shown to be current.
    """
    source = fe_path(folder, engine, case_id)
    record_file = source.with_suffix(".yaml")

    def bad(status: Status, reason: str, **more: Any) -> Reference:
        return Reference(case_id, engine, status, one_line(reason), **more)

    if not source.is_file():
        if record_file.is_file():
            return bad("corrupt", f"{record_file.name} without its history")
        return bad("missing", "no run of this engine")
    if not record_file.is_file():
        return bad("corrupt", f"{source.name} without its record")
    try:
        record = read_mapping(record_file)
        history = History.read_csv(source)
    except InputError as error:
        return bad("corrupt", str(error))
    digest = sha256_file(source)
    if record.get("history_sha256") != digest:
        return bad("corrupt", f"{source.name}: checksum is not that of its record", record=record)
    if record.get("case_id") not in (case_id, None):
        return bad("corrupt", f"{record_file.name}: record of case {record['case_id']}", record=record)
    found = record.get("deck_digest")
    if deck_digest is None:
        return bad("stale", "no deck at hand to hold the run against", history=history, record=record, digest=digest)
    if found != deck_digest:
        reason = f"made from another deck ({str(found)[:12]}, today {deck_digest[:12]})"
        return bad("stale", reason, history=history, record=record, digest=digest)
    return Reference(case_id, engine, "current", "", history, record, digest)


def check_store(folder: Path | str) -> tuple[tuple[str, str], ...]:
    """Check every run of every engine: a record for each history, a history for each record, the right checksum.

    Returns (``fe/<engine>``, ``<n> runs``) for each engine and (``fe/<engine>/<case_id>``, reason) for each run that is
    corrupt; nothing is raised, because a corrupt run has rows of its own in the comparison. Further tables of a run
    (``<case_id>_face.csv``) carry its name and need no record of their own.
    """
    found = []
    store = Path(folder) / "fe"
    for engine in sorted(path for path in store.iterdir() if path.is_dir()) if store.is_dir() else ():
        records = {path.stem for path in engine.glob("*.yaml")}
        histories = {path.stem for path in engine.glob("*.csv")}
        if not histories:
            continue
        found.append((f"fe/{engine.name}", f"{len(records)} runs"))
        companions = {name for name in histories if any(name.startswith(f"{record}_") for record in records)}
        for case_id in sorted((records | histories) - companions):
            reference = load_fe(folder, engine.name, case_id, None)
            if reference.status == "corrupt":
                found.append((f"fe/{engine.name}/{case_id}", f"corrupt, {reference.reason}"))
    return tuple(found)


def _is_error(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value) and value >= 0
