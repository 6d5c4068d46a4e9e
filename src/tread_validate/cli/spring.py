"""`tread-validate spring`: run the viscoelastic spring model."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from ..history import History
    from ..study import Case


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    case: Annotated[list[str] | None, typer.Option("--case", help="id of one case; may be given again")] = None,
    every: Annotated[bool, typer.Option("--all", help="every case of the study")] = False,
    variant: Annotated[
        list[str] | None,
        typer.Option(
            "--variant", help="variant of the model, `paper` if left out; may be given again; `list` names them"
        ),
    ] = None,
    output: Annotated[
        Path | None,
        typer.Option(
            "-o",
            "--output",
            help="folder for ID.csv and summary.csv (of several variants, a folder each in it); or one file, NAME.csv",
        ),
    ] = None,
) -> None:
    """Run the spring model for one case, or for all, and write force histories.

    Example: tread-validate spring config/study.yaml --case rig-rectangle-22c-0p2mm-300rpm
    """
    from ..errors import InputError
    from ..model_names import current_name
    from ..spring import resolve_creep, variants
    from ..study import load_study
    from ..workspace import Workspace

    names = list(dict.fromkeys(current_name(name) for name in variant or ("paper",)))
    if names == ["list"]:
        typer.echo("\n".join(f"{name}: {summary}" for name, summary in variants().items()))
        return
    for name in names:
        if name not in variants():
            raise InputError("--variant", name, f"one of {', '.join(variants())}")
    if bool(case) == every:
        raise InputError("spring", "both --case and --all" if every else "neither --case nor --all", "one of the two")
    loaded = load_study(study)
    cases = loaded.cases() if every else tuple(loaded.case(name) for name in dict.fromkeys(case or ()))
    home = Workspace(loaded.model.name).spring
    if len(names) == 1:
        places = {names[0]: home / names[0] if output is None else output}
    else:
        places = {name: (output or home) / name for name in names}
    if output is not None and output.suffix == ".csv" and len(cases) * len(names) != 1:
        what = f"{len(cases)} cases" if len(names) == 1 else f"{len(cases)} cases of {len(names)} variants"
        raise InputError("--output", output, f"a folder for {what}")
    cases = tuple(resolve_creep(cases))
    # every case runs before the first file is written, so that a wrong one leaves nothing behind
    made = {name: _run(cases, name, told=not every) for name in names}
    for name, (histories, rows) in made.items():
        _write(places[name], cases, histories, rows if every else None, name)


def _run(cases: Sequence[Case], variant: str, told: bool) -> tuple[list[History], list[dict[str, str]]]:
    """Run one variant; `told`: say of each case what came out."""
    from rich.console import Console
    from rich.progress import track

    from ..spring import run
    from ..spring.summary import summary_row
    from ..validity import with_expectation

    histories, rows = [], []
    console = Console(stderr=True)
    for one in track(cases, "spring", console=console, transient=True, disable=not sys.stderr.isatty()):
        history = with_expectation(run(one, variant), one, variant)
        histories.append(history)
        rows.append(summary_row(one, history, variant))
        if "caution" in history.provenance:
            typer.echo(f"{one.case_id}: caution: {history.provenance['caution']}", err=True)
        if told:
            typer.echo(
                f"{one.case_id}: creep ratio {one.creep_ratio:.5f}, "
                f"peak normal force {rows[-1]['peak_normal_force_N']} N\n  {history.provenance['expected_error']}"
            )
    return histories, rows


def _write(
    target: Path, cases: Sequence[Case], histories: Sequence[History], rows: list[dict[str, str]] | None, variant: str
) -> None:
    """Write the histories of one variant, and their summary where there are rows for it."""
    from ..files import write_text
    from ..spring.summary import summary_csv

    if target.suffix == ".csv":
        histories[0].with_checksum().write_csv(target)
        return
    for one, history in zip(cases, histories, strict=True):
        history.with_checksum().write_csv(target / f"{one.case_id}.csv")
    if rows is not None:
        write_text(target / "summary.csv", summary_csv(rows))
    typer.echo(f"{len(cases)} cases of variant {variant} in {target}")
