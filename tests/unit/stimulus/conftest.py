from __future__ import annotations

from pathlib import Path

import pytest

from tread_validate.study import Case, load_study

STUDY = Path(__file__).parents[3] / "config" / "study.yaml"


@pytest.fixture(scope="session")
def cases() -> tuple[Case, ...]:
    return load_study(STUDY).cases()


@pytest.fixture(scope="session")
def belt(cases) -> Case:
    return next(case for case in cases if case.path.family != "rig" and not case.free_rolling)


@pytest.fixture(scope="session")
def rig(cases) -> Case:
    return next(case for case in cases if case.path.family == "rig")
