"""Cases for the spring model's unit tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from tread_validate.study import Case, load_study


@pytest.fixture(scope="session")
def cases(paper_study: Path) -> dict[str, Case]:
    """Every case of the paper's study by its id, free-rolling ones unresolved."""
    return {case.case_id: case for case in load_study(paper_study).cases()}
