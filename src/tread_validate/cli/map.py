"""`tread-validate map`: where each model may be believed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML); its first case gives compound and deck settings")],
    output: Annotated[Path, typer.Option("-o", "--output", help="folder for points, table and figures")] = Path(
        "results/map"
    ),
    runs: Annotated[int, typer.Option("--runs", min=1, max=1024, help="points of the design")] = 64,
    minutes: Annotated[int, typer.Option("--minutes", min=0, max=10080, help="no new point begins after so long")] = 30,
    jobs: Annotated[int, typer.Option("--jobs", min=1, max=256, help="points run side by side")] = 1,
) -> None:
    """Run a designed study over the dimensionless groups against FE on two coarse meshes; tabulate every model's error.

    Done points are kept, FE and models apart: the same command goes on where it was; a change of a model runs no FE.

    Example: tread-validate map config/study.yaml --runs 128 --minutes 60
    """
    from ..study import load_study
    from ..validity.build import MapSettings, build

    points = build(load_study(study).cases()[0], output, MapSettings(runs, minutes, jobs), typer.echo)
    typer.echo(f"{len(points)} points: {output / 'map.csv'}")
