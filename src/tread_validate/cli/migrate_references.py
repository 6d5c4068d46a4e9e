"""`tread-validate migrate-references`: read a reference store of the layout before 0.2 once."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML) whose decks the runs were made from")],
    decks: Annotated[
        Path | None, typer.Option("--decks", help="folder of the study's decks [default: the study's, in fe_inputs]")
    ] = None,
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
) -> None:
    """Move FE runs and mesh studies to the layout by problem; what cannot be bound to a deck stays and is named.

    Example: tread-validate migrate-references config/study.yaml
    """
    from ..errors import CheckFailedError
    from ..reference.migrate import migrate
    from ..study import load_study
    from ..workspace import Workspace

    loaded = load_study(study)
    folder = decks or Workspace(loaded.model.name).decks
    done = migrate(references, loaded.cases(), folder, loaded.model.name)
    typer.echo(f"{len(done.moved)} moved")
    for name, reason in done.left:
        typer.echo(f"left: {name}: {reason}")
    if done.left:
        raise CheckFailedError(f"{len(done.left)} could not be moved: delete them or make them anew")
