"""`tread-validate badge`: the assessment as a small picture."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    summary: Annotated[Path, typer.Argument(help="summary.json beside the tables, after a check")],
    output: Annotated[Path, typer.Option("-o", "--output", help="badge.svg, or badge.json for a shields.io endpoint")],
    model: Annotated[
        str, typer.Option("--model", help="how one model does, in place of what moved since the baseline")
    ] = "",
) -> None:
    """Write a badge: whether assessments flipped since the baseline, or in how many cases a model is good enough.

    Example: tread-validate badge results/liu2010/tables/summary.json -o badge.svg
    """
    from ..compare.badge import badge_of
    from ..errors import InputError
    from ..files import write_text

    if output.suffix not in (".svg", ".json"):
        raise InputError("--output", output, "a file ending in .svg or .json")
    badge = badge_of(summary, model)
    write_text(output, badge.as_svg() if output.suffix == ".svg" else badge.as_json())
    typer.echo(f"{badge.label}: {badge.message}")
