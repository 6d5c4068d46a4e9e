"""`tread-validate stale`: which FE references no longer belong to their decks or to the engine's code?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    decks: Annotated[
        Path | None, typer.Option("--decks", help="folder of the generated decks [default: the study's, in fe_inputs]")
    ] = None,
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
    engine: Annotated[str | None, typer.Option("--engine", help="whose runs; the study's engine if left out")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write the case ids to this file")] = None,
    runnable: Annotated[
        bool, typer.Option("--runnable", help="end with 3 where there is work for an engine that cannot run here")
    ] = False,
    settings: Annotated[
        Path | None, typer.Option("--settings", help="engine settings (YAML), for --runnable with ABAQUS")
    ] = None,
) -> None:
    """List the cases whose FE reference is missing, stale, corrupt or made by other code, with the reason.

    Example: tread-validate stale config/study.yaml
    """
    from ..files import write_text
    from ..inp import deck_files
    from ..reference import FeStore, check_engine
    from ..reference.engines_here import require
    from ..study import load_study
    from ..workspace import Workspace

    loaded = load_study(study)
    chosen = check_engine(engine or loaded.model.engine)
    store = FeStore(references)
    folder = decks or Workspace(loaded.model.name).decks
    cases = loaded.cases()
    listed: list[str] = []
    for case in cases:
        reference = store.find(chosen, case.case_id, deck_files(folder, case.case_id))
        if reference.status != "current":
            listed.append(case.case_id)
            typer.echo(f"{case.case_id}: {reference.status.replace('_', ' ')}, {reference.reason}")
    typer.echo(f"{len(cases) - len(listed)} of {len(cases)} references of engine {chosen} are current")
    if runnable and listed:
        require(chosen, settings)
    if output is not None:
        write_text(output, "".join(f"{case_id}\n" for case_id in listed))
