"""The figures that README and guide print are those of the accepted baseline."""

from __future__ import annotations

import importlib.util
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def printed() -> ModuleType:
    """Load the tool, which lies beside the pages."""
    spec = importlib.util.spec_from_file_location("printed_figures", ROOT / "docs" / "printed_figures.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


def test_every_marked_figure_is_that_of_the_baseline(printed: ModuleType) -> None:
    """Forty and more figures, each with its table, row and column; `python docs/printed_figures.py` writes them."""
    found = [item for path in printed.pages() for item in printed.figures(path)]
    assert len(found) > 40
    wrong = [f"{item.path.name}:{item.line}: {item.printed} for {item.expected}" for item in found]
    assert [text for text, item in zip(wrong, found, strict=True) if item.printed != item.expected] == []


def test_the_results_that_the_readme_prints_are_all_marked(printed: ModuleType) -> None:
    """No digit in a cell of the two tables of results but inside a mark: a number cannot be typed in beside them."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    lines = [line for line in text.splitlines() if line.startswith("|") and "<!--=" in line]
    assert len(lines) == 8
    for line in lines:
        cells = printed.MARKED.sub("", line).split("|")[2:]
        assert re.findall(r"[0-9]", "".join(cells)) == [], line


def test_a_figure_that_disagrees_is_found(printed: ModuleType, tmp_path: Path) -> None:
    """One digit changed by hand: named with line, what is printed and what the baseline has; writing mends it."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    first = printed.MARKED.search(text)
    assert first is not None
    spoilt = text.replace(first.group(0), first.group(0).replace(first["text"], "9.9 %"), 1)
    page = tmp_path / "page.md"
    page.write_text(spoilt, encoding="utf-8")
    (wrong,) = [item for item in printed.figures(page) if item.printed != item.expected]
    assert (wrong.printed, wrong.expected) == ("9.9 %", first["text"])
    assert printed.rewrite(spoilt) == text


@pytest.mark.parametrize("what", ["ensemble nobody mean_abs_error percent1", "nothing a b c", "cases a speed_m_s odd"])
def test_a_figure_of_nothing_is_an_error(printed: ModuleType, what: str) -> None:
    """A table, row or format that is none."""
    with pytest.raises(KeyError):
        printed.value_of(what)
