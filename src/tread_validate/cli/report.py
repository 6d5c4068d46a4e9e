"""`tread-validate report`: the pages that people read."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    tables: Annotated[
        Path | None, typer.Option(help="folder of the comparison's tables [default: the study's, in results]")
    ] = None,
    spring: Annotated[
        Path | None, typer.Option(help="folder of spring histories [default: the study's, in results]")
    ] = None,
    references: Annotated[Path, typer.Option(help="the reference data package")] = Path("reference_data"),
    decks: Annotated[Path | None, typer.Option(help="folder of decks [default: the study's, in fe_inputs]")] = None,
    out: Annotated[
        Path | None, typer.Option("-o", "--out", help="where the report goes [default: the study's, in reports]")
    ] = None,
    delta: Annotated[
        Path | None,
        typer.Option(help="delta table that `check` wrote of these tables"),
    ] = None,
    hierarchy: Annotated[
        Path | None,
        typer.Option(help="folder of the model hierarchy's tables [default: hierarchy/<study> among the references]"),
    ] = None,
    workflow: Annotated[
        Path | None, typer.Option(help="the workflow's note of its rules; without it their graph is not drawn")
    ] = None,
    jobs: Annotated[int, typer.Option("--jobs", min=1, max=256, help="2: draw and set in two processes")] = 1,
) -> None:
    """Write the report: index.html (one self-contained file), report.pdf, tables/ and figures/.

    Example: tread-validate report config/study.yaml
    """
    from ..compare.binding import todays_tables
    from ..report import build_report
    from ..study import load_study
    from ..workspace import Workspace

    loaded = load_study(study)
    place = Workspace(loaded.model.name)
    tables, spring = tables or place.tables, spring or place.spring
    decks, out = decks or place.decks, out or place.reports
    hierarchy = hierarchy or references / "hierarchy" / loaded.model.name
    todays_tables(tables, loaded)
    build_report(
        study, tables, spring, references, decks, out, baseline_delta=delta, hierarchy_dir=hierarchy, workflow=workflow,
        jobs=jobs,
    )  # fmt: skip
    typer.echo(f"{out / 'index.html'}\n{out / 'report.pdf'}")
