"""The tables of a study's comparison."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..files import read_text, write_text
from ..reference.published import PUBLISHED
from ..study import load_study
from .binding import write_provenance
from .expected_errors import expected_rows
from .provenance import assumed_inputs, provenance
from .regression.line import EXCLUDED_INTERFERENCES
from .study_comparison import StudyComparison, compare_study
from .summary import write_summary
from .table_rows import case_row, claim_row, peak_row, statistics_row, tolerance_row
from .tables import (
    AssumedRow,
    CaseRow,
    ClaimRow,
    Coefficient,
    Difference,
    Ensemble,
    ExpectedRow,
    MetricRow,
    PeakRow,
    Residual,
    Sensitivity,
    StatisticsRow,
    ToleranceRow,
    write_package,
    write_rows,
)  # fmt: skip


def build_tables(
    study: Path | str,
    spring_dir: Path | str,
    reference_dir: Path | str,
    out_dir: Path | str,
    decks_dir: Path | str = "fe_inputs",
    exclude: Sequence[float] = EXCLUDED_INTERFERENCES,
    jobs: int = 1,
) -> StudyComparison:
    """Compare every run of a study and write the tables; the same inputs give the same bytes.

    Parameters
    ----------
    study : path
        Study file.
    spring_dir : path
        Holds ``<variant>/<case_id>.csv`` and ``<variant>/summary.csv``.
    reference_dir : path
        The reference data package.
    out_dir : path
        Takes the tables; each is written atomically, ``provenance.json`` with their digests after them.
    decks_dir : path
        Holds ``<case_id>/<case_id>.inp`` and ``vfric.f``: a reference run is current when its record names the digest
        of these. Without them every reference run is stale.
    exclude : sequence of float, mm
        Interferences left out of the regressions; the paper leaves out 0.3 mm.
    jobs : int
        With 2, runs are read and scored in two processes; the tables are the same.
    """
    loaded = load_study(study)
    found = compare_study(loaded, Path(spring_dir), Path(reference_dir), Path(decks_dir), exclude, jobs=jobs)
    write_tables(found, Path(reference_dir), Path(out_dir))
    return found


def write_tables(found: StudyComparison, reference_dir: Path, out_dir: Path) -> None:
    """Write every table of a comparison, and the data package that describes them."""
    by_id = {case.case_id: case for case in found.cases}
    write_rows(out_dir, CaseRow, map(case_row, found.cases))
    write_rows(out_dir, PeakRow, (peak_row(by_id[case_id], run) for (_, case_id), run in found.runs.items()))
    write_rows(out_dir, StatisticsRow, (statistics_row(by_id[name], run) for (_, name), run in found.runs.items()))
    write_rows(out_dir, Ensemble, found.ensembles)
    write_rows(out_dir, Coefficient, found.coefficients)
    write_rows(out_dir, Difference, found.differences)
    write_rows(out_dir, Residual, found.residuals)
    write_rows(out_dir, ClaimRow, map(claim_row, found.claims))
    write_rows(out_dir, Sensitivity, found.sensitivity)
    write_rows(out_dir, ToleranceRow, map(tolerance_row, found.tolerances.values()))
    write_rows(out_dir, AssumedRow, assumed_inputs(found.cases))
    write_rows(out_dir, ExpectedRow, expected_rows(found.cases, found.runs, found.sources))
    write_text(out_dir / "published.csv", read_text(reference_dir / PUBLISHED))
    facts = provenance(found.study, found.cases, found.runs, found.sources, reference_dir)
    write_rows(out_dir, MetricRow, found.rows)
    write_provenance(out_dir, facts)
    write_package(out_dir, found.study.model.name, str(facts["commit"]))
    write_summary(out_dir, found.study.model.name)
