"""`tread-validate lint`: read a deck back and say what is wrong with it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def command(
    files: Annotated[list[Path] | None, typer.Argument(help="deck(s), .inp")] = None,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="print findings only")] = False,
    dialect: Annotated[str, typer.Option("--dialect", help="abaqus, or calculix for decks of that program")] = "abaqus",
    form: Annotated[str, typer.Option("--format", help="text, json, sarif (for code hosts) or github")] = "text",
    select: Annotated[
        list[str] | None, typer.Option("--select", help="keep these rules only: code, beginning of one, or name")
    ] = None,
    ignore: Annotated[list[str] | None, typer.Option("--ignore", help="leave these rules out")] = None,
    explain: Annotated[str | None, typer.Option("--explain", help="say what a code such as TV012 means")] = None,
) -> None:
    """Check decks: names that nothing defines, misspelt keywords, bad elements, misuse of VFRIC.

    Prints one line per finding (file:line: severity: message [code rule]); errors end with code 1, warnings and notes
    (what the lint does not know) with 0.

    Example: tread-validate lint fe_inputs/rig-rectangle-22c-0p2mm-300rpm/rig-rectangle-22c-0p2mm-300rpm.inp
    """
    from dataclasses import replace

    from ..deck.lint import FORMATS, find_rule, formatted, lint
    from ..errors import CheckFailedError, InputError, one_line

    if explain is not None:
        rule = find_rule(explain)
        if rule is None:
            raise InputError("lint --explain", one_line(explain, 40), "a code such as TV012, or the name of a rule")
        typer.echo(f"{rule.code} {rule.name} ({rule.severity}): {rule.title}\n\n{rule.help}")
        return
    if not files:
        raise InputError("lint", "no deck", "one or more .inp files, or --explain CODE")
    if dialect not in ("abaqus", "calculix"):
        raise InputError("lint --dialect", one_line(dialect, 40), "abaqus or calculix")
    if form not in FORMATS:
        raise InputError("lint --format", one_line(form, 40), ", ".join(FORMATS))
    found = []
    for file in files:
        mine = lint(file, dialect, select or (), ignore or ())  # type: ignore[arg-type]  # typer gives plain text; lint checks it
        found += [replace(one, file=str(file.parent / one.file)) for one in mine] if form != "text" else mine
        if form == "text":
            for finding in mine:
                typer.echo(str(finding))
            if not quiet:
                counts = [(sum(one.severity == word for one in mine), word) for word in ("error", "warning", "note")]
                said = ", ".join(f"{count} {word}(s)" for count, word in counts if count) or "clean"
                typer.echo(f"{file}: {said} (read as {dialect})")
    if form != "text" and (found or form != "github"):
        typer.echo(formatted(found, form))
    errors = sum(finding.severity == "error" for finding in found)
    if errors:
        raise CheckFailedError(f"lint: {errors} error(s) in {len(files)} deck(s)")
