"""`tread-validate references`: is the reference data what its package says?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    folder: Annotated[Path, typer.Argument(help="folder with datapackage.yaml")],
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write the list of tables to this file")] = None,
) -> None:
    """Check every reference table against its schema and checksum, and every FE run against its record.

    Example: tread-validate references reference_data
    """
    from ..files import write_text
    from ..reference import validate_package, validate_store

    checked = (*validate_package(folder), *validate_store(folder))
    lines = "".join(f"{name}: valid\n" for name in checked)
    if output is not None:
        write_text(output, lines)
    typer.echo(lines, nl=False)
