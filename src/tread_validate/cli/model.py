"""`tread-validate model`: run a model of the user's own."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    name: Annotated[str, typer.Option("--model", help="name of the model under `models:` in the study")],
    output: Annotated[
        Path, typer.Option("-o", "--output", help="folder for ID.csv, ID.json (outcome and cost), logs, summary.csv")
    ],
    case: Annotated[list[str] | None, typer.Option("--case", help="id of one case; may be given again")] = None,
    jobs: Annotated[int, typer.Option("--jobs", min=1, max=256, help="cases at a time (commands of one case)")] = 1,
    report_only: Annotated[bool, typer.Option("--report-only", help="end with 0 even where every case failed")] = False,
    trust_models: Annotated[
        bool, typer.Option("--trust-models", help="run what the study names as command or Python object")
    ] = False,
) -> None:
    """Run a model that the study names on every case, or on some, and check each history against its case.

    A case on which the model fails is said and loses nothing but itself; the verb ends with 0 as long as one case ran.

    Example: tread-validate model study.yaml --model mine -o results/mine --trust-models
    """
    from rich.console import Console
    from rich.progress import track

    from ..errors import EngineError
    from ..files import write_text
    from ..models.run import run_model
    from ..models.summary import summary_csv
    from ..spring import resolve_creep
    from ..study import load_study

    loaded = load_study(study)
    cases = tuple(loaded.case(one) for one in dict.fromkeys(case)) if case else loaded.cases()
    console = Console(stderr=True)
    quiet = not sys.stderr.isatty()
    outcomes = run_model(
        loaded,
        name,
        resolve_creep(cases),
        output,
        trusted=trust_models,
        jobs=jobs,
        progress=lambda items: iter(track(items, f"model {name}", console=console, transient=True, disable=quiet)),
    )
    write_text(output / "summary.csv", summary_csv(outcomes, output))
    failed = [outcome for outcome in outcomes if outcome.status == "failed"]
    for outcome in failed:
        typer.echo(f"{name}, {outcome.case_id}: {outcome.message}", err=True)
    typer.echo(f"{len(outcomes) - len(failed)} of {len(outcomes)} cases of model {name} in {output}")
    if len(failed) == len(outcomes) and not report_only:
        raise EngineError(f"model {name}: all {len(outcomes)} cases failed; the first: {failed[0].message}")
