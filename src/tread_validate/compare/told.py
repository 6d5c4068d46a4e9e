"""What a run of the workbench says in at most six lines: references, models, baseline, page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from .baseline.delta import check_tables
from .baseline.store import load_baseline, same_study
from .tables import Ensemble, MetricRow, PeakRow, read_rows

HEADLINE = "peak_normal_force"
MOST_LINES = 6
STATES = ("current", "other_code", "stale", "missing", "corrupt", "unbound", "no_contact", "failed")


@dataclass(frozen=True)
class Told:
    """The lines, and what they mean for an exit code.

    Attributes
    ----------
    lines : tuple of str
        At most six, the page left out.
    compared : bool
        Whether any run had a reference to be compared with.
    moved : bool
        Whether anything moved since the baseline or a verdict flipped.
    """

    lines: tuple[str, ...]
    compared: bool
    moved: bool


def tell(tables: Path, baseline: Path) -> Told:
    """Read the tables and say what they come to; raises `InputError` for tables or a baseline that cannot be read."""
    peaks = read_rows(tables / "peaks.csv", PeakRow)
    errors = read_rows(tables / "errors.csv", MetricRow)
    ensembles = read_rows(tables / "ensemble.csv", Ensemble)
    compared = any(row.error is not None for row in errors)
    lines = [] if compared else ["Nothing could be compared: no run of any model has a reference of the same problem."]
    lines += _references(peaks)
    models = list(dict.fromkeys(row.predicted_source for row in errors if not row.predicted_source.startswith("fe:")))
    told = [_model(source, errors, ensembles) for source in models]
    room = MOST_LINES - 2 - len(lines)
    if len(told) > room:
        told = [*told[: room - 1], f"and {len(told) - room + 1} more models: see the page"]
    moved, line = _baseline(tables, baseline)
    return Told((*lines, *told, line), compared, moved)


def _references(peaks: Sequence[PeakRow]) -> list[str]:
    parts = []
    for source in dict.fromkeys(row.source for row in peaks if row.source.startswith("fe:")):
        counts = Counter(row.status for row in peaks if row.source == source)
        states = [
            f"{counts[state]} {state.replace('_', ' ')}" for state in STATES if counts[state] or state == "current"
        ]
        parts.append(f"{source.removeprefix('fe:')} {', '.join(states)}")
    return [f"references: {'; '.join(parts) or 'none'}" + (" (make reference)" if _wanting(peaks) else "")]


def _wanting(peaks: Sequence[PeakRow]) -> bool:
    return any(row.status not in ("current", "no_contact") for row in peaks if row.source.startswith("fe:"))


def _model(source: str, errors: Sequence[MetricRow], ensembles: Sequence[Ensemble]) -> str:
    """Say one model's headline error and how its verdicts stand, against the first reference that has any."""
    for reference in dict.fromkeys(row.reference_source for row in errors if row.predicted_source == source):
        own = [
            row
            for row in errors
            if (row.predicted_source, row.reference_source) == (source, reference) and row.error is not None
        ]
        if not own:
            continue
        head = [row for row in own if (row.quantity, row.metric) == (HEADLINE, "scalar")]
        sizes = [abs(row.error) for row in head if row.error is not None]
        mean = f"mean |error| of peak N {100 * sum(sizes) / len(sizes):.1f} %" if sizes else "no peak N"
        counts = Counter(row.verdict for row in head)
        verdicts = ", ".join(f"{verdict} in {count}" for verdict, count in sorted(counts.items()))
        return f"{source} against {reference}: {mean} over {len(head)} cases; {verdicts}"
    return f"{source}: nothing to compare with"


def _baseline(tables: Path, baseline: Path) -> tuple[bool, str]:
    if not (baseline / "baseline.yaml").is_file():
        return False, "baseline: none accepted yet (tread-validate accept)"
    accepted = load_baseline(baseline)
    same_study(accepted, tables)
    found = check_tables(accepted, tables)
    if found.flips:
        return True, f"baseline: {len(found.flips)} verdicts flipped, {len(found.failed)} cells moved (make check)"
    if found.failed:
        return True, f"baseline: no verdict flipped, {len(found.failed)} cells moved (make check)"
    return False, "baseline: not moved"
