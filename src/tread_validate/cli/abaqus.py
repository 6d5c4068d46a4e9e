"""`tread-validate abaqus`: run a deck in ABAQUS/Explicit and extract its forces."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    deck: Annotated[Path, typer.Argument(help="deck (.inp)")],
    output: Annotated[Path, typer.Option("-o", "--output", help="history CSV; the record goes beside it")],
    user: Annotated[
        Path | None,
        typer.Option(
            "--user",
            help="friction routine: vfric.f (general contact: vfriction.f); on Windows renamed to .for on the way",
        ),
    ] = None,
    folder: Annotated[Path | None, typer.Option("--work", help="working folder; one beside the output if none")] = None,
    settings: Annotated[
        Path | None, typer.Option("--settings", help="engine settings (YAML): executable, queue, licence wait")
    ] = None,
) -> None:
    """Run a deck in ABAQUS/Explicit (a licence is needed), extract contact and reaction forces, check them.

    Example: tread-validate abaqus fe_inputs/ID/ID.inp --user fe_inputs/ID/vfric.f -o results/fe/abaqus/ID.csv
    """
    from ..reference.abaqus import load_settings, run_abaqus
    from ..reference.abaqus.importer import write

    work = folder if folder is not None else output.parent / f"{output.stem}.job"
    imported = run_abaqus(deck, user, work, load_settings(settings), say=typer.echo)
    write(imported, output)
    typer.echo(f"{output}: {imported.history.time.size} samples, peak {imported.history.normal_force.max():.2f} N")
