"""What a lint says: one line in one file, by which rule, and how bad it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Literal

from ...inp import DataLine, KeywordBlock
from ...yaml_text import load_yaml

Severity = Literal["error", "warning", "note"]


@dataclass(frozen=True)
class LintRule:
    """A rule of the catalogue ``rules.yaml``."""

    code: str
    name: str
    severity: Severity
    title: str
    help: str


@cache
def catalogue() -> dict[str, LintRule]:
    """Return every rule by its name."""
    text = (files("tread_validate.deck.lint") / "rules.yaml").read_text(encoding="utf-8")
    return {
        entry["rule"]: LintRule(code, entry["rule"], entry["severity"], entry["title"], entry["help"])
        for code, entry in load_yaml(text, "rules.yaml", fast=True).items()
    }


def find_rule(text: str) -> LintRule | None:
    """Return the rule of a code (``TV012``) or name (``missing-include``)."""
    return next((rule for rule in catalogue().values() if text.upper() == rule.code or text == rule.name), None)


@dataclass(frozen=True, order=True)
class Finding:
    """One fault of a deck.

    Attributes
    ----------
    file : str
        File that holds the line.
    line : int
        Line number, from 1.
    rule : str
        Short name of the rule (``dangling-nset``).
    message : str
        What is wrong and what was expected.
    severity : str
        ``error`` (ABAQUS would stop or compute something else), ``warning`` or ``note`` (not checked).
    """

    file: str
    line: int
    rule: str
    message: str
    severity: Severity = "error"

    @property
    def code(self) -> str:
        """Code of the rule (``TV101``)."""
        return catalogue()[self.rule].code

    def __str__(self) -> str:
        """``file:line: severity: message [code rule]``."""
        return f"{self.file}:{self.line}: {self.severity}: {self.message} [{self.code} {self.rule}]"


class Findings(list[Finding]):
    """A list of findings with a short way to add one."""

    def add(self, at: KeywordBlock | DataLine, rule: str, message: str, severity: Severity | None = None) -> None:
        """Add a finding at a keyword or a data line, as bad as its rule unless said otherwise."""
        line = at.line if isinstance(at, KeywordBlock) else at.number
        self.append(Finding(at.file, line, rule, message, severity or catalogue()[rule].severity))

    def at(self, where: str, rule: str, found: object, expected: str, severity: Severity | None = None) -> None:
        """Add a finding as the reader reports it: a place ``file:line`` or ``file:line: *KEYWORD``."""
        file, _, rest = where.partition(":")
        number = rest.split(":", 1)[0].strip()
        line = int(number) if number.isdigit() else 1
        what = f"{where.split(': ', 1)[1]}: " if ": " in where else ""
        message = f"{what}{found}: expected {expected}"
        self.append(Finding(file, line, rule, message, severity or catalogue()[rule].severity))
