"""`tread-validate case`: a case as data, for a model in any language."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    study: Annotated[Path, typer.Argument(help="study file (YAML)")],
    case: Annotated[list[str] | None, typer.Option("--case", help="id of one case; may be given again")] = None,
    every: Annotated[bool, typer.Option("--all", help="every case of the study")] = False,
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="folder for ID.json; or one case's file, ending in .json; else the screen"),
    ] = None,
) -> None:
    """Write all that a model needs to compute a pass, in SI, as JSON.

    Example: tread-validate case config/study.yaml --case rig-rectangle-22c-0p2mm-300rpm -o case.json
    """
    from ..case_file.build import case_file
    from ..case_file.io import case_json
    from ..errors import InputError
    from ..files import write_text
    from ..spring import resolve_creep
    from ..study import load_study, problems_digest

    if bool(case) == every:
        raise InputError("case", "both --case and --all" if every else "neither --case nor --all", "one of the two")
    loaded = load_study(study)
    cases = loaded.cases() if every else tuple(loaded.case(name) for name in dict.fromkeys(case or ()))
    one_file = output is not None and output.suffix == ".json"
    if (output is None or one_file) and len(cases) != 1:
        raise InputError("--output", output or "the screen", f"a folder for {len(cases)} cases")
    texts = {one.case_id: case_json(case_file(one)) for one in resolve_creep(cases)}
    if output is None:
        typer.echo("".join(texts.values()), nl=False)
        return
    for case_id, text in texts.items():
        write_text(output if one_file else output / f"{case_id}.json", text)
    typer.echo(f"{len(texts)} cases in {output}; problems digest {problems_digest(loaded.cases())}")
