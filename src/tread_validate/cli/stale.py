"""`tread-validate stale`: which FE references no longer belong to their decks?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    decks: Annotated[Path, typer.Option("--decks", help="folder of the generated decks")] = Path("fe_inputs"),
    references: Annotated[Path, typer.Option("--references", help="the reference folder")] = Path("reference_data"),
    engine: Annotated[str | None, typer.Option("--engine", help="whose runs; the study's engine if left out")] = None,
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write the case ids to this file")] = None,
) -> None:
    """List the cases whose FE reference is missing, stale or corrupt, with the reason.

    Example: tread-validate stale config/study.yaml --decks fe_inputs
    """
    from ..files import read_text, write_text
    from ..provenance import deck_digest
    from ..reference import load_fe
    from ..study import load_study

    loaded = load_study(study)
    chosen = engine or loaded.model.engine
    cases = loaded.cases()
    listed: list[str] = []
    for case in cases:
        folder = decks / case.case_id
        digest = deck_digest(read_text(folder / f"{case.case_id}.inp"), read_text(folder / "vfric.f"))
        reference = load_fe(references, chosen, case.case_id, digest)
        if reference.status != "current":
            listed.append(case.case_id)
            typer.echo(f"{case.case_id}: {reference.status}, {reference.reason}")
    typer.echo(f"{len(cases) - len(listed)} of {len(cases)} references of engine {chosen} are current")
    if output is not None:
        write_text(output, "".join(f"{case_id}\n" for case_id in listed))
