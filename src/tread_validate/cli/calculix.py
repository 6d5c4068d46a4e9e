"""`tread-validate calculix`: a deck of the elastic-Coulomb subset in CalculiX."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    deck: Annotated[Path, typer.Argument(help="deck (.inp) of an elastic compound with Coulomb friction")],
    output: Annotated[Path, typer.Option("-o", "--output", help="history CSV; the record goes beside it")],
    user: Annotated[Path | None, typer.Option("--user", help="friction routine of a Coulomb law, vfric.f")] = None,
    increments: Annotated[int, typer.Option("--increments", min=10, max=5000, help="increments of the pass")] = 400,
    folder: Annotated[Path | None, typer.Option("--work", help="keep CalculiX's own files in this folder")] = None,
    executable: Annotated[str, typer.Option("--executable", help="the command")] = "ccx",
    time_limit: Annotated[float, number("--time-limit", "time_limit_s", "longest time, s")] = 86_400.0,
) -> None:
    """Solve a pass quasi-statically in CalculiX; what that engine would silently ignore is refused by name.

    Example: tread-validate calculix fe_inputs/ID/ID.inp --user fe_inputs/ID/vfric.f -o results/fe/calculix/ID.csv
    """
    from ..calculix import Resolution, run_deck

    result = run_deck(
        deck,
        user,
        resolution=Resolution(pass_increments=increments),
        command=executable,
        folder=folder,
        time_limit=time_limit,
    )
    result.write(output)
    typer.echo(f"{output}: {result.history.time.size} samples, peak {result.history.normal_force.max():.2f} N")
