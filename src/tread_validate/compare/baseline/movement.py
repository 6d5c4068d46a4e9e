"""By model and quantity: in how many cases the error grew or shrank since the baseline, and where most."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from ..quantities import HEADLINE
from ..tables import MetricRow, read_rows
from .store import Baseline


@dataclass(frozen=True)
class Movement:
    """How the headline error of one model moved.

    Attributes
    ----------
    better, worse : int
        Cases whose \\|error\\| fell or grew by more than its noise.
    case_id : str
        The case with the largest change of \\|error\\|, from `before` to `now`, in `unit` (1: a fraction or a score).
    """

    predicted_source: str
    reference_source: str
    quantity: str
    metric: str
    unit: str
    better: int
    worse: int
    case_id: str
    before: float
    now: float

    @property
    def error_type(self) -> str:
        """How the error is told: a share, a score's distance from 1, or in `unit`."""
        return "absolute" if self.unit != "1" else ("score" if self.metric == "iso18571_r" else "relative")


def movements(baseline: Baseline, folder: Path | str) -> tuple[Movement, ...]:
    """Return the movement of every model's headline quantities; those that got worse in most cases first."""
    current = read_rows(Path(folder) / "errors.csv", MetricRow)
    accepted = {tuple(row.get(name, "") for name in MetricRow.key): row for row in baseline.tables.get("errors", ())}
    groups: dict[tuple[str, str, str, str], list[MetricRow]] = {}
    for row in current:
        if (row.quantity, row.metric) in HEADLINE:
            groups.setdefault((row.predicted_source, row.reference_source, row.quantity, row.metric), []).append(row)
    found = [_movement(rows, accepted) for rows in groups.values()]
    return tuple(sorted((item for item in found if item is not None), key=lambda item: (-item.worse, -item.better)))


def _movement(rows: list[MetricRow], accepted: Mapping[tuple[str, ...], Mapping[str, str]]) -> Movement | None:
    error = next(column for column in MetricRow.columns() if column.name == "error")
    changes: list[tuple[float, str, float, float]] = []
    for row in rows:
        text = accepted.get(row.identity(), {}).get("error", "")
        if text and row.error is not None:
            before, now = abs(float(text)), abs(row.error)
            if abs(now - before) > row.noise(error).width(before):
                changes.append((now - before, row.case_id, before, now))
    if not changes:
        return None
    first = rows[0]
    _, case_id, before, now = max(changes, key=lambda change: abs(change[0]))
    return Movement(
        first.predicted_source, first.reference_source, first.quantity, first.metric,
        first.unit if first.error_type == "absolute" else "1",
        sum(change[0] < 0.0 for change in changes), sum(change[0] > 0.0 for change in changes), case_id, before, now,
    )  # fmt: skip
