"""`tread-validate cases`: what a study asks for."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    as_json: Annotated[bool, typer.Option("--json", help="print JSON instead of a table")] = False,
    ids: Annotated[bool, typer.Option("--ids", help="print the case ids only, one a line")] = False,
    accept: Annotated[bool, typer.Option("--accept-fit", help="go on with a fit that is too far off")] = False,
) -> None:
    """List the cases of a study with their conditions.

    Example: tread-validate cases config/study.yaml
    """
    from ..study import load_study

    cases = load_study(study).cases()
    if ids:
        typer.echo("\n".join(case.case_id for case in cases))
        return
    rows = [case.conditions() for case in cases]
    if as_json:
        typer.echo(json.dumps(rows, indent=2))
        return
    columns = (
        "case_id", "path", "block", "temperature_degC", "interference_mm", "speed_m_s", "speed_rpm", "creep_percent",
    )  # fmt: skip
    cells = [list(columns)] + [[_cell(row[name], bool(row["free_rolling"])) for name in columns] for row in rows]
    widths = [max(len(line[i]) for line in cells) for i in range(len(columns))]
    for line in cells:
        typer.echo("  ".join(text.ljust(width) for text, width in zip(line, widths, strict=True)).rstrip())
    typer.echo(f"{len(cases)} cases")
    assumed = sorted({item for case in cases for item in case.assumed()})
    if assumed:
        typer.echo("assumed or synthetic inputs: " + "; ".join(assumed))
    from .laboratory import tell_worth

    tell_worth(cases, study, accept)


def _cell(value: object, free_rolling: bool) -> str:
    if value is None:
        return "free rolling" if free_rolling else "-"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
