"""What a run of the workbench says in at most six lines: references, models, baseline, page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from .baseline.delta import check_tables
from .baseline.store import load_baseline, same_study
from .tables import MetricRow, PeakRow, read_rows

MOST_LINES = 5
NOTHING = "Nothing could be compared: no run of any model has a reference of the same problem."


@dataclass(frozen=True)
class ModelTold:
    """How one model does against one reference in the peak normal force.

    Attributes
    ----------
    model, reference : str
        Sources; the reference is empty where there was nothing to compare with.
    error : float or None
        Mean of the relative errors' sizes.
    assessments : mapping of str to int
        Cases by assessment.
    """

    model: str
    reference: str = ""
    error: float | None = None
    assessments: Mapping[str, int] = field(default_factory=dict)

    def __str__(self) -> str:
        """Say it in one line."""
        if not self.reference:
            return f"{self.model}: nothing to compare with"
        error = "no peak N" if self.error is None else f"mean |error| of peak N {100 * self.error:.1f} %"
        assessments = ", ".join(f"{assessment} in {count}" for assessment, count in sorted(self.assessments.items()))
        return (
            f"{self.model} against {self.reference}: {error}; of {sum(self.assessments.values())} cases {assessments}"
        )


@dataclass(frozen=True)
class Told:
    """What the tables come to.

    Attributes
    ----------
    references : mapping of str to mapping of str to int
        Runs of every engine by status.
    models : tuple of ModelTold
    compared : bool
        Whether any run had a reference to be compared with.
    moved : bool or None
        Whether anything moved since the baseline or an assessment flipped; None without a baseline.
    baseline : str
        The same in words.
    """

    references: Mapping[str, Mapping[str, int]]
    models: tuple[ModelTold, ...]
    compared: bool
    moved: bool | None
    baseline: str

    def lines(self) -> tuple[str, ...]:
        """Return at most five lines: what could not be compared first, references, models, baseline."""
        found = [] if self.compared else [NOTHING]
        found.append(self._references())
        room = MOST_LINES - len(found) - 1
        told = [str(model) for model in self.models]
        if len(told) > room:
            told = [*told[: room - 1], f"and {len(told) - room + 1} more models: see the page"]
        return (*found, *told, self.baseline)

    def _references(self) -> str:
        parts = []
        for engine, counts in self.references.items():
            shown = {"current": 0, **counts}
            parts.append(f"{engine} " + ", ".join(f"{n} {state.replace('_', ' ')}" for state, n in shown.items()))
        wanting = any(set(counts) - {"current", "no_contact"} for counts in self.references.values())
        return f"references: {'; '.join(parts) or 'none'}" + (" (make reference)" if wanting else "")


def tell(tables: Path, baseline: Path) -> Told:
    """Read the tables and say what they come to; raises `InputError` for tables or a baseline that cannot be read."""
    peaks = read_rows(tables / "peaks.csv", PeakRow)
    errors = read_rows(tables / "errors.csv", MetricRow)
    references: dict[str, dict[str, int]] = {}
    for row in peaks:
        if row.source.startswith("fe:"):
            counts = references.setdefault(row.source.removeprefix("fe:"), {})
            counts[row.status] = counts.get(row.status, 0) + 1
    models = dict.fromkeys(row.predicted_source for row in errors if not row.predicted_source.startswith("fe:"))
    compared = any(row.error is not None for row in errors)
    return Told(references, tuple(summed_up(model, errors) for model in models), compared, *_baseline(tables, baseline))


def summed_up(model: str, errors: Sequence[MetricRow]) -> ModelTold:
    """Sum up one model against the first reference that has anything to compare with."""
    own = [row for row in errors if row.predicted_source == model and row.error is not None]
    for reference in dict.fromkeys(row.reference_source for row in own):
        head = [
            row
            for row in own
            if (row.reference_source, row.quantity, row.metric) == (reference, "peak_normal_force", "scalar")
        ]
        sizes = [abs(row.error) for row in head if row.error is not None]
        mean = sum(sizes) / len(sizes) if sizes else None
        return ModelTold(model, reference, mean, dict(Counter(str(row.assessment) for row in head)))
    return ModelTold(model)


def _baseline(tables: Path, baseline: Path) -> tuple[bool | None, str]:
    if not (baseline / "baseline.yaml").is_file():
        return None, "baseline: none accepted yet (tread-validate accept)"
    accepted = load_baseline(baseline)
    same_study(accepted, tables)
    found = check_tables(accepted, tables)
    if found.flips:
        return True, f"baseline: {len(found.flips)} assessments flipped, {len(found.failed)} cells moved (make check)"
    if found.failed:
        return True, f"baseline: no assessment flipped, {len(found.failed)} cells moved (make check)"
    return False, "baseline: not moved"
