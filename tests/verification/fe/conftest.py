"""The helpers of this folder as one fixture."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest


def _load(name: str) -> ModuleType:
    if name not in sys.modules:
        spec = importlib.util.spec_from_file_location(name, Path(__file__).parent / f"{name}.py")
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[name] = module
        spec.loader.exec_module(module)
    return sys.modules[name]


@pytest.fixture(scope="session")
def fe() -> ModuleType:
    """The helpers in fe_decks.py."""
    return _load("fe_decks")


@pytest.fixture(scope="session")
def condensed() -> ModuleType:
    """The quasi-static solver in condensed_solver.py."""
    return _load("condensed_solver")
