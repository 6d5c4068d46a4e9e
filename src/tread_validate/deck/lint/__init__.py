"""Checks a deck as ABAQUS would, line by line, through a reader that the deck writer does not use."""

from __future__ import annotations

import re
from pathlib import Path

from ...errors import InputError
from ...inp import read_deck
from .contact_rules import check_contact
from .findings import Finding, Findings
from .mesh_rules import check_mesh
from .motion_rules import check_motion
from .names import collect
from .syntax import check_syntax

__all__ = ["Finding", "lint"]


def lint(path: Path | str) -> list[Finding]:
    """Return the findings of a deck, in the order of its lines; none for a clean deck.

    Knows flat decks. Names inside ``*PART`` and ``*INSTANCE`` are not followed; such a deck is checked for form only
    and says so in a warning.

    Raises
    ------
    InputError
        The file is missing, empty or binary.
    """
    findings = Findings()
    try:
        deck = read_deck(path)
    except InputError as error:
        located = re.fullmatch(r"(.+?):(\d+)(?::.*)?", error.where)
        if located is None:
            raise
        message = f"{error.where.split(': ', 1)[-1]}: {error.found}, expected {error.expected}"
        return [Finding(located[1], int(located[2]), "syntax", message)]
    check_syntax(deck, findings)
    parts = next(deck.named("PART", "INSTANCE", "ASSEMBLY"), None)
    if parts is not None:
        findings.add(parts, "parts", "parts and instances: checked for form only, names are not followed", "warning")
    else:
        names = collect(deck, findings)
        check_mesh(deck, names, findings)
        check_motion(deck, names, findings)
        check_contact(deck, names, findings)
    return sorted(set(findings))
