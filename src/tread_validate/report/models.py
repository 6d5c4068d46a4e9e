"""One row for every model: its errors, grades, assessment and cost against the reference that has most to say."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..columns import read_columns
from ..compare.scores.iso18571 import grade
from ..compare.tables import Ensemble, MetricRow, read_rows
from ..hierarchy.tables import Level
from ..study import LoadedStudy
from ..units import IN_MS
from . import wording
from .content import Cell, Column, Row, Table, Tone
from .marks import Marks
from .tables import Pair, Tables, pairs_of

NORMAL = "peak_normal_force"
LONGITUDINAL = ("peak_positive_tangential_force", "peak_negative_tangential_force")
OPEN = 0.1  # share of cases that may be `cannot tell` where the assessment says `good enough`
COLUMNS = (
    Column("Model"),
    Column("Peak N error", "mean; worst", numeric=True),
    Column("Peak longitudinal force error", "mean; worst", numeric=True),
    Column("ISO/TS 18571", "mean R of N; of T"),
    Column("Assessment", "tolerance; uncertainty U", wide=True, long=True),
    Column("Cost", "of one pass", numeric=True),
)


@dataclass(frozen=True)
class Costs:
    """Seconds of one pass by source."""

    seconds: Mapping[str, float]

    @classmethod
    def read(cls, hierarchy: Path | None, models: Path, study: LoadedStudy) -> Costs:
        """Read them from the model hierarchy's tables and from the summaries of the study's own models."""
        found: dict[str, float] = {}
        file = None if hierarchy is None else hierarchy / "pareto.csv"
        if file is not None and file.is_file():
            for row in read_rows(file, Level):
                if row.group == "all" and row.seconds_per_pass is not None:
                    found[f"spring:{row.level}"] = row.seconds_per_pass
        for name in study.model.models:
            file = models / name / "summary.csv"
            if file.is_file():
                known = read_columns(file, ("cpu_s",), gaps=True)["cpu_s"]
                told = known[np.isfinite(known)].tolist()
                if told:
                    found[f"model:{name}"] = sum(told) / len(told)
        return cls(found)


def models_table(tables: Tables, study: LoadedStudy, costs: Costs, marks: Marks) -> Table:
    """Return a row for every source that is compared with a reference."""
    rows = tuple(
        _row(tables, study, costs, marks, source, _reference(tables, study, source)) for source in _models(tables)
    )
    help_line = "E: comparison error; U: its expanded uncertainty. Good enough: |E| + U within the tolerance."
    return Table("models", "Every model and its assessment", COLUMNS, rows, help=help_line, csv="ensemble.csv")


def _models(tables: Tables) -> list[str]:
    """Return the predicted sources: built-in models first, then the study's own, then FE engines that are judged."""
    names = list(dict.fromkeys(row.predicted_source for row in tables.ensemble))
    names = [name for name in names if not name.startswith("fe:") or _answered(tables, name)]
    return sorted(names, key=lambda name: ("spring", "model", "fe").index(name.split(":")[0]) if ":" in name else 3)


def _answered(tables: Tables, source: str) -> list[Pair]:
    pairs = [pair for pair in pairs_of(tables.ensemble) if pair[0] == source]
    return [pair for pair in pairs if (row := tables.statistics(pair, NORMAL)) is not None and row.compared]


def _reference(tables: Tables, study: LoadedStudy, source: str) -> str:
    """Return the reference to judge by: the study's engine where it answers, else the first that does, else any."""
    answered = [reference for _, reference in _answered(tables, source)]
    wanted = f"fe:{study.model.engine}"
    every = [reference for predicted, reference in pairs_of(tables.ensemble) if predicted == source]
    return wanted if wanted in answered else (answered or every)[0]


def _row(tables: Tables, study: LoadedStudy, costs: Costs, marks: Marks, source: str, reference: str) -> Row:
    pair = (source, reference)
    normal = tables.statistics(pair, NORMAL)
    longitudinal = [row for name in LONGITUDINAL if (row := tables.statistics(pair, name)) is not None]
    seconds = costs.seconds.get(source)
    assessed, tone, note = assessment(normal, longitudinal)
    if any(row.compared for row in longitudinal):
        note += f". {wording.sliding(tables.sliding(pair)).capitalize()}"
    cells = (
        Cell(wording.source(source), note="; ".join(filter(None, (own_words(study, source), *_told(tables, source))))),
        _errors([normal] if normal else []),
        _errors(longitudinal),
        _scores(tables, pair),
        Cell(assessed, tone=tone, note=note),
        Cell("–" if seconds is None else f"{wording.digits(IN_MS * seconds)} ms", sort=seconds),
    )
    return Row(cells, marks.of(normal.assumed if normal else ""), key=f"model-{source.replace(':', '-')}")


def own_words(study: LoadedStudy, source: str) -> str:
    """Return description and origin of a model of the user's own; nothing for a built-in one."""
    kind, _, name = source.partition(":")
    own = study.model.models.get(name) if kind == "model" else None
    return "" if own is None else f"{own.description}; {own.origin}"


def _told(tables: Tables, source: str) -> list[str]:
    """Say how many runs of a model are not there, and pass on what looks like a mistake of the user's."""
    states = [row.status for row in tables.peaks if row.source == source]
    counts = {state: states.count(state) for state in dict.fromkeys(states) if state != "current"}
    found = [f"{count} of {len(states)} {wording.status(state)}" for state, count in counts.items()]
    if source.startswith("model:"):
        notes = [row.note for row in tables.errors if row.predicted_source == source and "taken for" in row.note]
        found += list(dict.fromkeys(note.split("; ")[0] for note in notes))[:1]
    return found


def _errors(rows: list[Ensemble]) -> Cell:
    known = [row for row in rows if row.compared and row.mean_abs_error is not None]
    if not known:
        return Cell("–")
    mean = max(known, key=lambda row: row.mean_abs_error or 0.0)
    worst = max(known, key=lambda row: row.largest_abs_error or 0.0)
    text = f"{wording.size(mean.mean_abs_error, mean.error_type, mean.unit)}; "
    text += wording.size(worst.largest_abs_error, worst.error_type, worst.unit)
    return Cell(text, sort=mean.mean_abs_error)


def _scores(tables: Tables, pair: Pair) -> Cell:
    texts, first = [], None
    for quantity in ("normal_force", "tangential_force"):
        row = tables.statistics(pair, quantity, "iso18571_r")
        if row is None or row.mean_abs_error is None:
            texts.append("–")
            continue
        score = 1.0 - row.mean_abs_error
        first = score if first is None else first
        texts.append(f"{score:.2f} {grade(score)}")
    return Cell("; ".join(texts) if first is not None else "–", sort=first)


def assessment(normal: Ensemble | None, longitudinal: list[Ensemble]) -> tuple[str, Tone, str]:
    """Return the assessment, its tone, and each criterion with its tolerance, U and count; what fails is named."""
    parts = [("N", [normal] if normal is not None and normal.compared else [])]
    parts.append(("T", [row for row in longitudinal if row.compared]))
    told = [(name, rows) for name, rows in parts if rows]
    if not told:
        status = normal.status if normal is not None else "missing"
        return "? cannot tell", "unknown", wording.status(status)
    failed = [name for name, rows in told if sum(row.inadequate for row in rows)]
    unsure = [
        name
        for name, rows in told
        if name not in failed and sum(row.adequate for row in rows) < (1.0 - OPEN) * sum(row.compared for row in rows)
    ]
    note = ". ".join(_criterion(name, rows) for name, rows in told)
    if failed:
        fine = any(sum(row.adequate for row in rows) for _, rows in told)
        return f"✗ {' and '.join(failed)} not good enough", "warn" if fine else "bad", note
    if unsure:
        return f"? cannot tell for {' and '.join(unsure)}", "unknown", note
    return "✓ good enough", "good", note


def _criterion(name: str, rows: list[Ensemble]) -> str:
    known = [row.mean_uncertainty for row in rows if row.mean_uncertainty is not None]
    spread = wording.size(sum(known) / len(known), rows[0].error_type, rows[0].unit) if known else "not known"
    met, peaks = sum(row.adequate for row in rows), sum(row.compared for row in rows)
    unsure = peaks - met - sum(row.inadequate for row in rows)
    told = f"{met} of {peaks}" + (f", {unsure} undecided" if unsure else "")
    return f"{name} within {rows[0].criterion}: {told} (U {spread})"


def judged(row: MetricRow) -> str:
    """Write tolerance and uncertainty of one comparison, with the three standard uncertainties behind it."""
    tolerance, spread = (wording.size(value, row.error_type, row.unit) for value in (row.tolerance, row.uncertainty))
    parts = (("mesh", row.u_numerical), ("inputs", row.u_input), ("data", row.u_data))
    told = ", ".join(
        f"{name} {'unknown' if value is None else wording.size(value, row.error_type, row.unit)}"
        for name, value in parts
    )
    return f"tolerance {tolerance}, U {spread} (u: {told})"
