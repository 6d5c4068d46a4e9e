"""No module of the package imports itself by a detour, not inside a function and not for its types alone."""

from __future__ import annotations

import ast
from functools import cache
from pathlib import Path

import tread_validate

PACKAGE = Path(tread_validate.__file__).parent
OTHERS = ("models/skeleton", "reference/abaqus/scripts")  # run outside the package


@cache
def imports() -> dict[str, frozenset[str]]:
    """Return for every module the modules that it imports anywhere in its text."""
    found = {}
    for file in PACKAGE.rglob("*.py"):
        name = file.relative_to(PACKAGE).as_posix()
        if not name.startswith(OTHERS):
            parts = name.removesuffix(".py").split("/")
            module = parts[:-1] if parts[-1] == "__init__" else parts
            found[".".join(module)] = frozenset(_targets(ast.parse(file.read_text("utf-8")), parts[:-1]))
    return found


def _targets(tree: ast.Module, folder: list[str]) -> set[str]:
    targets = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = folder[: len(folder) - node.level + 1] + (node.module.split(".") if node.module else [])
            for alias in node.names:
                place = PACKAGE.joinpath(*base, alias.name)
                is_module = place.with_suffix(".py").is_file() or (place / "__init__.py").is_file()
                targets.add(".".join([*base, alias.name] if is_module else base))
    return targets


def test_imports_have_one_direction() -> None:
    graph = imports()
    assert len(graph) > 400

    def reached(start: str) -> set[str]:
        seen: set[str] = set()
        waiting = [start]
        while waiting:
            for target in graph.get(waiting.pop(), frozenset()) - seen:
                seen.add(target)
                waiting.append(target)
        return seen

    assert [name for name in graph if name in reached(name)] == []
