"""`tread-validate check`: did anything move since the accepted baseline?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    tables: Annotated[
        Path | None, typer.Argument(help="folder of the comparison's tables [default: the only one in results]")
    ] = None,
    baseline: Annotated[
        Path | None, typer.Option("--baseline", help="folder of the baseline [default: the study's, in reports]")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="delta table (CSV); delta.csv beside the tables if left out")
    ] = None,
    junit: Annotated[Path | None, typer.Option("--junit", help="also write JUnit XML")] = None,
    markdown: Annotated[Path | None, typer.Option("--markdown", help="also write a Markdown page")] = None,
    page: Annotated[str, typer.Option("--page", help="address of the report, for links in the Markdown")] = "",
    report_only: Annotated[bool, typer.Option("--report-only", help="end with 0 even where rows fail")] = False,
) -> None:
    """Compare the tables with the baseline, cell by cell and two-sided; ends with 1 where one fails.

    Flipped assessments come first, then what they depend on, then what moved, then what follows from that.

    Example: tread-validate check results/liu2010/tables --junit check.xml --markdown check.md
    """
    from ..compare.baseline.delta import check_tables
    from ..compare.baseline.movement import movements
    from ..compare.baseline.output import delta_csv, delta_junit, delta_lines, delta_markdown, summary
    from ..compare.baseline.store import load_baseline, same_study
    from ..compare.binding import todays_tables
    from ..compare.summary import write_summary
    from ..errors import CheckFailedError
    from ..files import write_text
    from ..workspace import Workspace, only_tables

    tables = tables or only_tables()
    facts = todays_tables(tables)
    accepted = load_baseline(baseline or Workspace(facts.study).baseline)
    same_study(accepted, tables)
    found = check_tables(accepted, tables)
    write_text(output or tables / "delta.csv", delta_csv(found))
    if junit is not None:
        sources = dict.fromkeys(row["source"] for row in accepted.tables["peaks"])
        write_text(junit, delta_junit(found, [("peaks", source) for source in sources]))
    moved = movements(accepted, tables)
    if markdown is not None:
        write_text(markdown, delta_markdown(found, accepted.acceptance, moved, page))
    write_summary(tables, facts.study, found, moved)
    for line in delta_lines(found):
        typer.echo(line)
    if not report_only and found.failed:
        raise CheckFailedError(summary(found))
    typer.echo(summary(found))
