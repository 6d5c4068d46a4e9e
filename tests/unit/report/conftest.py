"""A made-up study with its tables and histories, and the report built from it once."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from tread_validate.compare.summary import write_summary
from tread_validate.report import build_report


@pytest.fixture(scope="session")
def made_up() -> ModuleType:
    """Load the fabricator, which lies above the test folders."""
    source = Path(__file__).parents[2] / "fabricated_report.py"
    spec = importlib.util.spec_from_file_location("fabricated_report", source)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def inputs(made_up: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Write the made-up inputs."""
    found = made_up.fabricate(tmp_path_factory.mktemp("report") / "in")
    write_summary(found.tables, "made-up")
    return found


@pytest.fixture(scope="session")
def built(inputs: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Build the report and return its folder."""
    out = tmp_path_factory.mktemp("built")
    build_report(inputs.study, inputs.tables, inputs.spring, inputs.reference, inputs.decks, out)
    return out
