"""Are tables those of today's study and code, and as they were written?"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError
from ..files import write_text
from ..mending import mended_by
from ..provenance import sha256_file
from ..source_code import code_digest
from .tables.made_from import PROVENANCE, MadeFrom, read_made_from

if TYPE_CHECKING:
    from ..study import LoadedStudy

LATER = ("delta.csv",)
"""Written beside the tables by `check`, from them."""


def write_provenance(tables: Path, facts: Mapping[str, Any]) -> None:
    """Write what tables were made from, with the digest of each of them; they are all there by now."""
    digests = {path.stem: sha256_file(path) for path in sorted(tables.glob("*.csv")) if path.name not in LATER}
    write_text(tables / PROVENANCE, json.dumps({**facts, "tables": digests}, indent=2, sort_keys=True) + "\n")


def todays_tables(tables: Path, study: LoadedStudy | None = None) -> MadeFrom:
    """Return the provenance of tables that today's comparison made, of this state of the study where one is given.

    Raises
    ------
    InputError
        Tables of another study, of another state of it, made by other code, or altered since they were written.
    """
    with mended_by(f"tread-validate tables {'STUDY' if study is None else study.source}"):
        return _checked(tables, study)


def _checked(tables: Path, study: LoadedStudy | None) -> MadeFrom:
    data = read_made_from(tables)
    file = tables / PROVENANCE
    today = code_digest("compare")
    made_by = str(data.code.get("compare"))
    if made_by != today:
        raise InputError(f"{file}: code of the comparison", made_by, today)
    if study is not None:
        for key, found, mine in (
            ("study", data.study, study.model.name),
            ("study_digest", data.study_digest, study.digest),
        ):
            if found != mine:
                raise InputError(f"{file}: {key}", found[:16], f"{mine[:16]}, that of {study.source}")
    for name, digest in data.tables.items():
        table = tables / f"{name}.csv"
        found = sha256_file(table) if table.is_file() else "no file"
        if found != digest:
            raise InputError(table, found[:16], f"{digest[:16]}, the digest that it was written with")
    return data
