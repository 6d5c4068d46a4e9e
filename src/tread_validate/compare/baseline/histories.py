"""Force histories of the accepted runs, few samples each, so that a later report can draw before beside after."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from ...errors import InputError
from ...files import read_text
from ...history import History
from ...provenance import sha256_text
from ...yaml_text import read_mapping
from ..tables import PeakRow, read_rows
from ..thinned import Packed, pack

HISTORIES = "histories.json"
SAMPLES = 60  # enough to see a curve: a study of 52 cases and four sources stays below 250 kB

Histories = Mapping[tuple[str, str], Packed]
"""Packed histories (see `thinned.pack`) by source and case."""


def histories_text(tables: Path, references: Path) -> str:
    """Return the thinned histories of every current run as JSON, a line each; nothing where no history lies.

    Spring models' and own models' histories lie beside the tables' folder, references' in the reference package.
    """
    lines = []
    for row in read_rows(tables / "peaks.csv", PeakRow):
        kind, _, name = row.source.partition(":")
        file = references / row.folder / "history.csv" if row.folder else None
        if kind in ("spring", "model"):
            file = tables.parent / ("models" if kind == "model" else kind) / name / f"{row.case_id}.csv"
        if row.status == "current" and file is not None and file.is_file():
            packed = json.dumps(pack(History.read_csv(file), SAMPLES), separators=(",", ":"), sort_keys=True)
            lines.append(f"{json.dumps(f'{row.source} {row.case_id}')}:{packed}")
    return "{\n" + ",\n".join(lines) + "\n}\n" if lines else ""


def accepted_histories(folder: Path, record: str) -> Histories:
    """Return the histories of a baseline; none of one that was accepted without.

    Raises `InputError` for a file that is missing or not that of the `record`.
    """
    facts = read_mapping(folder / record).get("histories")
    if facts is None:
        return {}
    text = read_text(folder / HISTORIES)
    if not isinstance(facts, dict) or sha256_text(text) != facts.get("sha256"):
        raise InputError(folder / HISTORIES, "histories of another checksum", f"those that {record} was written for")
    found = {}
    for key, packed in json.loads(text).items():
        source, _, case = key.partition(" ")
        found[source, case] = packed
    return found
