"""`tread-validate check-model`: the loop of a model's developer."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    model: Annotated[
        list[str] | None,
        typer.Option("--model", help="spring variant, or model of the study; repeatable; all if left out"),
    ] = None,
    case: Annotated[
        list[str] | None, typer.Option("--case", help="id of one case; repeatable; all if left out")
    ] = None,
    references: Annotated[Path, typer.Option("--references", help="the reference data package")] = Path(
        "reference_data"
    ),
    baseline: Annotated[
        Path | None, typer.Option("--baseline", help="folder of the baseline [default: the study's, in reports]")
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="folder for runs, tables, check.md, junit.xml [default: in results]"),
    ] = None,
    page: Annotated[
        str, typer.Option("--page", help="address of the report, for links in check.md [default: the study's page]")
    ] = "",
    jobs: Annotated[int, typer.Option("--jobs", min=1, max=256, help="cases at a time (commands of one case)")] = 1,
    trust_models: Annotated[
        bool, typer.Option("--trust-models", help="run what the study names as command or Python object")
    ] = False,
) -> None:
    """Run only what one model needs, compare it, and say what moved since the baseline: assessments first.

    Ends with 1 where something moved, 3 where nothing could be compared.

    Example: tread-validate check-model config/study.yaml --model paper
    """
    import os

    from ..compare.baseline.output import delta_csv, delta_junit, delta_markdown, summary
    from ..errors import CheckFailedError, EngineError
    from ..files import write_text
    from ..model_check import LoopPlaces, check_models
    from ..model_told import told
    from ..study import load_study
    from ..workspace import Workspace

    loaded = load_study(study)
    place = Workspace(loaded.model.name)
    folder = output or place.results / "model_check"
    places = LoopPlaces(folder, references, baseline or place.baseline)
    done = check_models(loaded, model or (), case or (), places, trusted=trust_models, jobs=jobs)
    shown = place.reports / "index.html"
    link = page or (Path(os.path.relpath(shown, folder)).as_posix() if shown.is_file() else "")
    for line in told(done):
        typer.echo(line)
    if done.check is not None and done.acceptance is not None:
        write_text(folder / "delta.csv", delta_csv(done.check))
        write_text(folder / "check.md", delta_markdown(done.check, done.acceptance, done.moved, link))
        write_text(folder / "junit.xml", delta_junit(done.check, [("peaks", name) for name in done.accepted]))
        typer.echo(f"{folder / 'check.md'}, delta.csv, junit.xml, tables/")
    if not done.compared:
        raise EngineError("nothing could be compared: no reference of the same problem (make reference)")
    if done.check is not None and done.check.failed:
        raise CheckFailedError(summary(done.check))
