"""Reading and writing case files, and their JSON schema."""

from __future__ import annotations

import json
from pathlib import Path

from pydantic import ValidationError

from ..files import read_text, write_text
from ..model_file import first_fault
from ..yaml_text import load_yaml
from .document import CaseFile


def write_case(path: Path | str, document: CaseFile) -> None:
    """Write a case file, atomically."""
    write_text(path, case_json(document))


def case_json(document: CaseFile) -> str:
    """Return the JSON text; lists of numbers stand on one line each."""
    return _text(document.model_dump(mode="json"), 0) + "\n"


def read_case(path: Path | str) -> CaseFile:
    """Read a case file; raises `InputError` for what is none."""
    text = read_text(path)
    try:
        return CaseFile.model_validate_json(text)
    except ValidationError as error:
        raise first_fault(error, path, load_yaml(text, path)) from None


def case_schema() -> str:
    """Return the JSON schema of a case file as text, keys in order, one final newline."""
    schema = CaseFile.model_json_schema(mode="serialization")
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    schema["title"] = "tread_validate case"
    return json.dumps(schema, indent=2, sort_keys=True, ensure_ascii=False) + "\n"


def _text(value: object, depth: int) -> str:
    """Return JSON that a reader can find his way in: mappings over several lines, arrays of numbers on one."""
    pad, inner = "  " * depth, "  " * (depth + 1)
    if isinstance(value, dict) and value:
        rows = [f"{inner}{json.dumps(key)}: {_text(item, depth + 1)}" for key, item in value.items()]
        return "{\n" + ",\n".join(rows) + f"\n{pad}}}"
    if isinstance(value, list) and value and isinstance(value[0], list | dict):
        return "[\n" + ",\n".join(inner + _text(item, depth + 1) for item in value) + f"\n{pad}]"
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
