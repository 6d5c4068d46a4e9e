"""The accepted tables with the record of who accepted them, when, why and from which code."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from ...errors import InputError
from ...files import read_text, write_text
from ...mending import mended_by
from ...provenance import sha256_text
from ...text_table import text_table
from ...yaml_text import read_mapping, write_yaml
from ..quantities import SCALARS, Noise
from ..tables import TABLES
from ..tables.made_from import PROVENANCE, read_made_from
from .histories import HISTORIES

SCHEMA_VERSION = 2
RECORD = "baseline.yaml"
WIDEST = 10.0  # times today's noise: more would hide a change of a model, whoever wrote it into the record

Cells = Mapping[str, str]


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
    """Accepted tables, as text by column, the noise that was declared for them, and their record."""

    tables: Mapping[str, tuple[Cells, ...]]
    noise: Mapping[str, Noise]
    acceptance: Acceptance

    @property
    def rows(self) -> int:
        """Number of rows of all tables."""
        return sum(map(len, self.tables.values()))


def todays_noise() -> dict[str, Noise]:
    """Return the noise of every scalar, as the code declares it."""
    return {quantity.name: quantity.noise for quantity in SCALARS}


def save_baseline(folder: Path | str, tables: Path | str, acceptance: Acceptance, histories: str = "") -> Baseline:
    """Write the tables as they are, thinned histories if any, and their record last: without one none loads."""
    place, source = Path(folder), Path(tables)
    texts = {name: read_text(source / f"{name}.csv") for name in TABLES}
    parsed = {name: _rows(text, source / f"{name}.csv") for name, text in texts.items()}
    record = {
        "schema_version": SCHEMA_VERSION,
        **asdict(acceptance),
        "noise": {name: [noise.relative, noise.absolute] for name, noise in todays_noise().items()},
        "tables": {name: {"rows": len(parsed[name]), "sha256": sha256_text(text)} for name, text in texts.items()},
    }
    for name, text in texts.items():
        write_text(place / f"{name}.csv", text)
    if histories:
        write_text(place / HISTORIES, histories)
        record["histories"] = {"sha256": sha256_text(histories)}
    write_yaml(place / RECORD, record)
    return Baseline(parsed, todays_noise(), acceptance)


def load_baseline(folder: Path | str) -> Baseline:
    """Read a baseline.

    Raises `InputError` where there is none, for another schema version, a table that is missing, empty or not that of
    the record, and a noise that would hide a change.
    """
    place = Path(folder)
    if not (place / RECORD).is_file():
        raise InputError(place / RECORD, "no such file", "a baseline; `tread-validate accept` makes one")
    with mended_by(f"git checkout {place}, or tread-validate accept"):
        return _load(place)


def _load(place: Path) -> Baseline:
    record = _record(place / RECORD)
    tables = {}
    for name, facts in record["tables"].items():
        path = place / f"{name}.csv"
        text = read_text(path)
        if not isinstance(facts, dict) or sha256_text(text) != facts.get("sha256"):
            raise InputError(path, "a table of another checksum", f"the one that {RECORD} was written for")
        tables[str(name)] = _rows(text, path)
        if len(tables[str(name)]) != facts.get("rows"):
            raise InputError(path, f"{len(tables[str(name)])} rows", f"{facts.get('rows')}, as {RECORD} says")
    if not tables.get("errors") or not tables.get("peaks"):
        raise InputError(place / RECORD, "no accepted runs and errors", "tables with rows")
    names = Acceptance.__dataclass_fields__
    acceptance = Acceptance(**{name: str(record[name]) for name in names})
    return Baseline(tables, _noise(record["noise"], place / RECORD), acceptance)


def same_study(baseline: Baseline, tables: Path | str) -> None:
    """Raise `InputError` where the tables are of another study than the baseline: nothing in them is comparable."""
    found = read_made_from(tables).study
    if found != baseline.acceptance.study:
        where = f"{Path(tables) / PROVENANCE}: study"
        raise InputError(where, found, f"{baseline.acceptance.study}, the study of the baseline")


def _record(path: Path) -> dict[str, Any]:
    record = read_mapping(path)
    if record.get("schema_version") != SCHEMA_VERSION:
        raise InputError(
            f"{path}: schema_version", record.get("schema_version"), f"{SCHEMA_VERSION}; accept a new baseline"
        )
    needed: Sequence[str] = (*Acceptance.__dataclass_fields__, "noise", "tables")
    for name in needed:
        if name not in record:
            raise InputError(f"{path}: {name}", "nothing", "a value")
    for name in ("noise", "tables"):
        if not isinstance(record[name], dict):
            raise InputError(f"{path}: {name}", type(record[name]).__name__, "a mapping of keys")
    return record


def _noise(data: Mapping[str, Any], path: Path) -> dict[str, Noise]:
    """Read the accepted noise; one beyond the bounds of any noise, or far from today's, is refused."""
    found = {}
    today = todays_noise()
    for name, values in data.items():
        where = f"{path}: noise.{name}"
        try:
            noise = Noise(*(float(value) for value in values))
        except (TypeError, ValueError) as error:
            raise InputError(where, values, f"a relative and an absolute noise ({error})") from None
        own = today.get(name, noise)
        if noise.relative > WIDEST * own.relative or noise.absolute > WIDEST * own.absolute:
            limits = f"{WIDEST * own.relative:g} and {WIDEST * own.absolute:g}"
            raise InputError(where, f"{noise.relative:g} and {noise.absolute:g}", f"at most {limits}")
        found[str(name)] = noise
    return found


def _rows(text: str, path: Path) -> tuple[Cells, ...]:
    return tuple(row for _, row in text_table(text, path).records())
