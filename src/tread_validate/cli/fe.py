"""`tread-validate fe`: run a deck in the built-in explicit FE engine."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    deck: Annotated[Path, typer.Argument(help="deck (.inp) of the documented subset, in mm, tonne, s, MPa, N")],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="history CSV; energies, contact forces, face and record go beside it")
    ],
    user: Annotated[Path | None, typer.Option("--user", help="friction routine, vfric.f")] = None,
    frames: Annotated[Path | None, typer.Option("--frames", help="folder for .vtu frames of the last step")] = None,
    normal: Annotated[
        str | None, typer.Option("--normal", help="out of the road, +x to -z; default: nearest to the contact forces")
    ] = None,
    travel: Annotated[
        str | None, typer.Option("--travel", help="the way the block goes, +x to -z; with --normal")
    ] = None,
    threads: Annotated[int, typer.Option("--threads", min=1, max=1024, help="the answer does not depend on them")] = 1,
    stall_limit: Annotated[
        float, number("--stall-limit", "time_limit_s", "longest time without progress, s: a routine that never ends")
    ] = 300.0,
    time_limit: Annotated[float, number("--time-limit", "time_limit_s", "longest time of the run, s")] = 86_400.0,
) -> None:
    """Run a deck in the built-in explicit FE engine and write the history of its last step.

    Example: tread-validate fe fe_inputs/ID/ID.inp --user fe_inputs/ID/vfric.f -o results/fe/embedded/ID.csv
    """
    from ..errors import EngineError, InputError
    from ..fe import run_deck
    from ..fe.progress import shown_progress
    from ..units import IN_MPA
    from .watchdog import watched

    if output.suffix != ".csv":
        raise InputError("--output", output, "a file that ends in .csv")
    with (
        watched(str(deck), stall_limit, time_limit, EngineError.exit_code) as moved,
        shown_progress(deck.stem, sys.stderr) as progress,
    ):

        def told(share: float, left: float) -> None:
            moved()
            progress(share, left)

        result = run_deck(deck, user, threads=threads, frames=frames, progress=told, normal=normal, travel=travel)
    result.write(output)
    record = result.record
    axes, balance, largest = record["axes"], record["energy_balance"], record["largest"]
    touched = bool(result.contact.iloc[:, 1:4].abs().to_numpy().any())
    forces = (
        f"peak normal force {result.history.normal_force.max():.2f} N along {axes['normal']} (travel {axes['travel']})"
        if touched
        else "no contact in the last step: its normal and longitudinal forces are 0"
    )
    typer.echo(
        f"{output}: {result.history.time.size} samples, {forces}; "
        f"{record['elements']} elements, {record['increments']} increments in {record['wall_time_s']:.1f} s"
    )
    typer.echo(
        f"energy unaccounted for {100 * balance['balance_error']:.2g} %, "
        f"artificial {100 * balance['artificial_share']:.2g} %, impacts {100 * balance['impact_share']:.2g} %; "
        f"largest logarithmic strain {100 * largest['log_strain']:.2g} %, contact pressure "
        f"{largest['contact_pressure_Pa'] * IN_MPA:.3g} MPa"
    )
    for reason in record["reference_quality"]["reasons"]:
        typer.echo(f"not a reference: {reason}")
