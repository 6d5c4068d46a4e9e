"""The two ways a deck is written down: with parameters and include files, or in one file with every number in place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from ..provenance import sha256_text
from .keywords import comment, keyword, number

DIGITS = 10  # significant, of a value that the writer computes


@dataclass(frozen=True)
class Value:
    """A number of a deck that has a name.

    Attributes
    ----------
    name : str
        As ``*PARAMETER`` defines it.
    number : float
        In the deck's units.
    legend : str
        What it is, with its unit.
    formula : str or None
        How it follows from other names; None for one that is changed by hand.
    """

    name: str
    number: float
    legend: str
    formula: str | None = None


def exact(value: float) -> float:
    """Return `value` as a deck's text keeps it."""
    return float(number(value, DIGITS))


@dataclass
class Form:
    """Collects the include files of a deck, and writes its named numbers.

    Attributes
    ----------
    single_file : bool
        Whether numbers and included lines stand in the deck itself.
    files : dict of str to str
        Include files by name.
    """

    single_file: bool = False
    files: dict[str, str] = field(default_factory=dict)

    def put(self, value: Value) -> str:
        """Return what stands for a value in a line: its name in angle brackets, or the number."""
        return number(value.number, 13) if self.single_file else f"<{value.name}>"

    def include(self, name: str, lines: Sequence[str]) -> list[str]:
        """Return the lines themselves, or the line that includes them from a file of their own.

        The file is called ``<name>-<digest>.inp``: decks that share its content share the file.
        """
        if self.single_file:
            return list(lines)
        text = "\n".join(lines) + "\n"
        file = f"{name}-{sha256_text(text)[:10]}.inp"
        self.files[file] = text
        return [keyword("INCLUDE", INPUT=file)]

    def parameters(self, by_hand: Sequence[Value], derived: Sequence[Value]) -> list[str]:
        """Return the marked section at the top of a deck."""
        rule = comment("=" * 100)
        lines = [rule, comment("What may be changed by hand; everything below follows. See docs/decks.md.")]
        if self.single_file:
            lines += [comment(f"{value.name} = {number(value.number, 13)}  ({value.legend})") for value in by_hand]
            lines[1] = comment("The inputs of this deck. In this form each number stands where it is used.")
            return [*lines, rule]
        lines.append(keyword("PARAMETER"))
        for value in by_hand:
            lines += [comment(value.legend), f"{value.name} = {number(value.number, 13)}"]
        lines += [rule, comment("What follows from it; not to be changed."), keyword("PARAMETER")]
        for value in derived:
            lines += [comment(value.legend), f"{value.name} = {value.formula}"]
        return [*lines, rule]
