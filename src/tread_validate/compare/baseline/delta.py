"""The tables of today against the accepted ones, cell by cell."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..quantities import Noise
from ..tables import TABLES, Delta, Outcome, TableRow, cell, read_rows
from ..tables.row import TableColumn
from .store import Baseline, Cells, todays_noise

Holds = Callable[[str, Cells], bool]
BROKEN = ("stale", "not_a_reference", "other_code", "unbound", "corrupt")
SLACK = 1e-9

# the condensed face stop iterating within a tolerance, and another processor ends elsewhere in it: measured, up to 1.8
# times the noise of the others between an AVX-512 machine and one without AVX; the others did not move a digit
ITERATIVE, ITERATIVE_FACTOR = "spring:condensed", 5.0

ASSESSMENTS = ("assessment", "agreement", "passed", "significant", "grade", "target_met")
RULES = (
    "tolerance", "criterion", "uncertainty", "u_numerical", "u_input", "u_data", "ci_level", "error_type",
    "spread_kind", "published", "published_low", "published_high",
)  # fmt: skip
RANK = {"flip": 0, "rule": 1, "input": 2, "run": 3, "consequence": 4}
OUTCOMES = {"stale": 0, "missing": 1, "new": 2, "changed": 3, "moved": 4, "within": 5}


@dataclass(frozen=True)
class Check:
    """What became of the baseline: how many rows were compared with it, and every cell that is not what it was."""

    rows: int
    deltas: tuple[Delta, ...]

    @property
    def failed(self) -> tuple[Delta, ...]:
        """The cells beyond their noise, and rows that are new, missing or stale."""
        return tuple(delta for delta in self.deltas if not delta.passed)

    @property
    def flips(self) -> tuple[Delta, ...]:
        """The assessments that are not what they were."""
        return tuple(delta for delta in self.failed if delta.kind == "flip")


def check_tables(baseline: Baseline, folder: Path | str, holds: Holds | None = None) -> Check:
    """Compare a folder of tables with the baseline, both ways and two-sided; or the rows of a part of them.

    `holds` says of a table's name and a row's cells whether the row counts, on both sides.

    Flipped assessments come first, then the rules they depend on, inputs, runs that moved, what follows from those; in
    each the furthest out first. Raises `InputError` for a table that is missing or damaged.
    """
    place = Path(folder)
    found: list[Delta] = list(_declared(baseline))
    rows = 0
    for name, kind in TABLES.items():
        current: Sequence[TableRow] = read_rows(place / f"{name}.csv", kind)
        accepted = baseline.tables.get(name, ())
        if holds is not None:
            current = [row for row in current if holds(name, _cells(row))]
            accepted = tuple(cells for cells in accepted if holds(name, cells))
        rows += len({row.identity() for row in current} | {_identity(kind, cells) for cells in accepted})
        found += _table(kind, accepted, current)
    order = sorted(found, key=lambda d: (d.passed, RANK[d.kind], -d.sortable(), OUTCOMES[d.outcome]))
    return Check(rows, tuple(order))


def _table(kind: type[TableRow], accepted: Sequence[Cells], current: Sequence[TableRow]) -> Iterator[Delta]:
    before = {_identity(kind, cells): cells for cells in accepted}
    known = set(accepted[0]) if accepted else set(kind.header())
    for name in (name for name in kind.header() if name not in known):
        yield Delta.of_row(kind.table, "consequence", "new", {}, name, "a column that the baseline does not have")
    for row in current:
        cells = _cells(row)
        old = before.pop(row.identity(), None)
        if cells.get("status") in BROKEN:
            note = f"reference or run is {cells['status']}"
            yield Delta.of_row(kind.table, _kind(kind.table, ""), "stale", cells, "", note)
        elif old is None:
            yield Delta.of_row(kind.table, _kind(kind.table, ""), "new", cells, "", "not in the baseline")
        else:
            yield from _row(row, cells, old)
    for old in before.values():
        yield Delta.of_row(kind.table, _kind(kind.table, ""), "missing", old, "", "no such row any more")


def _cells(row: TableRow) -> Cells:
    return {name: cell(value) for name, value in row.cells().items()}


def _row(row: TableRow, cells: Cells, old: Cells) -> Iterator[Delta]:
    for found in row.columns():
        a, b = old.get(found.name), cells[found.name]
        if found.free or a is None or a == b:
            continue
        outcome, change, width, note = _cell(found, row, a, b)
        if change == 0.0:  # the same number, written otherwise
            continue
        yield Delta.of_cell(row.table, _kind(row.table, found.name), outcome, cells, found, a, b, change, width, note)


def _cell(found: TableColumn, row: TableRow, a: str, b: str) -> tuple[Outcome, float | None, float, str]:
    """Return outcome, change, width and a word for a cell whose text is not what it was."""
    if found.kind != "number":
        return "changed", None, 0.0, ""
    if not a or not b:
        return ("new", None, 0.0, "had no value") if b else ("missing", None, 0.0, "no value any more")
    try:
        before = float(a)
    except ValueError:
        return "changed", None, 0.0, "was no number"
    width = row.noise(found).width(before) * _factor(row)
    change = float(b) - before
    # digits are cut in print: half a unit of the last one belongs to either number
    moved = abs(change) > width * (1.0 + SLACK) + 1e-15 * abs(before)
    return ("moved" if moved else "within"), change, width, ""


def _factor(row: TableRow) -> float:
    sources = (getattr(row, name, "") for name in ("source", "predicted_source", "source_a", "source_b"))
    return ITERATIVE_FACTOR if ITERATIVE in sources else 1.0


def _kind(table: str, column: str) -> str:
    if column in ASSESSMENTS:
        return "flip"
    if column in RULES:
        return "rule"
    if table == "tolerances":
        return "rule"
    if table in ("cases", "assumed", "published"):
        return "input"
    return "run" if table == "peaks" else "consequence"


def _identity(kind: type[TableRow], cells: Mapping[str, str]) -> tuple[str, ...]:
    return tuple(cells.get(name, "") for name in kind.key)


def _declared(baseline: Baseline) -> Iterator[Delta]:
    """Yield a change of the noise that the code declares: a baseline accepted under another is another baseline."""
    today = todays_noise()
    for name in sorted(baseline.noise.keys() | today.keys()):
        a, b = baseline.noise.get(name), today.get(name)
        if a != b:
            cells = {"quantity": name}
            column = TableColumn("noise", "string", "", "", False)
            yield Delta.of_cell("quantities", "rule", "changed", cells, column, _told(a), _told(b), None, 0.0, "")


def _told(noise: Noise | None) -> str:
    return "" if noise is None else f"{noise.relative:g} and {noise.absolute:g}"
