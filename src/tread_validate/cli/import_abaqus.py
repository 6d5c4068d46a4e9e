"""`tread-validate import-abaqus`: forces from an ABAQUS run made elsewhere."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    source: Annotated[Path, typer.Argument(help="extract_odb.py's CSV, a Viewer .rpt, or two columns: time and force")],
    deck: Annotated[Path, typer.Option("--deck", help="the .inp that was run")],
    user: Annotated[Path | None, typer.Option("--user", help="its friction routine, vfric.f")] = None,
    tangential: Annotated[
        Path | None, typer.Option("--tangential", help="two columns: time and tangential force, positive towards -x")
    ] = None,
    case_id: Annotated[str | None, typer.Option("--case", help="the case, to be checked against the deck")] = None,
    force_unit: Annotated[str, typer.Option("--force-unit", help="N, kN or mN")] = "N",
    time_unit: Annotated[str, typer.Option("--time-unit", help="s, ms or us")] = "s",
    clock: Annotated[str, typer.Option("--clock", help="auto, step (of the pass) or total")] = "auto",
    force_on: Annotated[str, typer.Option("--force-on", help="which body CFN and CFS act on: block or road")] = "block",
    solver_version: Annotated[str, typer.Option("--solver-version", help="release, where the table says none")] = "",
    replace: Annotated[bool, typer.Option("--replace", help="replace a reference that is there already")] = False,
    store: Annotated[Path, typer.Option("--store", help="folder of reference data")] = Path("reference_data"),
) -> None:
    """Check the forces of an ABAQUS run against its deck and file them among the references of ABAQUS.

    Example: tread-validate import-abaqus forces.csv --deck fe_inputs/ID/ID.inp --user fe_inputs/ID/vfric.f
    """
    from ..errors import InputError
    from ..inp import DeckFiles
    from ..reference.abaqus import Options, file_history, import_history

    for option, value, known in (
        ("--force-unit", force_unit, ("N", "kN", "mN")),
        ("--time-unit", time_unit, ("s", "ms", "us")),
        ("--clock", clock, ("auto", "step", "total")),
        ("--force-on", force_on, ("block", "road")),
    ):
        if value not in known:
            raise InputError(option, value, "one of " + ", ".join(known))
    options = Options(force_unit, time_unit, clock, force_on, case_id, solver_version)  # type: ignore[arg-type]  # typer gives plain text; Options checks it
    imported = import_history(source, deck, user, tangential=tangential, options=options)
    path = file_history(imported, store, DeckFiles(deck, user), replace=replace)
    for check in imported.record["checks"]:
        typer.echo(check)
    typer.echo(f"filed as {path} with its record")
