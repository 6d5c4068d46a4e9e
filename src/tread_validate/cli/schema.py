"""`tread-validate schema`: the JSON schema of a study file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write to this file, not to the screen")] = None,
) -> None:
    """Write the JSON schema of a study file, generated from the models.

    Example: tread-validate schema -o workflow/schemas/study.schema.json
    """
    from ..files import write_text
    from ..study.schema import study_schema

    text = study_schema()
    if output is None:
        typer.echo(text, nl=False)
    else:
        write_text(output, text)
