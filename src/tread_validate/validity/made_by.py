"""Which code made the committed map, and whether that is the code of today."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..source_code import code_digest
from ..spring.variants import code_digest as model_digest
from ..yaml_text import read_mapping

RECORD = Path(__file__).resolve().parent / "map.yaml"


@cache
def record() -> dict[str, Any]:
    """Return what ``map.yaml`` beside the committed table says; empty where there is none."""
    return dict(read_mapping(RECORD)) if RECORD.is_file() else {}


@cache
def made_by_other_code(model: str) -> str:
    """Return, in words, what has changed since the committed map was made: the model, the engine; empty where nothing.

    A model that the map does not know has no points either, and nothing is said of it.
    """
    made, changed = record(), []
    known = made.get("models_code", {})
    if model not in known:
        return ""
    try:
        if model_digest(model) != known[model]:
            changed.append("the model")
    except InputError:
        changed.append("the model")
    if code_digest("fe") != made.get("engine_code"):
        changed.append("the engine")
    return f"{' and '.join(changed)} changed since the map was made" if changed else ""
