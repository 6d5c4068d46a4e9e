"""Fixtures that several folders of tests share."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

# as the command line does: small matrices, and the tests run side by side
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def root() -> Path:
    """The project's top folder."""
    return ROOT


@pytest.fixture(scope="session")
def paper_study() -> Path:
    """The study of the paper."""
    return ROOT / "config" / "study.yaml"


@pytest.fixture
def altered_study(tmp_path: Path, paper_study: Path) -> Callable[..., Path]:
    """Write the paper's study with some keys changed: ``altered_study({"blocks.rectangle.length_mm": 30})``.

    A value of `...` removes the key. The file is written into a folder of its own, with links to the data files.
    """

    def write(changes: dict[str, Any], name: str = "study.yaml") -> Path:
        data = yaml.safe_load(paper_study.read_text(encoding="utf-8"))
        for dotted, value in changes.items():
            *parents, last = [int(part) if part.isdigit() else part for part in dotted.split(".")]
            place = data
            for part in parents:
                place = place[part]
            if value is ...:
                del place[last]
            else:
                place[last] = value
        folder = tmp_path / "config"
        folder.mkdir(exist_ok=True)
        link = tmp_path / "reference_data"
        if not link.exists():
            link.symlink_to(ROOT / "reference_data")
        target = folder / name
        target.write_text(yaml.safe_dump(data, sort_keys=False), encoding="utf-8")
        return target

    return write
