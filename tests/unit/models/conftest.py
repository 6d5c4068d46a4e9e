"""A study with four rig cases and a model of one's own in it."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from tread_validate.models.outcome import RunOutcome
from tread_validate.models.run import run_model
from tread_validate.models.skeleton import skeleton
from tread_validate.spring import resolve_creep
from tread_validate.study import load_study

MODEL = {"description": "a model under test", "origin": "the tests"}


@pytest.fixture
def study_with(tmp_path: Path) -> Callable[..., Path]:
    """Write a study whose model `mine` has these keys."""

    def write(**keys: Any) -> Path:
        data = yaml.safe_load(skeleton("mine", "python")["study.yaml"])
        data["models"] = {"mine": {**MODEL, **keys}}
        path = tmp_path / "study.yaml"
        path.write_text(yaml.safe_dump(data, sort_keys=False))
        return path

    return write


@pytest.fixture
def run_script(tmp_path: Path, study_with: Callable[..., Path]) -> Callable[..., tuple[RunOutcome, ...]]:
    """Run Python source as a command model over the first cases of the study."""

    def run(
        source: str,
        cases: int = 2,
        placeholders: str = "{case} {history}",
        script: str = "mine.py",
        **keys: Any,
    ) -> tuple[RunOutcome, ...]:
        (tmp_path / "mine.py").write_text(source)
        path = study_with(kind="command", command=f"{sys.executable} {script} {placeholders}", **keys)
        study = load_study(path)
        return run_model(study, "mine", resolve_creep(study.cases()[:cases]), tmp_path / "out", trusted=True)

    return run
