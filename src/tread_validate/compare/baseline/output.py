"""The change since the baseline as CSV, Markdown and JUnit XML, for people and for CI systems."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from xml.etree import ElementTree as ET

from ..tables import Delta, cell, rows_text
from .delta import Check
from .movement import Movement
from .store import Acceptance

FLIPS_SHOWN, ROWS_SHOWN, MODELS_SHOWN = 8, 10, 16
XML_ILLEGAL = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
KINDS = {
    "flip": "assessment flipped",
    "rule": "rule changed",
    "input": "input changed",
    "run": "moved",
    "consequence": "follows",
}


def delta_csv(check: Check) -> str:
    """Return the cells that moved at all or fail; a table without rows means nothing moved."""
    return rows_text(Delta, check.deltas)


def summary(check: Check) -> str:
    """Return one sentence on the outcome, flipped assessments first."""
    failed = check.failed
    if not failed:
        return f"{check.rows} rows, all within noise of the baseline ({len(check.deltas)} numbers moved at all)"
    flips = f"{len(check.flips)} assessments flipped; " if check.flips else ""
    counts = Counter(KINDS[row.kind] for row in failed if row.kind != "flip")
    listed = ", ".join(f"{count} {kind}" for kind, count in counts.items())
    rows = len({(row.in_table, row.row_key) for row in failed})
    return f"{flips}{rows} of {check.rows} rows fail" + (f" ({listed})" if listed else "")


def delta_markdown(check: Check, acceptance: Acceptance, movements: Sequence[Movement], page: str = "") -> str:
    """Return at most a screen: flips, better and worse by model and quantity, then the rows furthest out.

    `page` is the address of the report, to which cases link.
    """
    lines = [
        "# Change since the accepted baseline",
        "",
        f"{_escaped(summary(check))}.",
        "",
        f"Baseline of {_escaped(acceptance.when)} by {_escaped(acceptance.who)}, code {_escaped(acceptance.commit)}: "
        f"{_escaped(acceptance.reason)}",
    ]
    flips = check.flips
    if flips:
        lines += ["", "| assessment of | was | is |", "|---|---|---|"]
        lines += [
            f"| {_escaped(row.name)} | {_escaped(row.baseline)} | {_escaped(row.current)} |"
            for row in flips[:FLIPS_SHOWN]
        ]
        lines += _more(flips, FLIPS_SHOWN, "assessments")
    moved = [item for item in movements if item.better or item.worse]
    if moved:
        lines += [
            "",
            "| model, quantity | better | worse | largest change of \\|error\\| | case |",
            "|---|---:|---:|---:|---|",
        ]
        lines += [_movement(item, page) for item in moved[:MODELS_SHOWN]]
        lines += _more(moved, MODELS_SHOWN, "quantities")
    others = [row for row in check.failed if row.kind != "flip"]
    if others:
        lines += ["", "| kind | row | baseline | now | change | times noise |", "|---|---|---:|---:|---:|---:|"]
        lines += ["| " + " | ".join(map(_escaped, _cells(row))) + " |" for row in others[:ROWS_SHOWN]]
        lines += _more(others, ROWS_SHOWN, "rows")
    return "\n".join(lines).rstrip() + "\n"


def delta_junit(check: Check, groups: Sequence[tuple[str, str]]) -> str:
    """Return JUnit XML: a suite of assessments, a suite of numbers, a test case for each of `groups`, (table, source).

    The names of the test cases are the same from run to run, so that a CI system can follow them.
    """
    root = ET.Element("testsuites", name="tread-validate check")
    every = [*dict.fromkeys([*groups, *((row.in_table, row.source) for row in check.failed)])]
    failures = 0
    for title, of_flips in (("assessments", True), ("numbers", False)):
        suite = ET.SubElement(root, "testsuite", name=title, tests=str(len(every)))
        broken = 0
        for table, source in every:
            case = ET.SubElement(suite, "testcase", classname=_legal(f"{title}.{table}"), name=_legal(source or table))
            own = [row for row in check.failed if (row.in_table, row.source) == (table, source)]
            own = [row for row in own if (row.kind == "flip") == of_flips]
            if own:
                broken += 1
                words = f"{len(own)} {'assessments flipped' if of_flips else 'cells'}, first {own[0].name}"
                failure = ET.SubElement(case, "failure", type=own[0].outcome, message=_legal(words))
                failure.text = _legal("\n".join(_line(row) for row in own[:50]))
        suite.set("failures", str(broken))
        failures += broken
    root.set("tests", str(2 * len(every)))
    root.set("failures", str(failures))
    ET.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def delta_lines(check: Check, shown: int = 20) -> Iterable[str]:
    """Yield the failing rows as lines for a terminal: flips, rules, inputs, runs, and what follows from them."""
    failed = check.failed
    for row in failed[:shown]:
        yield _line(row)
    if len(failed) > shown:
        yield f"... and {len(failed) - shown} more"


def _line(row: Delta) -> str:
    before, now = _short(row.baseline) or "nothing", _short(row.current) or "nothing"
    change = f": {before} -> {now} {row.unit}".rstrip() if row.in_column else ""
    times = "" if row.times_noise is None else f", {row.times_noise:.3g} times the noise"
    kind = KINDS[row.kind] if row.outcome in ("moved", "changed") else row.outcome
    return f"{kind}: {row.name}{change}{times}{' (' + row.note + ')' if row.note else ''}"


def _cells(row: Delta) -> list[str]:
    times = "" if row.times_noise is None else f"{row.times_noise:.3g}"
    kind = KINDS[row.kind] if row.outcome in ("moved", "changed") else f"{KINDS[row.kind]}, {row.outcome}"
    change = f"{cell(row.change)} {row.unit}".strip() if row.change is not None else row.note
    return [kind, row.name, _short(row.baseline), _short(row.current), change, times]


def _short(text: str) -> str:
    return text if len(text) <= 24 else f"{text[:12]}..."


def _movement(item: Movement, page: str) -> str:
    case = _escaped(item.case_id)
    link = f"[{case}]({page}#case={item.case_id})" if page and item.case_id else case
    name = f"{item.predicted_source}, {item.quantity}" + ("" if item.metric == "scalar" else f", {item.metric}")
    change = f"{item.before:.4g} → {item.now:.4g} {'' if item.unit == '1' else item.unit}".rstrip()
    return f"| {_escaped(name)} | {item.better} | {item.worse} | {change} | {link} |"


def _more(rows: Sequence[object], shown: int, what: str) -> list[str]:
    return ["", f"... and {len(rows) - shown} more {what}."] if len(rows) > shown else []


def _escaped(text: str) -> str:
    return " ".join(re.sub(r"([\\`*_{}\[\]<>|#!])", r"\\\1", text).split())


def _legal(text: str) -> str:
    return XML_ILLEGAL.sub("?", text)
