"""`tread-validate check`: did anything move since the accepted baseline?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    tables: Annotated[Path, typer.Argument(help="folder of the comparison's tables")] = Path("results/tables"),
    baseline: Annotated[Path, typer.Option("--baseline", help="folder of the baseline")] = Path("reports/baseline"),
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="delta table (CSV); delta.csv beside the tables if left out")
    ] = None,
    junit: Annotated[Path | None, typer.Option("--junit", help="also write JUnit XML")] = None,
    markdown: Annotated[Path | None, typer.Option("--markdown", help="also write a Markdown page")] = None,
    report_only: Annotated[bool, typer.Option("--report-only", help="end with 0 even where rows fail")] = False,
) -> None:
    """Compare the tables with the baseline, row by row and two-sided; ends with 1 where a row fails.

    Example: tread-validate check results/tables --junit check.xml --markdown check.md
    """
    from ..compare.baseline.delta import deltas
    from ..compare.baseline.output import delta_csv, delta_junit, delta_lines, delta_markdown, summary
    from ..compare.baseline.rows import rows_of_tables
    from ..compare.baseline.store import load_baseline, same_study
    from ..errors import CheckFailedError
    from ..files import write_text

    accepted = load_baseline(baseline)
    same_study(accepted, tables)
    rows = deltas(accepted.rows, rows_of_tables(tables))
    write_text(output or tables / "delta.csv", delta_csv(rows))
    if junit is not None:
        write_text(junit, delta_junit(rows))
    if markdown is not None:
        write_text(markdown, delta_markdown(rows, accepted.acceptance))
    for line in delta_lines(rows):
        typer.echo(line)
    if not report_only and any(not row.passed for row in rows):
        raise CheckFailedError(summary(rows))
    typer.echo(summary(rows))
