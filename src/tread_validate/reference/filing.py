"""Putting runs into the store: under the engine of their record, with the deck that they were made from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import InputError
from ..files import write_bytes
from ..history import History
from ..inp import DeckFiles, Problem
from ..provenance import sha256_file
from ..source_code import UNKNOWN
from ..yaml_text import read_mapping, write_yaml
from .deck_store import used_blocks, write_problem
from .fe_store import Entry, FeStore, check_engine

NOISE = 1e-4
"""Share of the peak normal force to which two runs of one problem are the same: another machine, another release."""
NAME_DIGITS = 8


@dataclass(frozen=True)
class FinishedRun:
    """A finished run, ready to be filed.

    Attributes
    ----------
    history_file : path
        The history; a face table may lie beside it as ``<stem>_face.csv``.
    record : mapping
        With ``case_id``, ``engine``, ``deck_digest``, ``code`` and ``history_sha256`` at least.
    problem : Problem
        What was solved, with the digest that the record names.
    text_digest : str
        Of the deck's files.
    """

    history_file: Path
    record: Mapping[str, Any]
    problem: Problem
    text_digest: str


def read_record(history_file: Path) -> Mapping[str, Any]:
    """Return the record beside a run's history.

    Raises
    ------
    InputError
        The record does not say what the run was made from, or is another history's.
    """
    record_file = history_file.with_suffix(".yaml")
    record = read_mapping(record_file)
    for key in ("case_id", "engine", "deck_digest", "history_sha256"):
        if not isinstance(record.get(key), str):
            raise InputError(
                f"{record_file}: {key}", record.get(key, "nothing"), "a record that binds the run (run it again)"
            )
    digest = sha256_file(history_file)
    if record["history_sha256"] != digest:
        raise InputError(record_file, "another checksum", f"history_sha256 {digest[:12]}... of {history_file.name}")
    return record


def read_run(history_file: Path, deck: DeckFiles, engine: str | None = None) -> FinishedRun:
    """Read a run and its record and hold them against the deck; raises `InputError` where they do not belong together.

    Parameters
    ----------
    history_file : path
        The history; its record is the ``.yaml`` beside it.
    deck : DeckFiles
        The deck that was run.
    engine : str, optional
        Only checked: the record says whose run it is.
    """
    record_file = history_file.with_suffix(".yaml")
    record = read_record(history_file)
    check_engine(record["engine"])
    if engine is not None and engine != record["engine"]:
        raise InputError(f"{record_file}: engine", record["engine"], f"{engine}, as --engine says")
    if deck.problem.digest != record["deck_digest"]:
        found = f"digest {deck.problem.digest[:12]}"
        raise InputError(
            deck.deck, found, f"{record['deck_digest'][:12]}, the deck of {record_file.name} (run it again)"
        )
    return FinishedRun(history_file, record, deck.problem, deck.text_digest)


def file_run(store: FeStore, run: FinishedRun, *, study: str, replace: bool = False) -> Path:
    """File a run and return its folder; a run of an equal problem gives way to it.

    Raises
    ------
    InputError
        The filed run of the same problem differs by more than `NOISE` and `replace` is not set.
    """
    engine = check_engine(str(run.record["engine"]))
    there = store.equal_entry(engine, run.problem)
    if there is not None and not replace:
        apart = difference(there, History.read_csv(run.history_file))
        if apart:
            raise InputError(there.folder, apart, f"a run equal to {NOISE:g} of the peak, or --replace")
    name = f"{run.record['case_id']}-{run.problem.digest[:NAME_DIGITS]}"
    folder = there.folder if there is not None else store.root / engine / name
    record_file = folder / "record.yaml"
    record_file.unlink(missing_ok=True)
    write_problem(store.blocks, folder / "deck.txt", run.problem)
    face = run.history_file.with_name(f"{run.history_file.stem}_face.csv")
    (folder / "face.csv").unlink(missing_ok=True)
    if face.is_file():
        write_bytes(folder / "face.csv", face.read_bytes())
    write_bytes(folder / "history.csv", run.history_file.read_bytes())
    record = {
        **run.record,
        "code": str(run.record.get("code") or UNKNOWN),
        "study": study,
        "deck_digest": run.problem.digest,
        "deck_structure": run.problem.structure,
        "deck_text_digest": run.text_digest,
    }
    write_yaml(record_file, record)
    store.forget()
    return folder


def difference(filed: Entry, new: History) -> str:
    """Return how a filed run and a new one differ beyond noise, in words; empty where they do not."""
    old = History.read_csv(filed.history_file)
    scale = float(np.max(np.abs(old.normal_force))) or 1.0
    end = min(old.time[-1], new.time[-1])
    clock = old.time[old.time <= end]
    apart = 0.0
    for name in ("normal_force", "tangential_force"):
        a = np.interp(clock, old.time, getattr(old, name))
        b = np.interp(clock, new.time, getattr(new, name))
        apart = max(apart, float(np.max(np.abs(a - b))))
    longer = abs(float(old.time[-1] - new.time[-1])) > NOISE * float(old.time[-1]) + float(np.max(np.diff(old.time)))
    if apart <= NOISE * scale and not longer:
        return ""
    peaks = f"peak normal force {old.normal_force.max():.4f} N filed, {new.normal_force.max():.4f} N now"
    return f"{peaks}; forces up to {apart:.3g} N ({apart / scale:.2g} of the peak) apart"


def drop_unused_blocks(store: FeStore) -> int:
    """Delete blocks that no filed deck needs any more and return how many."""
    used: set[str] = set()
    for deck in store.root.glob("*/*/deck.txt"):
        used |= used_blocks(deck)
    unused = [file for file in store.blocks.glob("*.gz") if file.stem not in used]
    for file in unused:
        file.unlink()
    return len(unused)
