"""`tread-validate run-references`: run the FE engine for every case whose reference is outstanding, file the runs."""

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
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="folder for the runs [default: the study's, in results]")
    ] = None,
    logs: Annotated[
        Path | None, typer.Option("--logs", help="folder for each case's log and times [default: the study's, in logs]")
    ] = None,
    jobs: Annotated[int, typer.Option("--jobs", min=1, max=256, help="cases run side by side")] = 1,
    replace: Annotated[
        bool, typer.Option("--replace", help="replace filed runs of the same problem that differ beyond noise")
    ] = False,
) -> None:
    """Run the built-in FE engine for every case whose reference is missing, stale or of other code; file the runs.

    Each run is filed as it ends, the longest begins first. What fails is named and the others go on; the same command
    goes on where an interrupted one was.

    Example: tread-validate run-references config/study.yaml --jobs 2
    """
    from ..errors import CheckFailedError, EngineError, InputError
    from ..reference import FeStore
    from ..reference.engines_here import require
    from ..study import load_study
    from ..workspace import Workspace
    from .reference_passes import ENGINE, Places, run_outstanding

    loaded = load_study(study)
    if loaded.model.engine != ENGINE:
        raise InputError(f"{study}: engine", loaded.model.engine, f"{ENGINE}, the one that this verb runs")
    require(ENGINE, None)
    place = Workspace(loaded.model.name)
    places = Places(
        decks or place.decks, output or place.results / "fe" / "reference", logs or Path("logs") / place.name
    )
    told = run_outstanding(loaded, FeStore(references), places, jobs=jobs, replace=replace, say=typer.echo)
    if told.failures:
        raise EngineError(f"{len(told.failures)} passes failed: {_names(told.failures)}")
    if told.refused:
        raise CheckFailedError(
            f"{len(told.refused)} runs differ from the filed ones beyond noise: look, then --replace "
            f"({_names(told.refused)})"
        )


def _names(cases: list[str]) -> str:
    return ", ".join(cases[:5]) + (f" and {len(cases) - 5} more" if len(cases) > 5 else "")
