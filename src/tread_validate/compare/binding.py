"""Are tables those of today's study and code?"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import read_text
from ..source_code import code_digest
from ..study import LoadedStudy

PROVENANCE = "provenance.json"


def read_provenance(tables: Path) -> dict[str, Any]:
    """Return what tables were made from; raises `InputError` where they do not say."""
    file = tables / PROVENANCE
    try:
        data = json.loads(read_text(file))
    except ValueError as error:
        raise InputError(file, error, "JSON (make the tables anew: tread-validate tables)") from None
    if not isinstance(data, dict) or not isinstance(data.get("code"), dict) or not isinstance(data.get("study"), str):
        raise InputError(file, "an older format", "study and code (make the tables anew: tread-validate tables)")
    return data


def todays_tables(tables: Path, study: LoadedStudy | None = None) -> Mapping[str, Any]:
    """Return the provenance of tables that today's comparison made, of this state of the study where one is given.

    Raises
    ------
    InputError
        Tables of another study, of another state of it, or made by other code.
    """
    data = read_provenance(tables)
    file = tables / PROVENANCE
    today = code_digest("compare")
    made_by = str(data["code"].get("compare"))
    if made_by != today:
        raise InputError(
            f"{file}: code of the comparison", made_by, f"{today} (run: make check, or tread-validate tables)"
        )
    if study is not None:
        for key, mine in (("study", study.model.name), ("study_digest", study.digest)):
            if data.get(key) != mine:
                found = str(data.get(key))[:16]
                raise InputError(
                    f"{file}: {key}", found, f"{mine[:16]}, that of {study.source} (tread-validate tables)"
                )
    return data
