"""`tread-validate new-model`: a working model to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    name: Annotated[str, typer.Argument(help="small letters, digits, _")],
    kind: Annotated[str, typer.Option("--kind", help="python, command (C), octave or histories")] = "python",
    output: Annotated[Path | None, typer.Option("-o", "--output", help="folder [default: NAME]")] = None,
) -> None:
    """Write a small model that works, a study that runs it, and a test.

    Example: tread-validate new-model mine --kind command
    """
    from ..errors import InputError, one_line
    from ..models.skeleton import KINDS, write_skeleton

    folder = output if output is not None else Path(name)
    chosen = next((known for known in KINDS if known == kind), None)
    if chosen is None:
        raise InputError("--kind", one_line(kind, 40), f"one of {', '.join(KINDS)}")
    for path in write_skeleton(folder, name, chosen):
        typer.echo(path)
