"""The page of equations names functions that exist, and they say which equation they are."""

from __future__ import annotations

import inspect
import re
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "equations.md").read_text(encoding="utf-8")
NAME = re.compile(r"`(tread_validate(?:\.\w+)+)`")
NUMBERED = [
    (int(number), name)
    for number, code in re.findall(r"^\| \((\d+)\) \|.*\| ([^|]*) \|$", PAGE, re.MULTILINE)
    for name in NAME.findall(code)
]


def resolved(name: str) -> tuple[object, object]:
    """Return the module and the object of a dotted name."""
    parts = name.split(".")
    for end in range(len(parts), 0, -1):
        try:
            module = import_module(".".join(parts[:end]))
        except ModuleNotFoundError as error:
            if error.name is None or not name.startswith(error.name):
                raise
            continue
        found: object = module
        for part in parts[end:]:
            found = getattr(found, part)
        return module, found
    raise AssertionError(name)


@pytest.mark.parametrize("name", sorted(set(NAME.findall(PAGE))))
def test_every_name_on_the_page_exists(name):
    module, found = resolved(name)
    assert found is not module or inspect.ismodule(found)


def test_every_numbered_equation_of_the_paper_has_its_row():
    assert {number for number, _ in NUMBERED} == set(range(1, 14))


@pytest.mark.parametrize(("number", "name"), NUMBERED)
def test_what_stands_for_a_numbered_equation_says_so(number, name):
    """In its own docstring, its class's or its module's: "Eq. (5)" or "Eqs. (6) and (7)"."""
    module, found = resolved(name)
    owner = getattr(module, name.removeprefix(f"{module.__name__}.").split(".")[0], None)
    texts = [inspect.getdoc(item) or "" for item in (found, owner, module)]
    assert any(re.search(rf"Eqs?\. [^.;]*\({number}\)", text) for text in texts), f"{name}: no Eq. ({number})"


def test_every_citation_of_the_paper_s_equations_is_on_the_page():
    """A docstring that cites a number which the paper does not have would mislead."""
    for path in (ROOT / "src").rglob("*.py"):
        for cited in re.findall(r"Eqs?\. \((\d+)\)", path.read_text(encoding="utf-8")):
            assert 1 <= int(cited) <= 13, path


def test_symbols_of_the_equations_are_in_the_glossary():
    glossary = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
    symbols = (
        "mu_k",
        "mu_s",
        "tau_i",
        "E_inf",
        "a_v",
        "a_theta",
        "lambda",
        "delta",
        "gamma",
        "phi",
        "theta",
        "F_r",
        "k_l",
    )
    for symbol in symbols:
        assert symbol in PAGE
        assert re.search(rf"\| [^|]*\b{re.escape(symbol)}\b[^|]*\|", glossary), symbol
