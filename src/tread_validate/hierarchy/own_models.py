"""Models of the user's own as levels of the hierarchy: error against the cost that was measured when they ran."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..compare.model_runs import model_runs, model_source
from ..compare.quantities import Tolerances
from ..compare.runs import Runs
from ..models.outcome import read_outcome
from ..study import Case, LoadedStudy
from .pareto import case_row


def own_rows(
    study: LoadedStudy, cases: Sequence[Case], references: Runs, folder: Path, judged: Tolerances | None = None
) -> list[dict[str, Any]]:
    """Return a row of errors and cost for every case and model of the study's own, from its runs in `folder`.

    Nothing is run. Processor time and largest resident memory are those of the run's process, start included; they stay
    empty for histories made elsewhere. The rows' columns are those of the built-in levels.
    """
    source = f"fe:{study.model.engine}"
    runs = model_runs(study, cases, folder)
    rows = []
    for name in study.model.models:
        for case in cases:
            run, reference = runs[model_source(name), case.case_id], references[source, case.case_id]
            cost = read_outcome(folder / name / f"{case.case_id}.json") if run.history is not None else None
            rows.append(
                case_row(
                    model_source(name), case, reference, run,
                    seconds=None if cost is None else cost.cpu_s,
                    memory=None if cost is None else cost.memory_MB,
                    judged=judged,
                )
            )  # fmt: skip
    return rows
