"""Bars of size: a reader holds a module and a function in his head. Compiled kernels are excepted, by decorator."""

from __future__ import annotations

import ast
import json
import statistics
import subprocess
import sys
from functools import cache
from pathlib import Path

MODULE_LINES = 300
MEDIAN_LINES = 130
FUNCTION_LINES = 80
COMPLEXITY = 15
SNAKEFILE_LINES = 40
ELEMENT_KERNELS = {"fe/element_kernel.py", "fe/element_full_kernel.py"}  # one compiled loop each; split, it was slower
COMPILED = {"kernel", "intrinsic"}


@cache
def trees(root: Path) -> dict[str, tuple[int, ast.Module]]:
    """Return lines and syntax tree of every module, by its path in the package."""
    package = root / "src" / "tread_validate"
    texts = {path.relative_to(package).as_posix(): path.read_text("utf-8") for path in package.rglob("*.py")}
    assert len(texts) > 300
    return {name: (text.count("\n"), ast.parse(text)) for name, text in texts.items()}


def compiled(function: ast.AST) -> bool:
    """Whether Numba compiles the function."""
    found = [node.func if isinstance(node, ast.Call) else node for node in getattr(function, "decorator_list", ())]
    return any(isinstance(node, ast.Name) and node.id in COMPILED for node in found)


def test_modules_are_short(root: Path) -> None:
    lengths = {name: lines for name, (lines, _) in trees(root).items()}
    assert {name for name, lines in lengths.items() if lines > MODULE_LINES} <= ELEMENT_KERNELS
    assert statistics.median(lengths.values()) < MEDIAN_LINES
    assert len((root / "Snakefile").read_text("utf-8").splitlines()) < SNAKEFILE_LINES


def test_functions_are_short(root: Path) -> None:
    long = [
        f"{name}: {node.name}, {node.end_lineno - node.lineno + 1} lines"
        for name, (_, tree) in trees(root).items()
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef) and node.end_lineno is not None
        if node.end_lineno - node.lineno + 1 > FUNCTION_LINES and not compiled(node)
    ]
    assert long == []


def test_functions_have_few_branches(root: Path) -> None:
    """McCabe's complexity as Ruff counts it."""
    done = subprocess.run(
        [sys.executable, "-m", "ruff", "check", "src", "--isolated", "--no-cache", "--ignore-noqa", "--output-format",
         "json", "--select", "C901", "--config", f"lint.mccabe.max-complexity={COMPLEXITY}"],
        cwd=root, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode in (0, 1), done.stderr
    package, wrong = root / "src" / "tread_validate", []
    for found in json.loads(done.stdout):
        name = Path(found["filename"]).relative_to(package).as_posix()
        at = found["location"]["row"]
        (function,) = (
            node for node in ast.walk(trees(root)[name][1]) if isinstance(node, ast.FunctionDef) and node.lineno == at
        )
        if not compiled(function):
            wrong.append(f"{name}: {found['message']}")
    assert wrong == []
