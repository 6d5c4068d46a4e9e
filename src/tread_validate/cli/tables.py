"""`tread-validate tables`: from runs and references to the tables of the comparison."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import within


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    spring: Annotated[
        Path | None, typer.Option("--spring", help="folder of the spring runs [default: the study's, in results]")
    ] = None,
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
    decks: Annotated[
        Path | None, typer.Option("--decks", help="folder of the generated decks [default: the study's, in fe_inputs]")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="folder for the tables [default: the study's, in results]")
    ] = None,
    exclude: Annotated[
        list[float] | None,
        typer.Option(
            "--exclude-mm",
            callback=within("interference_mm"),
            help="interference left out of the regressions; repeatable; 0.3 if left out",
        ),
    ] = None,
    all_interferences: Annotated[
        bool, typer.Option("--all-interferences", help="leave no interference out of the regressions")
    ] = False,
    jobs: Annotated[int, typer.Option("--jobs", min=1, max=256, help="2: read and score in two processes")] = 1,
) -> None:
    """Compare every run with its reference and the study with the paper.

    Example: tread-validate tables config/study.yaml
    """
    from collections import Counter

    from ..compare import build_tables
    from ..compare.regression.line import EXCLUDED_INTERFERENCES
    from ..study import load_study
    from ..workspace import Workspace

    place = Workspace(load_study(study).model.name)
    spring, decks, output = spring or place.spring, decks or place.decks, output or place.tables
    left_out = () if all_interferences else tuple(exclude or EXCLUDED_INTERFERENCES)
    found = build_tables(study, spring, references, output, decks, left_out, jobs)
    for source in found.sources:
        runs = [run for (name, _), run in found.runs.items() if name == source]
        current = sum(run.history is not None for run in runs)
        typer.echo(f"{source}: {current} of {len(runs)} runs can be compared")
    counts = Counter(row.assessment for row in found.rows)
    typer.echo(
        f"{len(found.rows)} rows: {counts['adequate']} good enough, {counts['inadequate']} not, "
        f"{counts['cannot tell']} open"
    )
    claims = [claim for claim in found.claims if claim.assessment != "cannot tell"]
    agree = sum(claim.assessment == "agrees" for claim in claims)
    typer.echo(
        f"{len(found.claims)} published claims: {agree} agree, {len(claims) - agree} disagree, "
        f"{len(found.claims) - len(claims)} open"
    )
    typer.echo(f"tables in {output}")
