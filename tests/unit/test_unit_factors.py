"""Factors between units stand in one place."""

from __future__ import annotations

import ast
from pathlib import Path

import tread_validate

PACKAGE = Path(tread_validate.__file__).parent
FACTORS = {1e3, 1e-3, 1e6, 1e-6}
SHARES = {  # small shares of a quantity's own size, by function: tolerances, not units
    "deck/inputs.py:closing_of_gap",
    "fe/relaxation.py:_merge_slow",
    "material/fit.py:_fit",
    "material/master.py:_determined",
    "spring/condensed/roll.py:step_times",
    "spring/slip.py:slip_stage",
}


def literal_factors() -> set[str]:
    """Return ``module:function`` of every product or quotient with a thousand or a million, up or down.

    A comparison is left out: there such a number is a tolerance.
    """
    found = set()
    for file in PACKAGE.rglob("*.py"):
        name = file.relative_to(PACKAGE).as_posix()
        if name != "units.py" and not name.startswith("models/skeleton"):
            found |= {f"{name}:{function}" for function in _functions(ast.parse(file.read_text("utf-8")), "module")}
    return found


def _functions(node: ast.AST, function: str) -> set[str]:
    found = set()
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Compare):
            continue
        if isinstance(child, ast.BinOp) and isinstance(child.op, ast.Mult | ast.Div):
            sides = (child.left, child.right)
            if any(isinstance(side, ast.Constant) and side.value in FACTORS for side in sides):
                found.add(function)
        found |= _functions(child, child.name if isinstance(child, ast.FunctionDef) else function)
    return found


def test_units_are_converted_by_named_factors() -> None:
    assert literal_factors() == SHARES
