"""Several engines' runs of one case, each compared with the others."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations
from pathlib import Path

from ..study import Case
from .runs import Runs, fe_runs
from .scores.comparison import compare
from .tables import MetricRow


def engine_runs(cases: Sequence[Case], reference_dir: Path, decks_dir: Path, engines: Sequence[str]) -> Runs:
    """Return the filed runs of the named engines for every case."""
    runs: dict[tuple[str, str], object] = {}
    for engine in engines:
        runs.update(fe_runs(cases, reference_dir, engine, decks_dir))
    return runs  # type: ignore[return-value]  # values are what fe_runs gives


def engine_rows(cases: Sequence[Case], runs: Runs, engines: Sequence[str]) -> list[MetricRow]:
    """Compare every pair of engines in every case that both have run; the first named is the reference.

    The reference's mesh error is the uncertainty, where its record states one. A case that only one engine has run
    gives no row: there is nothing to compare; `tread-validate stale` lists what is missing.
    """
    rows: list[MetricRow] = []
    for first, second in combinations(engines, 2):
        for case in cases:
            a, b = runs[f"fe:{first}", case.case_id], runs[f"fe:{second}", case.case_id]
            if a.history is None or b.history is None:
                continue
            rows += compare(
                a.history,
                b.history,
                case_id=case.case_id,
                reference_source=a.source,
                predicted_source=b.source,
                uncertainty=a.uncertainty,
                numerical=b.uncertainty,
                assumed="; ".join(case.assumed()),
            )
    return rows
