"""The study's JSON schema, generated from the models."""

from __future__ import annotations

import json

from .document import Study


def study_schema() -> str:
    """Return the JSON schema of a study file as text, keys in order, one final newline."""
    schema = Study.model_json_schema()
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    schema["title"] = "tread_validate study"
    return json.dumps(schema, indent=2, sort_keys=True, ensure_ascii=False) + "\n"
