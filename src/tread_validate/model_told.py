"""What the loop of a model's developer says: assessments, better and worse, then the rows furthest out."""

from __future__ import annotations

from collections.abc import Mapping

from .compare.baseline.delta import Check
from .compare.baseline.movement import Movement
from .compare.baseline.output import delta_lines, summary
from .compare.told import summed_up
from .model_check import ModelCheck

FLIPS, MOVEMENTS, ROWS = 8, 9, 8


def told(done: ModelCheck) -> tuple[str, ...]:
    """Return at most a screen of lines."""
    lines = [_states(source, counts) for source, counts in done.states().items()]
    if not done.compared:
        return tuple(lines)
    lines += [str(summed_up(source, done.found.rows)) for source in done.part.sources]
    new = [source for source in done.part.sources if source not in done.accepted]
    if new:
        lines.append(f"baseline: none accepted yet of {', '.join(new)} (tread-validate accept)")
    check = done.check
    if check is None:
        return tuple(lines)
    lines.append(f"baseline: {summary(check)}")
    flips, others = check.flips, tuple(row for row in check.deltas if row.kind != "flip")
    lines += delta_lines(Check(check.rows, flips), FLIPS)
    lines += map(_movement, done.moved[:MOVEMENTS])
    return (*lines, *delta_lines(Check(check.rows, others), ROWS))


def _states(source: str, counts: Mapping[str, int]) -> str:
    return f"{source}: " + ", ".join(f"{n} {state.replace('_', ' ')}" for state, n in counts.items())


def _movement(item: Movement) -> str:
    unit = "" if item.unit == "1" else f" {item.unit}"
    name = item.quantity if item.metric == "scalar" else f"{item.quantity} {item.metric}"
    return (
        f"{item.predicted_source}, {name}: better in {item.better}, worse in {item.worse}; "
        f"most in {item.case_id}, {item.before:.4g} -> {item.now:.4g}{unit}"
    )
