"""`tread-validate file-references`: put finished FE runs into the reference store."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    histories: Annotated[list[Path] | None, typer.Argument(help="histories with their records beside them")] = None,
    decks: Annotated[Path, typer.Option("--decks", help="folder of the decks that were run")] = Path("fe_inputs"),
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
    engine: Annotated[
        str | None, typer.Option("--engine", help="refuse runs of any other engine; each is filed under its own")
    ] = None,
    mesh: Annotated[
        list[Path] | None, typer.Option("--mesh", help="result of mesh-error, to be filed; may be given again")
    ] = None,
    study: Annotated[str, typer.Option("--study", help="name of the study, for the record")] = "",
    replace: Annotated[
        bool, typer.Option("--replace", help="replace filed runs of the same problem that differ beyond noise")
    ] = False,
) -> None:
    """File runs under reference_data/fe/<engine>/ by the problem that they solved, each with its record and deck.

    Example: tread-validate file-references results/liu2010/fe/embedded/*.csv --decks fe_inputs/liu2010
    """
    from ..errors import CheckFailedError, InputError
    from ..inp import deck_files
    from ..reference import FeStore
    from ..reference.filing import drop_unused_blocks, file_run, read_run
    from ..reference.mesh_errors import file_mesh_study

    store = FeStore(references)
    for result in mesh or []:
        typer.echo(f"filed: {file_mesh_study(store.root / 'mesh', result)}")
    runs = [read_run(history, deck_files(decks, history.stem), engine) for history in histories or []]
    refused = []
    for run in runs:
        try:
            typer.echo(f"filed: {file_run(store, run, study=study, replace=replace)}")
        except InputError as error:
            refused.append(str(error))
            typer.echo(f"not filed: {error}", err=True)
    drop_unused_blocks(store)
    typer.echo(f"{len(runs) - len(refused)} of {len(runs)} runs filed under {store.root}")
    if refused:
        raise CheckFailedError(f"{len(refused)} runs differ from the filed ones beyond noise: look, then --replace")
