"""The reference of the study file follows the models."""

from __future__ import annotations

import re

from tread_validate.study import Block, Huemer, Study
from tread_validate.study.reference_page import study_reference
from tread_validate.study.run import Run


def test_every_key_of_the_models_is_on_the_page():
    page = study_reference()
    for model in (Study, Run, Block, Huemer):
        for key in model.model_fields:
            assert f"| `{key}` |" in page


def test_every_link_on_the_page_has_its_section():
    page = study_reference()
    sections = {title.lower() for title in re.findall(r"^## `(\w+)`$", page, re.MULTILINE)}
    assert set(re.findall(r"\(#(\w+)\)", page)) <= sections


def test_ranges_and_defaults_are_said():
    page = study_reference()
    assert "| `poissons_ratio` | number (> 0, < 0.5) | `0.47` |" in page
    assert "| `creep_percent` | `free_rolling` or number (> -20, < 20)" in page
