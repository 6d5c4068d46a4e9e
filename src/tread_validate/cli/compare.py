"""`tread-validate compare`: one predicted history against its reference."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    reference: Annotated[Path, typer.Argument(help="reference history (CSV)")],
    predicted: Annotated[Path, typer.Argument(help="predicted history (CSV)")],
    case_id: Annotated[str, typer.Option("--case", help="name of the case in the rows")] = "",
    uncertainty: Annotated[
        float | None,
        number("--uncertainty", "share", "relative uncertainty of the reference's forces"),
    ] = None,
    json: Annotated[bool, typer.Option("--json", help="JSON in place of CSV")] = False,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write to this file")] = None,
) -> None:
    """Compare two force histories: a row for every scalar and every history score.

    Example: tread-validate compare reference.csv predicted.csv --uncertainty 0.02
    """
    from json import dumps

    from ..compare import MetricRow, compare
    from ..compare.tables import rows_text
    from ..errors import InputError
    from ..files import write_text
    from ..history import History

    a, b = History.read_csv(reference), History.read_csv(predicted)
    cases = [name for each in (a, b) if (name := each.provenance.get("case_id", ""))]
    if not case_id and len(set(cases)) > 1:
        raise InputError("compare", f"histories of {cases[0]} and {cases[1]}", "two of one case, or --case NAME")
    name = case_id or (cases or [""])[0]
    rows = compare(
        a,
        b,
        case_id=name,
        reference_source=a.provenance.get("producer", reference.stem),
        predicted_source=b.provenance.get("producer", predicted.stem),
        uncertainty=uncertainty,
    )
    text = dumps([row.cells() for row in rows], indent=2) + "\n" if json else None
    text = text or rows_text(MetricRow, rows)
    if output is not None:
        write_text(output, text)
    else:
        typer.echo(text, nl=False)
