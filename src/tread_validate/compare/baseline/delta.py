"""A run against the accepted baseline, row by row."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from .rows import BaselineRow

Outcome = Literal["within", "moved", "new", "missing", "stale", "changed"]
BROKEN = ("stale", "corrupt")
SLACK = 1e-9

DELTA_COLUMNS = (
    "outcome", "kind", "source", "reference_source", "case_id", "quantity", "metric", "unit", "baseline", "current",
    "change", "tolerance", "times_tolerance", "passed", "note",
)  # fmt: skip


@dataclass(frozen=True)
class Delta:
    """What became of one row.

    Attributes
    ----------
    outcome : str
        ``within`` tolerance; ``moved`` beyond it, in either direction; ``new``: not in the baseline; ``missing``: in
        the baseline with a value, now without row or value; ``stale``: the reference no longer belongs to its deck or
        is corrupt, whatever the baseline says; ``changed``: another word (inputs of a case, a verdict, a status).
    times_tolerance : float
        \\|change\\| over tolerance; infinite where there is no number to compare.
    """

    outcome: Outcome
    kind: str
    source: str
    reference_source: str
    case_id: str
    quantity: str
    metric: str
    unit: str
    baseline: float | None
    current: float | None
    change: float | None
    tolerance: float
    times_tolerance: float
    note: str

    @property
    def passed(self) -> bool:
        """Whether the row is within tolerance."""
        return self.outcome == "within"

    @property
    def name(self) -> str:
        """One line that says which row it is."""
        against = f" against {self.reference_source}" if self.reference_source else ""
        return f"{self.kind}: {self.source}{against}, {self.case_id}, {self.quantity} ({self.metric})"


def deltas(baseline: Sequence[BaselineRow], current: Sequence[BaselineRow]) -> tuple[Delta, ...]:
    """Compare every row of either side; the furthest out comes first, then in the order of the current rows."""
    accepted = {row.key: row for row in baseline}
    found = [_delta(accepted.pop(row.key, None), row) for row in current]
    found += [_delta(row, None) for row in accepted.values()]
    order = {"stale": 0, "missing": 1, "new": 2, "changed": 3, "moved": 4, "within": 5}
    return tuple(sorted(found, key=lambda d: (d.passed, -_sortable(d.times_tolerance), order[d.outcome])))


def _delta(before: BaselineRow | None, now: BaselineRow | None) -> Delta:
    row = now if now is not None else before
    assert row is not None
    a, b = None if before is None else before.value, None if now is None else now.value
    tolerance = row.tolerance if before is None else before.tolerance
    change = None if a is None or b is None else b - a
    times = math.inf
    if change is not None:
        times = abs(change) / tolerance if tolerance > 0.0 else (0.0 if change == 0.0 else math.inf)
    outcome, note = _outcome(before, now, change, times)
    if outcome == "within" and change is None:
        times = 0.0
    return Delta(
        outcome, row.kind, row.source, row.reference_source, row.case_id, row.quantity, row.metric, row.unit, a, b,
        change, tolerance, times, note,
    )  # fmt: skip


def _outcome(
    before: BaselineRow | None, now: BaselineRow | None, change: float | None, times: float
) -> tuple[Outcome, str]:
    if now is None:
        return "missing", "no such row any more"
    if now.status in BROKEN:
        return "stale", f"reference or run is {now.status}"
    if before is None:
        return "new", "not in the baseline"
    if before.value is not None and now.value is None:
        return "missing", f"no value any more: {now.status}"
    if before.value is None and now.value is not None:
        return "new", f"had no value: {before.status}"
    if change is not None and times > 1.0 + SLACK:
        return "moved", ""
    if before.text != now.text:
        if now.kind == "case":
            return "changed", "the case has other inputs"
        return "changed", f"{before.text or 'nothing'} -> {now.text or 'nothing'}"
    if before.status != now.status:
        return "changed", f"{before.status} -> {now.status}"
    return "within", ""


def _sortable(value: float) -> float:
    return value if math.isfinite(value) else 1e300
