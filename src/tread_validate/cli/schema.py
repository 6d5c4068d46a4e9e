"""`tread-validate schema`: the JSON schema of a study, case, material or friction file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    kind: Annotated[str, typer.Argument(help="study, case, material or friction")] = "study",
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write to this file, not to the screen")] = None,
) -> None:
    """Write the JSON schema of a study, case, material or friction file, generated from the models.

    Example: tread-validate schema -o study.schema.json
    """
    import json

    from ..errors import InputError, one_line
    from ..files import write_text

    if kind == "study":
        from ..study.schema import study_schema

        text = study_schema()
    elif kind == "case":
        from ..case_file.io import case_schema

        text = case_schema()
    elif kind == "material":
        from ..material import material_schema

        text = json.dumps(material_schema(), indent=2) + "\n"
    elif kind == "friction":
        from ..friction import friction_schema

        text = json.dumps(friction_schema(), indent=2) + "\n"
    else:
        raise InputError("schema", one_line(kind, 40), "study, case, material or friction")
    if output is None:
        typer.echo(text, nl=False)
    else:
        write_text(output, text)
