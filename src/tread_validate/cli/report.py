"""`tread-validate report`: the pages that people read."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    tables: Annotated[Path, typer.Option(help="folder of the comparison's tables")] = Path("results/tables"),
    spring: Annotated[Path, typer.Option(help="folder of spring histories, <variant>/<case>.csv")] = Path(
        "results/spring"
    ),
    references: Annotated[Path, typer.Option(help="the reference data package")] = Path("reference_data"),
    decks: Annotated[Path, typer.Option(help="folder of decks, <case>/mesh.vtu")] = Path("fe_inputs"),
    out: Annotated[Path, typer.Option("-o", "--out", help="where the report goes")] = Path("reports"),
    delta: Annotated[
        Path | None,
        typer.Option(help="delta table that `check` wrote [default: delta.csv beside the tables, if there]"),
    ] = None,
    ladder: Annotated[
        Path | None,
        typer.Option(help="folder of the model ladder's tables [default: ladder/ among the references]"),
    ] = None,
) -> None:
    """Write the report: index.html (one self-contained file), report.pdf, tables/ and figures/.

    Example: tread-validate report config/study.yaml --tables results/tables -o reports
    """
    from ..report import build_report

    delta = delta or (tables / "delta.csv" if (tables / "delta.csv").is_file() else None)
    ladder = ladder or references / "ladder"
    build_report(study, tables, spring, references, decks, out, baseline_delta=delta, ladder_dir=ladder)
    typer.echo(f"{out / 'index.html'}\n{out / 'report.pdf'}")
