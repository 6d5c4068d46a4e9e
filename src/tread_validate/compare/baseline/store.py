"""An accepted set of rows with the record of who accepted it, when, why and from which code."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ...errors import InputError, one_line
from ...files import read_text, write_text
from ...provenance import sha256_text
from ...yaml_text import read_mapping, write_yaml
from ..tables.text import table_text
from .rows import ROW_COLUMNS, BaselineRow

SCHEMA_VERSION = 1
ROWS, RECORD = "rows.csv", "baseline.yaml"


@dataclass(frozen=True)
class Acceptance:
    """Why a baseline is what it is.

    Attributes
    ----------
    reason, who, when, commit : str
        `when` in UTC, ISO 8601; `commit` of the code that made the tables.
    study, study_digest : str
    """

    reason: str
    who: str
    when: str
    commit: str
    version: str
    study: str
    study_digest: str


@dataclass(frozen=True)
class Baseline:
    """Accepted rows and their record."""

    rows: tuple[BaselineRow, ...]
    acceptance: Acceptance


def save_baseline(folder: Path | str, baseline: Baseline) -> None:
    """Write rows and record, the record last: a baseline without one does not load."""
    if not baseline.rows:
        raise InputError("baseline", "no rows", "at least one row to accept")
    place = Path(folder)
    text = table_text(ROW_COLUMNS, map(asdict, baseline.rows))
    record = {
        "schema_version": SCHEMA_VERSION,
        **asdict(baseline.acceptance),
        "rows": len(baseline.rows),
        "rows_sha256": sha256_text(text),
    }
    write_text(place / ROWS, text)
    write_yaml(place / RECORD, record)


def load_baseline(folder: Path | str) -> Baseline:
    """Read a baseline.

    Raises `InputError` where there is none, for another schema version, an empty one, and rows that are not those
    of the record.
    """
    place = Path(folder)
    if not (place / RECORD).is_file():
        raise InputError(place / RECORD, "no such file", "a baseline; `tread-validate accept` makes one")
    record = _record(place / RECORD)
    text = read_text(place / ROWS)
    if sha256_text(text) != record["rows_sha256"]:
        raise InputError(place / ROWS, "rows of another checksum", f"those that {RECORD} was written for")
    reader = csv.DictReader(io.StringIO(text))
    if tuple(reader.fieldnames or ()) != ROW_COLUMNS:
        raise InputError(f"{place / ROWS}:1", one_line(",".join(reader.fieldnames or ()), 120), ",".join(ROW_COLUMNS))
    rows = tuple(_row(cells, f"{place / ROWS}:{line}") for line, cells in enumerate(reader, start=2))
    if not rows:
        raise InputError(place / ROWS, "a header only", "at least one accepted row")
    names = Acceptance.__dataclass_fields__
    return Baseline(rows, Acceptance(**{name: str(record[name]) for name in names}))


def same_study(baseline: Baseline, tables: Path | str) -> None:
    """Raise `InputError` where the tables are of another study than the baseline: nothing in them is comparable."""
    path = Path(tables) / "provenance.json"
    try:
        facts = json.loads(read_text(path))
    except json.JSONDecodeError as error:
        raise InputError(f"{path}:{error.lineno}", error.msg, "JSON") from None
    found = facts.get("study") if isinstance(facts, dict) else None
    if found != baseline.acceptance.study:
        raise InputError(f"{path}: study", found, f"{baseline.acceptance.study}, the study of the baseline")


def _record(path: Path) -> dict[str, Any]:
    record = read_mapping(path)
    if record.get("schema_version") != SCHEMA_VERSION:
        raise InputError(
            f"{path}: schema_version", record.get("schema_version"), f"{SCHEMA_VERSION}; accept a new baseline"
        )
    needed: Sequence[str] = (*Acceptance.__dataclass_fields__, "rows_sha256")
    for name in needed:
        if name not in record:
            raise InputError(f"{path}: {name}", "nothing", "a value")
    return record


def _row(cells: dict[str, str], where: str) -> BaselineRow:
    if None in cells or None in cells.values():
        raise InputError(where, "a row of another length", f"{len(ROW_COLUMNS)} cells")
    try:
        value = float(cells["value"]) if cells["value"] else None
        tolerance = float(cells["tolerance"])
    except ValueError:
        raise InputError(where, "a value that is no number", "numbers in value and tolerance") from None
    names = [name for name in ROW_COLUMNS if name not in ("value", "tolerance")]
    return BaselineRow(value=value, tolerance=tolerance, **{name: cells[name] for name in names})
