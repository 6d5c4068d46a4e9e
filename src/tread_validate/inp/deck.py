"""The text of a deck as keyword blocks, each line with its file and number."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

from ..errors import InputError

LARGEST_LABEL = 999_999_999  # of a node or element, as in ABAQUS


class DataLine(NamedTuple):
    """One data line below a keyword.

    Attributes
    ----------
    file : str
        Name of the file that holds the line.
    number : int
        Line number, from 1.
    text : str
        The line without its end.
    """

    file: str
    number: int
    text: str

    @property
    def where(self) -> str:
        """``file:line``, for messages."""
        return f"{self.file}:{self.number}"

    @property
    def fields(self) -> tuple[str, ...]:
        """The comma-separated fields, stripped; an empty field stays empty, one trailing comma ends the line."""
        parts = [part.strip() for part in self.text.split(",")]
        if len(parts) > 1 and not parts[-1]:
            parts.pop()
        return tuple(parts)

    def number_at(self, position: int, what: str, default: float | None = None) -> float:
        """Return field `position` (from 0) as a float; an absent or empty one gives `default`.

        Raises
        ------
        InputError
            The field is not a finite number, or is absent without a default.
        """
        fields = self.fields
        text = fields[position] if position < len(fields) else ""
        if not text and default is not None:
            return default
        try:
            value = float(text.upper().replace("D", "E"))
        except ValueError:
            raise InputError(f"{self.where}: field {position + 1}", text or "nothing", what) from None
        if value != value or value in (float("inf"), float("-inf")):
            raise InputError(f"{self.where}: field {position + 1}", text, f"{what}, finite")
        return value

    def integer_at(self, position: int, what: str, default: int | None = None) -> int:
        """Return field `position` (from 0) as an integer, as `number_at` does for floats."""
        fields = self.fields
        text = fields[position] if position < len(fields) else ""
        if not text and default is not None:
            return default
        try:
            value = int(text)
        except ValueError:
            raise InputError(f"{self.where}: field {position + 1}", text[:40] or "nothing", what) from None
        if abs(value) > LARGEST_LABEL:
            raise InputError(f"{self.where}: field {position + 1}", text[:40], f"{what}, at most {LARGEST_LABEL}")
        return value


@dataclass(frozen=True)
class Block:
    """A keyword line with its parameters and its data lines.

    Attributes
    ----------
    keyword : str
        Upper case, single spaces, without the star (``SOLID SECTION``).
    parameters : mapping of str to str or None
        Names in upper case with single spaces. A value keeps its quotes' content as written when quoted, else is
        upper case; a parameter without ``=`` has None.
    raw : mapping of str to str
        The values as written (file names keep their case).
    data : tuple of DataLine
        Comments and blank lines left out.
    """

    keyword: str
    parameters: Mapping[str, str | None]
    data: tuple[DataLine, ...]
    file: str
    line: int
    raw: Mapping[str, str] = field(default_factory=dict)

    @property
    def where(self) -> str:
        """``file:line`` of the keyword."""
        return f"{self.file}:{self.line}"

    def value(self, name: str, default: str | None = None) -> str:
        """Return the value of a parameter.

        Raises
        ------
        InputError
            The parameter is absent (and there is no default) or has no value.
        """
        if name not in self.parameters:
            if default is not None:
                return default
            raise InputError(f"{self.where}: *{self.keyword}", f"no parameter {name}", f"{name}=...")
        text = self.parameters[name]
        if not text:
            raise InputError(f"{self.where}: *{self.keyword}, {name}", "no value", f"{name}=...")
        return text


@dataclass(frozen=True)
class Deck:
    """A deck, its includes expanded.

    Attributes
    ----------
    path : Path
        The main file.
    blocks : tuple of Block
        In the order of the text.
    text : str
        The whole text, each ``*INCLUDE`` line followed by the text of its file.
    """

    path: Path
    blocks: tuple[Block, ...]
    text: str

    def named(self, *keywords: str) -> Iterator[Block]:
        """Yield the blocks of the given keywords, in order."""
        return (block for block in self.blocks if block.keyword in keywords)
