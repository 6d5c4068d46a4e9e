"""`tread-validate run-times`: what every rule of the workflow took."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

BEGAN = "TREAD_VALIDATE_RUN_BEGAN"  # set by the workflow: when its run began, in seconds of the epoch


def command(
    graph: Annotated[Path, typer.Argument(help="the workflow's note of its rules, results/<study>/workflow.txt")],
    out: Annotated[Path, typer.Option("-o", "--out", help="HTML page to write")] = Path("run_times.html"),
) -> None:
    """Write a page with the run time and memory of every rule, as Snakemake measured them; the workflow ends with it.

    Example: tread-validate run-times results/liu2010/workflow.txt -o reports/liu2010/run_times.html
    """
    from ..errors import InputError
    from ..report.run_times import write_run_times

    text = os.environ.get(BEGAN, "")
    try:
        began = float(text) if text else None
    except ValueError:
        raise InputError(BEGAN, text, "seconds of the epoch") from None
    write_run_times(graph, out, began)
    typer.echo(str(out))
