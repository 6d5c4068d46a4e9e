"""The JSON schema made from the models accepts the paper's study."""

from __future__ import annotations

import json

import jsonschema
import yaml

from tread_validate.study.schema import study_schema


def test_schema_accepts_the_paper_study_and_refuses_a_misspelt_key(paper_study):
    schema = json.loads(study_schema())
    data = yaml.safe_load(paper_study.read_text(encoding="utf-8"))
    validator = jsonschema.Draft202012Validator(schema)
    assert list(validator.iter_errors(data)) == []
    data["blocks"]["rectangle"]["lenght_mm"] = 25.0
    assert list(validator.iter_errors(data)) != []
