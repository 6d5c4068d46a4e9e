"""`tread-validate spring`: run the viscoelastic spring model."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    case: Annotated[list[str] | None, typer.Option("--case", help="id of one case; may be given again")] = None,
    every: Annotated[bool, typer.Option("--all", help="every case of the study")] = False,
    variant: Annotated[str, typer.Option("--variant", help="variant of the model; `list` names them")] = "paper",
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="folder for ID.csv and summary.csv; or one case's file, ending in .csv"),
    ] = None,
) -> None:
    """Run the spring model for one case, or for all, and write force histories.

    Example: tread-validate spring config/study.yaml --case rig-rectangle-22c-0p2mm-300rpm
    """
    from rich.console import Console
    from rich.progress import track

    from ..errors import InputError
    from ..files import write_text
    from ..model_names import current_name
    from ..spring import resolve_creep, run, variants
    from ..spring.summary import summary_csv, summary_row
    from ..study import load_study
    from ..validity import with_expectation
    from ..workspace import Workspace

    if variant == "list":
        typer.echo("\n".join(f"{name}: {summary}" for name, summary in variants().items()))
        return
    variant = current_name(variant)
    if variant not in variants():
        raise InputError("--variant", variant, f"one of {', '.join(variants())}")
    if bool(case) == every:
        raise InputError("spring", "both --case and --all" if every else "neither --case nor --all", "one of the two")
    loaded = load_study(study)
    cases = loaded.cases() if every else tuple(loaded.case(name) for name in dict.fromkeys(case or ()))
    target = output if output is not None else Workspace(loaded.model.name).spring / variant
    one_file = target.suffix == ".csv"
    if one_file and len(cases) != 1:
        raise InputError("--output", target, f"a folder for {len(cases)} cases")
    console = Console(stderr=True)
    cases = resolve_creep(cases)
    histories, rows = [], []
    # every case runs before the first file is written, so that a wrong one leaves nothing behind
    for one in track(cases, "spring", console=console, transient=True, disable=not sys.stderr.isatty()):
        history = with_expectation(run(one, variant), one, variant)
        histories.append(history)
        rows.append(summary_row(one, history, variant))
        if "caution" in history.provenance:
            typer.echo(f"{one.case_id}: caution: {history.provenance['caution']}", err=True)
        if not every:
            typer.echo(
                f"{one.case_id}: creep ratio {one.creep_ratio:.5f}, "
                f"peak normal force {rows[-1]['peak_normal_force_N']} N\n  {history.provenance['expected_error']}"
            )
    if one_file:
        histories[0].with_checksum().write_csv(target)
        return
    for one, history in zip(cases, histories, strict=True):
        history.with_checksum().write_csv(target / f"{one.case_id}.csv")
    if every:
        write_text(target / "summary.csv", summary_csv(rows))
    typer.echo(f"{len(cases)} cases of variant {variant} in {target}")
