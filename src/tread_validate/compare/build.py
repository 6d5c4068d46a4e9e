"""The tables of a study's comparison."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

from ..files import read_text, write_text
from ..reference.published import PUBLISHED
from ..study import load_study
from .provenance import assumed_inputs, provenance
from .regression.line import EXCLUDED_INTERFERENCES
from .scores.rows import METRIC_COLUMNS
from .study_comparison import Comparison, compare_study
from .table_rows import COLUMNS, case_row, claim_row, ensemble_row, peak_row, residual_row
from .tables.text import write_table


def build_tables(
    study: Path | str,
    spring_dir: Path | str,
    reference_dir: Path | str,
    out_dir: Path | str,
    decks_dir: Path | str = "fe_inputs",
    exclude: Sequence[float] = EXCLUDED_INTERFERENCES,
) -> Comparison:
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
        Takes the tables; each is written atomically, ``errors.csv`` last.
    decks_dir : path
        Holds ``<case_id>/<case_id>.inp`` and ``vfric.f``: a reference run is current when its record names the digest
        of these. Without them every reference run is stale.
    exclude : sequence of float, mm
        Interferences left out of the regressions; the paper leaves out 0.3 mm.
    """
    loaded = load_study(study)
    found = compare_study(loaded, Path(spring_dir), Path(reference_dir), Path(decks_dir), exclude)
    write_tables(found, Path(reference_dir), Path(out_dir))
    return found


def write_tables(found: Comparison, reference_dir: Path, out_dir: Path) -> None:
    """Write every table of a comparison."""
    by_id = {case.case_id: case for case in found.cases}
    write_table(out_dir / "cases.csv", COLUMNS["cases"], map(case_row, found.cases))
    write_table(
        out_dir / "peaks.csv",
        COLUMNS["peaks"],
        (peak_row(by_id[case_id], run) for (_, case_id), run in found.runs.items()),
    )
    write_table(out_dir / "ensemble.csv", COLUMNS["ensemble"], map(ensemble_row, found.ensembles))
    write_table(out_dir / "regression.csv", COLUMNS["regression"], map(asdict, found.coefficients))
    write_table(out_dir / "regression_differences.csv", COLUMNS["differences"], map(asdict, found.differences))
    assumed = {(row.source, row.shape, row.coefficient, row.set): row.assumed for row in found.coefficients}
    write_table(
        out_dir / "regression_residuals.csv",
        COLUMNS["residuals"],
        (residual_row(row, assumed[row.source, row.shape, row.coefficient, row.set]) for row in found.residuals),
    )
    write_table(out_dir / "claims.csv", COLUMNS["claims"], map(claim_row, found.claims))
    write_table(out_dir / "sensitivity.csv", COLUMNS["sensitivity"], map(asdict, found.sensitivity))
    write_table(out_dir / "assumed.csv", COLUMNS["assumed"], assumed_inputs(found.cases))
    write_text(out_dir / "published.csv", read_text(reference_dir / PUBLISHED))
    facts = provenance(found.study, found.cases, found.runs, found.sources, reference_dir)
    write_text(out_dir / "provenance.json", json.dumps(facts, indent=2, sort_keys=True) + "\n")
    write_table(out_dir / "errors.csv", METRIC_COLUMNS, map(asdict, found.rows))
