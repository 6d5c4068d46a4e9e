"""What a lint says: one line in one file, and how bad it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ...inp import DataLine, KeywordBlock

Severity = Literal["error", "warning"]


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
        ``error`` (ABAQUS would stop or compute something else) or ``warning``.
    """

    file: str
    line: int
    rule: str
    message: str
    severity: Severity = "error"

    def __str__(self) -> str:
        """``file:line: severity: message [rule]``."""
        return f"{self.file}:{self.line}: {self.severity}: {self.message} [{self.rule}]"


class Findings(list[Finding]):
    """A list of findings with a short way to add one."""

    def add(self, at: KeywordBlock | DataLine, rule: str, message: str, severity: Severity = "error") -> None:
        """Add a finding at a keyword or a data line."""
        line = at.line if isinstance(at, KeywordBlock) else at.number
        self.append(Finding(at.file, line, rule, message, severity))
