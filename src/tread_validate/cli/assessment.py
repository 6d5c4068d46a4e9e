"""`tread-validate assessment`: what the tables come to, in at most six lines and an exit code."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    tables: Annotated[
        Path | None,
        typer.Option("--tables", help="folder of the comparison's tables [default: the study's, in results]"),
    ] = None,
    reports: Annotated[
        Path,
        typer.Option("--reports", help="folder of the reports, a folder for each study; its index.html is updated"),
    ] = Path("reports"),
    gate: Annotated[
        bool,
        typer.Option(
            "--gate", help="end with 1 where the baseline moved or an assessment flipped, 3 where nothing compares"
        ),
    ] = False,
) -> None:
    """Say how many references are current, how good each model is, and whether anything moved since the baseline.

    Example: tread-validate assessment config/study.yaml --gate
    """
    from ..compare.binding import todays_tables
    from ..compare.told import tell
    from ..errors import CheckFailedError, EngineError
    from ..report.landing import write_landing
    from ..study import load_study
    from ..workspace import Workspace

    loaded = load_study(study)
    folder = tables or Workspace(loaded.model.name).tables
    own = reports / loaded.model.name
    todays_tables(folder, loaded)
    told = tell(folder, own / "baseline")
    for line in told.lines():
        typer.echo(line)
    if (own / "index.html").is_file():
        write_landing(reports, own, loaded.model.title, told.lines())
        typer.echo(f"page: {own / 'index.html'} (and report.pdf)")
    if gate and not told.compared:
        raise EngineError("nothing could be compared")
    if gate and told.moved:
        raise CheckFailedError(told.baseline)
