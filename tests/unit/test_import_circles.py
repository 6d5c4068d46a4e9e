"""No module of the parts that a study is made of imports itself by a detour, not even inside a function."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "src" / "tread_validate"


def imports(package: str) -> dict[str, set[str]]:
    """Return for every module of a package the modules that it imports at run time, late ones too."""
    found: dict[str, set[str]] = {}
    for file in (PACKAGE / package).rglob("*.py"):
        parts = list(file.relative_to(PACKAGE).with_suffix("").parts)
        name = ".".join(parts).removesuffix(".__init__")
        own = parts[:-1]
        tree = ast.parse(file.read_text(encoding="utf-8"))
        typing_only = {
            id(inner)
            for node in ast.walk(tree)
            if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING"
            for inner in ast.walk(node)
        }
        targets = found.setdefault(name, set())
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.level and id(node) not in typing_only:
                base = own[: len(own) - node.level + 1] + (node.module.split(".") if node.module else [])
                for alias in node.names:
                    module = [*base, alias.name]
                    targets.add(".".join(module if PACKAGE.joinpath(*module).with_suffix(".py").is_file() else base))
    return found


@pytest.mark.parametrize("package", ["friction", "geometry", "study"])
def test_imports_have_one_direction(package):
    graph = imports(package)
    assert len(graph) > 5

    def reached(start: str) -> set[str]:
        seen: set[str] = set()
        waiting = [start]
        while waiting:
            for target in graph.get(waiting.pop(), set()) - seen:
                seen.add(target)
                waiting.append(target)
        return seen

    assert [name for name in graph if name in reached(name)] == []
