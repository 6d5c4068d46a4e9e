"""Checks a deck as ABAQUS would, line by line, through a reader that the deck writer does not use."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal

from ...errors import InputError
from ...inp import read_deck
from ...inp.parameters import MARK
from .contact_rules import check_contact
from .findings import Finding, Findings, LintRule, catalogue, find_rule
from .mesh_rules import check_mesh
from .motion_rules import check_motion, check_steps
from .names import collect, unique
from .output import FORMATS, formatted
from .syntax import check_syntax, repaired

__all__ = ["FORMATS", "Dialect", "Finding", "LintRule", "catalogue", "find_rule", "formatted", "lint"]

Dialect = Literal["abaqus", "calculix"]
LENIENT = frozenset({"duplicate-name", "two-laws", "two-sections", "wrong-place", "step-order"})
"""Rules about what CalculiX takes with a word: the later of what is given twice, history data after a step."""


def lint(
    path: Path | str, dialect: Dialect = "abaqus", select: Sequence[str] = (), ignore: Sequence[str] = ()
) -> list[Finding]:
    """Return the findings of a deck, in the order of its lines; none for a clean deck.

    Parameters
    ----------
    path : Path or str
        The deck; what it includes is checked with it, at its own lines.
    dialect : str
        ``abaqus``, or ``calculix`` for decks of that program: its keywords, without the rules of ABAQUS/Explicit.
    select, ignore : sequences of str
        Codes (``TV101``), beginnings of codes (``TV1``) or names of rules; with `select` only those are kept, those
        of `ignore` are left out.

    Raises
    ------
    InputError
        The file is missing, empty or binary, or a code names no rule.
    """
    chosen, left = _rules(select), _rules(ignore)
    findings = Findings()
    instances: list[str] = []
    mild = "warning" if dialect == "calculix" else None  # it passes over lines before the first keyword

    def report(rule: str, where: str, found: object, expected: str) -> None:
        findings.at(where, rule, found, expected, mild if rule == "syntax" else None)  # type: ignore[arg-type]  # one of two literals

    try:
        deck = read_deck(path, report)
    except InputError as error:
        located = re.fullmatch(r"(.+?):(\d+)(?::.*)?", error.where)
        if located is None:
            raise
        message = f"{error.where.split(': ', 1)[-1]}: {error.found}, expected {error.expected}"
        findings[:] = [one for one in findings if one.rule != "syntax"]  # what stopped the reader says it all
        findings.append(Finding(located[1], int(located[2]), "syntax", message))
    else:
        instances = [name for _, name in deck.instances]
        check_syntax(deck, findings, dialect)
        deck = repaired(deck, dialect)
        if not deck.parameters and next(deck.named("STEP"), None) is None:  # to be included where they are defined
            findings[:] = [one for one in findings if one.rule != "parameter"]
        names = collect(deck, findings, dialect)
        check_mesh(deck, names, findings)
        if dialect == "abaqus":
            check_motion(deck, names, findings)
            check_contact(deck, names, findings)
        else:
            check_steps(deck, findings)
        # what is said of a name in place of its value follows from the name
        findings[:] = [one for one in findings if one.rule == "parameter" or not MARK.search(one.message)]
    if dialect == "calculix":
        findings[:] = [replace(one, severity="warning") if one.rule in LENIENT else one for one in findings]
    kept = [one for one in findings if (not chosen or one.rule in chosen) and one.rule not in left]
    return unique(kept, instances)


def _rules(words: Sequence[str]) -> set[str]:
    """Return the names of the rules that codes, beginnings of codes or names stand for."""
    found: set[str] = set()
    for word in words:
        mine = {rule.name for rule in catalogue().values() if word == rule.name or rule.code.startswith(word.upper())}
        if not mine:
            raise InputError("lint", word, "a code such as TV101, the beginning of one, or the name of a rule")
        found |= mine
    return found
