"""The delta as CSV, Markdown and JUnit XML, for people and for CI systems."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from typing import Any
from xml.etree import ElementTree as ET

from ..tables.text import cell, table_text
from .delta import DELTA_COLUMNS, Delta
from .store import Acceptance

SHOWN = 40
XML_ILLEGAL = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def delta_csv(rows: Sequence[Delta]) -> str:
    """Return the rows that moved at all or fail, furthest out first; a table without rows means nothing moved."""
    kept = (row for row in rows if not row.passed or (row.change is not None and row.change != 0.0))
    return table_text(DELTA_COLUMNS, map(_cells, kept))


def summary(rows: Sequence[Delta]) -> str:
    """Return one sentence on the outcome."""
    failed = [row for row in rows if not row.passed]
    if not failed:
        moved = sum(row.change not in (None, 0.0) for row in rows)
        return f"{len(rows)} rows, all within tolerance of the baseline ({moved} moved at all)"
    counts = Counter(row.outcome for row in failed)
    listed = ", ".join(f"{count} {outcome}" for outcome, count in sorted(counts.items()))
    return f"{len(failed)} of {len(rows)} rows fail: {listed}"


def delta_markdown(rows: Sequence[Delta], acceptance: Acceptance, shown: int = SHOWN) -> str:
    """Return a page with the summary and the failing rows, furthest out first."""
    failed = [row for row in rows if not row.passed]
    lines = [
        "# Change since the accepted baseline",
        "",
        f"{summary(rows)}.",
        "",
        f"Baseline of {_escaped(acceptance.when)} by {_escaped(acceptance.who)}, code {_escaped(acceptance.commit)}: "
        f"{_escaped(acceptance.reason)}",
        "",
    ]
    if failed:
        lines += [
            "| outcome | source | case | quantity | baseline | now | change | unit | times tolerance | note |",
            "|---|---|---|---|---:|---:|---:|---|---:|---|",
        ]
        lines += ["| " + " | ".join(map(_escaped, _markdown_cells(row))) + " |" for row in failed[:shown]]
        if len(failed) > shown:
            lines += ["", f"... and {len(failed) - shown} more rows."]
    return "\n".join(lines).rstrip() + "\n"


def delta_junit(rows: Sequence[Delta]) -> str:
    """Return JUnit XML: a suite for each kind of row, a test case for each row."""
    root = ET.Element("testsuites", name="tread-validate check")
    root.set("tests", str(len(rows)))
    root.set("failures", str(sum(not row.passed for row in rows)))
    for kind in dict.fromkeys(row.kind for row in rows):
        members = [row for row in rows if row.kind == kind]
        suite = ET.SubElement(root, "testsuite", name=_legal(kind), tests=str(len(members)))
        suite.set("failures", str(sum(not row.passed for row in members)))
        for row in members:
            case = ET.SubElement(suite, "testcase", classname=_legal(f"{kind}.{row.source}"), name=_legal(row.name))
            if not row.passed:
                before, now = cell(row.baseline) or "nothing", cell(row.current) or "nothing"
                words = f"{row.outcome}: baseline {before}, now {now} {row.unit}".strip()
                failure = ET.SubElement(case, "failure", type=row.outcome, message=_legal(words))
                failure.text = _legal(f"change {cell(row.change)}, tolerance {cell(row.tolerance)}; {row.note}")
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def delta_lines(rows: Sequence[Delta], shown: int = 20) -> Iterable[str]:
    """Yield the failing rows as lines for a terminal, furthest out first."""
    failed = [row for row in rows if not row.passed]
    for row in failed[:shown]:
        change = "" if row.change is None else f" {cell(row.baseline)} -> {cell(row.current)} {row.unit}"
        times = "" if row.change is None else f", {row.times_tolerance:.3g} times the tolerance"
        yield f"{row.outcome}: {row.name}:{change}{times}{' (' + row.note + ')' if row.note else ''}"
    if len(failed) > shown:
        yield f"... and {len(failed) - shown} more"


def _cells(row: Delta) -> dict[str, Any]:
    return {**asdict(row), "passed": row.passed}


def _markdown_cells(row: Delta) -> list[str]:
    quantity = row.quantity if row.metric in ("scalar", "claim", "coefficient") else f"{row.quantity}, {row.metric}"
    times = "" if row.change is None else f"{row.times_tolerance:.3g}"
    return [
        row.outcome, row.source, row.case_id, quantity, cell(row.baseline), cell(row.current), cell(row.change),
        row.unit, times, row.note,
    ]  # fmt: skip


def _escaped(text: str) -> str:
    return " ".join(re.sub(r"([\\`*_{}\[\]<>|#!])", r"\\\1", text).split())


def _legal(text: str) -> str:
    return XML_ILLEGAL.sub("?", text)
