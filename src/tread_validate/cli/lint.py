"""`tread-validate lint`: read a deck back and say what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    files: Annotated[list[Path], typer.Argument(help="deck(s), .inp")],
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="print findings only")] = False,
) -> None:
    """Check decks: dangling names, unknown keywords or parameters, bad elements, misuse of VFRIC.

    Prints one line per finding (file:line: severity: message [rule]); ends with code 1 where there is an error.

    Example: tread-validate lint fe_inputs/rig-rectangle-22c-0p2mm-300rpm/rig-rectangle-22c-0p2mm-300rpm.inp
    """
    from ..deck.lint import lint
    from ..errors import CheckFailedError

    errors = 0
    for file in files:
        findings = lint(file)
        for finding in findings:
            typer.echo(str(finding))
        errors += sum(finding.severity == "error" for finding in findings)
        if not findings and not quiet:
            typer.echo(f"{file}: clean")
    if errors:
        raise CheckFailedError(f"lint: {errors} error(s) in {len(files)} deck(s)")
