"""Bring the figures printed in README.md and docs/ in step with the accepted baseline.

A figure that comes from the pipeline stands between two comments, which a reader does not see:

    <!--= ensemble all/spring:paper/fe:embedded/peak_normal_force/scalar mean_abs_error percent1 -->41.5 %<!--/-->

The comment names a table of `reports/liu2010/baseline/` (`hierarchy.`: one of `reference_data/hierarchy/liu2010/`), the
key of a row (in the order of the table's key columns, `-` for a space), a column and a format.

Usage: python docs/printed_figures.py [--check]. Without --check the figures are written anew; with it a figure that
disagrees is named and the exit code is 1. A test runs the check.
"""

from __future__ import annotations

import csv
import re
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from tread_validate.compare.baseline.store import load_baseline
from tread_validate.compare.tables import TABLES
from tread_validate.files import read_text, write_text

ROOT = Path(__file__).resolve().parents[1]
STUDY = "liu2010"
MARKED = re.compile(r"<!--= (?P<what>[^>]*?) -->(?P<text>.*?)<!--/-->")
GRADES = ("excellent", "good", "fair", "poor")
FORMATS: dict[str, Callable[[float], str]] = {
    "percent0": lambda value: f"{100 * value:.0f} %",
    "percent1": lambda value: f"{100 * value:.1f} %",
    "abspercent1": lambda value: f"{abs(100 * value):.1f} %",
    "percent2": lambda value: f"{100 * value:.2f} %",
    "percentage2": lambda value: f"{value:.2f} %",
    "hundredths1": lambda value: f"{100 * value:.1f}",
    "hundredths2": lambda value: f"{100 * value:.2f}",
    "newton0": lambda value: f"{value:.0f} N",
    "newton1": lambda value: f"{value:.1f} N",
    "ms": lambda value: f"{1e3 * value:.2g} ms" if value < 0.1 else f"{1e3 * value:.0f} ms",
    "two": lambda value: f"{value:.2f}",
    "three": lambda value: f"{value:.3f}",
    "yes": lambda value: "yes" if value else "no",
    "p": lambda value: f"{value:.2g}",
}


@dataclass(frozen=True)
class Figure:
    """A marked figure: where it stands, what it says and what it should say."""

    path: Path
    line: int
    printed: str
    expected: str


def value_of(what: str) -> str:
    """Return the text of a figure; raises `KeyError` for a table, row, column or format that is none."""
    table, *rest = what.split(" ")
    if table == "grades":
        source, quantity = rest
        return _grades(source, quantity)
    if table == "assessments":
        source, quantity, assessment = rest
        return str(_assessments(source, quantity)[assessment.replace("-", " ")])
    key, column, shape = rest
    if table.startswith("hierarchy."):
        row = _hierarchy(table.removeprefix("hierarchy."))[key]
    else:
        names = TABLES[table].key
        row = {_key(cells[name] for name in names): cells for cells in _baseline()[table]}[key]
    return FORMATS[shape](float(row[column]))


@cache
def _baseline() -> dict[str, tuple[dict[str, str], ...]]:
    loaded = load_baseline(ROOT / "reports" / STUDY / "baseline")
    return {name: tuple(map(dict, rows)) for name, rows in loaded.tables.items()}


@cache
def _hierarchy(name: str) -> dict[str, dict[str, str]]:
    text = read_text(ROOT / "reference_data" / "hierarchy" / STUDY / f"{name}.csv")
    rows = list(csv.DictReader(text.splitlines()))
    return {_key((row["level"], row.get("group") or row["figure"])): row for row in rows}


def _key(parts: Iterable[str]) -> str:
    return "/".join(parts).replace(" ", "-")


def _errors(source: str, quantity: str, metric: str) -> Iterator[dict[str, str]]:
    wanted = (source, "fe:embedded", quantity, metric)
    for row in _baseline()["errors"]:
        if tuple(row[name] for name in ("predicted_source", "reference_source", "quantity", "metric")) == wanted:
            yield row


def _grades(source: str, quantity: str) -> str:
    counts = Counter(row["grade"] for row in _errors(source, quantity, "iso18571_r"))
    return ", ".join(f"{counts[grade]} {grade}" for grade in GRADES if counts[grade])


def _assessments(source: str, quantity: str) -> Counter[str]:
    return Counter(row["assessment"] for row in _errors(source, quantity, "scalar"))


def pages() -> list[Path]:
    """Return the pages that may print figures of the pipeline."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def figures(path: Path) -> list[Figure]:
    """Return the marked figures of a page."""
    found = []
    for number, line in enumerate(read_text(path).splitlines(), start=1):
        for match in MARKED.finditer(line):
            found.append(Figure(path, number, match["text"], value_of(match["what"])))
    return found


def rewrite(text: str) -> str:
    """Return a page with every marked figure as the tables have it."""
    return MARKED.sub(lambda match: f"<!--= {match['what']} -->{value_of(match['what'])}<!--/-->", text)


def main(arguments: list[str]) -> int:
    """Write or check the figures of every page."""
    wrong = [item for path in pages() for item in figures(path) if item.printed != item.expected]
    for item in wrong:
        print(f"{item.path.relative_to(ROOT)}:{item.line}: {item.printed}, the baseline has {item.expected}")
    if "--check" in arguments:
        return 1 if wrong else 0
    for path in {item.path for item in wrong}:
        write_text(path, rewrite(read_text(path)))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
