"""`tread-validate engines`: the filed runs of several engines against each other."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
    decks: Annotated[
        Path | None, typer.Option("--decks", help="folder of the generated decks [default: the study's, in fe_inputs]")
    ] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write the rows to this file (CSV)")] = None,
) -> None:
    """Compare the reference runs of several engines (embedded, abaqus, calculix) case by case.

    Example: tread-validate engines config/study.yaml -o engines.csv
    """

    from ..compare import MetricRow
    from ..compare.engines import engine_rows, engine_runs
    from ..compare.runs import engines
    from ..compare.tables import rows_text
    from ..files import write_text
    from ..spring import resolve_creep
    from ..study import load_study
    from ..workspace import Workspace

    loaded = load_study(study)
    cases = tuple(resolve_creep(loaded.cases()))
    names = engines(references, loaded.model.engine)
    runs = engine_runs(cases, references, decks or Workspace(loaded.model.name).decks, names)
    rows = engine_rows(cases, runs, names)
    for name in names:
        count = sum(runs[f"fe:{name}", case.case_id].history is not None for case in cases)
        typer.echo(f"{name}: runs of {count} of {len(cases)} cases")
    for row in rows:
        if row.quantity == "peak_normal_force" and row.error is not None:
            pair = f"{row.predicted_source} against {row.reference_source}"
            typer.echo(f"{row.case_id}: {pair}, peak normal force {row.error:+.2%}")
    if output is not None:
        write_text(output, rows_text(MetricRow, rows))
