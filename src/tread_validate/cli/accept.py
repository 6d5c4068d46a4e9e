"""`tread-validate accept`: make the tables of today the baseline."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    reason: Annotated[str, typer.Option("--reason", help="why the new numbers are right")],
    tables: Annotated[
        Path | None, typer.Argument(help="folder of the comparison's tables [default: the only one in results]")
    ] = None,
    baseline: Annotated[
        Path | None, typer.Option("--baseline", help="folder of the baseline [default: the study's, in reports]")
    ] = None,
    references: Annotated[Path, typer.Option(help="the reference data package")] = Path("reference_data"),
    who: Annotated[str | None, typer.Option("--who", help="who accepts; git's user name if left out")] = None,
    allow_dirty: Annotated[
        bool, typer.Option("--allow-dirty", help="accept from a tree with uncommitted changes")
    ] = False,
    allow_stale: Annotated[
        bool, typer.Option("--allow-stale", help="accept although references are stale; check goes on failing")
    ] = False,
) -> None:
    """Record the tables as the baseline, with reason, person, date and commit.

    Example: tread-validate accept --reason "default step halved: peaks move by 0.02 %"
    """
    from ..compare.baseline.accept import accept
    from ..compare.binding import todays_tables
    from ..workspace import Workspace, only_tables

    tables = tables or only_tables()
    facts = todays_tables(tables)
    baseline = baseline or Workspace(facts.study).baseline
    made = accept(
        tables, baseline, reason, who=who, allow_dirty=allow_dirty, allow_stale=allow_stale, references=references
    )
    acceptance = made.acceptance
    typer.echo(f"{made.rows} rows accepted in {baseline}: {acceptance.reason}")
    typer.echo(f"by {acceptance.who}, {acceptance.when}, code {acceptance.commit}")
