"""`tread-validate strain-effect`: how far a linear compound is off at the strain of each run."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .options import number


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    sweep: Annotated[Path, typer.Option("--sweep", help="strain sweep: strain and storage modulus, text or .xlsx")],
    linear: Annotated[
        float, number("--linear-percent", "strain_percent", "strain at which the compound's moduli were measured, %")
    ] = 0.5,
    case: Annotated[list[str] | None, typer.Option("--case", help="id of one case; all if left out")] = None,
    unit: Annotated[str | None, typer.Option("--modulus-unit", help="Pa, kPa, MPa or GPa, whatever the header")] = None,
    column: Annotated[list[str] | None, typer.Option("--column", help="KEY=COLUMN: strain, storage")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write the table (CSV) here")] = None,
) -> None:
    """Take the secant modulus at each run's strain from a strain sweep; run the paper's spring with it and without.

    The strain of a run is its largest compression over the block's height. The compound's series is scaled as a whole.

    Example: tread-validate strain-effect config/study.yaml --sweep payne.csv
    """
    from ..files import write_text
    from ..instrument.quantities import STRAIN_SWEEP
    from ..material.strain_sweep import read_strain_sweep
    from ..spring import resolve_creep
    from ..spring.strain import strain_effect
    from ..study import load_study
    from .laboratory import reading_of

    data = read_strain_sweep(sweep, reading_of(column, {"--modulus-unit": unit}, STRAIN_SWEEP))
    loaded = load_study(study)
    chosen = tuple(loaded.case(name) for name in dict.fromkeys(case)) if case else loaded.cases()
    rows = [strain_effect(one, data, 0.01 * linear) for one in resolve_creep(chosen)]
    for line in data.understood:
        typer.echo(f"read: {line}")
    lines = ["case_id,strain_percent,secant_factor,peak_normal_force_N,peak_normal_force_secant_N,change_percent"]
    lines += [
        f"{row.case_id},{100 * row.strain:.4g},{row.factor:.4f},{row.linear_force:.3f},{row.secant_force:.3f},"
        f"{100 * row.change:.2f}"
        for row in rows
    ]
    if output is not None:
        write_text(output, "\n".join(lines) + "\n")
        typer.echo(f"wrote {output}")
    else:
        typer.echo("\n".join(lines))
    worst = max(rows, key=lambda row: abs(row.change))
    typer.echo(
        f"a linear compound is off by up to {100 * worst.change:+.1f} % in peak normal force ({worst.case_id}, strain "
        f"{100 * worst.strain:.3g} % against {linear:g} %)"
    )
