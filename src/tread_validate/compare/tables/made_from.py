"""What tables were made from, as it stands beside them."""

from __future__ import annotations

import json
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field

from ...errors import InputError
from ...files import read_text
from ...model_file import as_model

PROVENANCE = "provenance.json"


class MadeFrom(BaseModel):
    """Study, code, inputs and sources of a set of tables; keys of other versions are left aside.

    Attributes
    ----------
    study, study_digest, commit, version : str
    code : mapping of str to str
        Digests of the parts of the code, ``compare`` among them.
    packages, inputs, tables : mapping of str to str
        Versions by package, SHA-256 by input file and by table.
    sources : mapping of str to mapping of str to int
        Number of runs by source and status.
    """

    model_config = ConfigDict(frozen=True, extra="ignore")

    study: str
    study_digest: str = "unknown"
    commit: str = "unknown"
    version: str = "unknown"
    code: dict[str, str]
    packages: dict[str, str] = Field(default_factory=dict)
    inputs: dict[str, str] = Field(default_factory=dict)
    sources: dict[str, dict[str, int]] = Field(default_factory=dict)
    tables: dict[str, str]


def read_made_from(tables: Path | str) -> MadeFrom:
    """Read what a folder of tables was made from; raises `InputError` where it does not say."""
    file = Path(tables) / PROVENANCE
    try:
        data = json.loads(read_text(file))
    except ValueError as error:
        raise InputError(file, error, "JSON") from None
    if not isinstance(data, dict) or not {"study", "code", "tables"} <= set(data):
        raise InputError(file, "an older format", "study, code and digests of the tables")
    return as_model(data, MadeFrom, file)
