"""`tread-validate references`: is the reference data what its package says?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    folder: Annotated[Path, typer.Argument(help="folder with datapackage.yaml")],
    output: Annotated[Path | None, typer.Option("-o", "--output", help="write the list of tables to this file")] = None,
) -> None:
    """Check every reference table against its schema and checksum, and list FE runs that do not fit their records.

    Example: tread-validate references reference_data
    """
    from ..files import write_text
    from ..reference import FeStore, validate_package

    checked = [(name, "valid") for name in validate_package(folder)]
    checked += FeStore(folder).check()
    lines = "".join(f"{name}: {state}\n" for name, state in checked)
    if output is not None:
        write_text(output, lines)
    typer.echo(lines, nl=False)
