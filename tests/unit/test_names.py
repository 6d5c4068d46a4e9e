"""One name, one thing: no two classes of the package have the same name."""

from __future__ import annotations

import ast
from collections import defaultdict
from pathlib import Path

import tread_validate

PACKAGE = Path(tread_validate.__file__).parent
TEMPLATES = "models/skeleton"  # what a user's own model starts from


def test_a_class_name_stands_for_one_class() -> None:
    places: defaultdict[str, list[str]] = defaultdict(list)
    for file in PACKAGE.rglob("*.py"):
        name = file.relative_to(PACKAGE).as_posix()
        if not name.startswith(TEMPLATES):
            for node in ast.parse(file.read_text("utf-8")).body:
                if isinstance(node, ast.ClassDef):
                    places[node.name].append(name)
    assert len(places) > 300
    assert {name: files for name, files in places.items() if len(files) > 1} == {}
