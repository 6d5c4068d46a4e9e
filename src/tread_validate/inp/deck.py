"""The text of a deck as keyword blocks, each line with its file and number."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple, overload

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
        The line without its end, parameters in it replaced by their values.
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
        parts = [part.strip() for part in split_commas(self.text)]
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
            value = to_float(text)
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


class Lines(Sequence[DataLine]):
    """The data lines of a block: texts and line numbers, made into `DataLine` one at a time.

    Parameters
    ----------
    file : str or sequence of str
        The file of all of them, or of each.
    numbers : sequence of int
        Line number of each text.
    texts : sequence of str
    """

    __slots__ = ("file", "numbers", "texts")

    def __init__(self, file: str | Sequence[str], numbers: Sequence[int] = (), texts: Sequence[str] = ()) -> None:
        self.file = file
        self.numbers = numbers
        self.texts = texts

    def with_texts(self, texts: Sequence[str]) -> Lines:
        """Return the same places with other texts."""
        return Lines(self.file, self.numbers, texts)

    def file_of(self, index: int) -> str:
        """Return the file of one line."""
        return self.file if isinstance(self.file, str) else self.file[index]

    def __len__(self) -> int:
        return len(self.texts)

    @overload
    def __getitem__(self, index: int) -> DataLine: ...

    @overload
    def __getitem__(self, index: slice) -> Lines: ...

    def __getitem__(self, index: int | slice) -> DataLine | Lines:
        if isinstance(index, slice):
            file = self.file if isinstance(self.file, str) else self.file[index]
            return Lines(file, self.numbers[index], self.texts[index])
        return DataLine(self.file_of(index), self.numbers[index], self.texts[index])

    def __iter__(self) -> Iterator[DataLine]:
        files = itertools.repeat(self.file) if isinstance(self.file, str) else self.file
        return map(DataLine, files, self.numbers, self.texts)


@dataclass(frozen=True)
class KeywordBlock:
    """A keyword line with its parameters and its data lines.

    Attributes
    ----------
    keyword : str
        Full name, upper case, single spaces, without the star (``SOLID SECTION``).
    parameters : mapping of str to str or None
        Full names in upper case with single spaces. A value keeps its quotes' content as written when quoted, else is
        upper case; a parameter without ``=`` has None.
    raw : mapping of str to str
        The values as written (file names keep their case).
    data : sequence of DataLine
        Comments and blank lines left out.
    """

    keyword: str
    parameters: Mapping[str, str | None]
    data: Lines
    file: str
    line: int
    raw: Mapping[str, str] = field(default_factory=dict)

    @property
    def where(self) -> str:
        """``file:line`` of the keyword."""
        return f"{self.file}:{self.line}"

    @property
    def text(self) -> str:
        """The keyword line, spelt out."""
        parts = [f"*{self.keyword}"]
        for name, value in self.parameters.items():
            if value is None:
                parts.append(name)
                continue
            written = self.raw.get(name, value)
            parts.append(f'{name}="{written}"' if "," in written or value != written.upper() else f"{name}={written}")
        return ", ".join(parts)

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
    """A deck, its includes and parameters expanded and its part instances placed.

    Attributes
    ----------
    path : Path
        The main file.
    blocks : tuple of KeywordBlock
        In the order of the text, without parameters, parts, instances, assemblies and coordinate systems: those are
        resolved (see `assembly`).
    written : tuple of KeywordBlock
        The blocks as they are written, parts and all.
    text : str
        The whole text, each ``*INCLUDE`` line followed by the text of its file.
    parameters : mapping of str to float, int or str
        What ``*PARAMETER`` defines.
    gaps : tuple of str
        What keeps the deck from being known in full (a missing include), for readers that go on all the same.
    instances : tuple of (first label, name)
        Where the labels of each part instance begin, in rising order; empty for a flat deck.
    files : tuple of Path
        Every file that was read, the main one first.
    """

    path: Path
    blocks: tuple[KeywordBlock, ...]
    text: str
    written: tuple[KeywordBlock, ...] = ()
    parameters: Mapping[str, float | int | str] = field(default_factory=dict)
    gaps: tuple[str, ...] = ()
    instances: tuple[tuple[int, str], ...] = ()
    files: tuple[Path, ...] = ()

    def named(self, *keywords: str) -> Iterator[KeywordBlock]:
        """Yield the blocks of the given keywords, in order."""
        return (block for block in self.blocks if block.keyword in keywords)

    def label_name(self, label: int) -> str:
        """Return a node or element label as its part instance knows it (``RIM-1.17``; ``17`` in a flat deck)."""
        for first, name in reversed(self.instances):
            if label > first:
                return f"{name}.{label - first}" if name else str(label - first)
        return str(label)


def split_commas(text: str) -> list[str]:
    """Split at commas outside double quotes."""
    if '"' not in text:
        return text.split(",")
    parts, quoted, start = [], False, 0
    for position, letter in enumerate(text):
        if letter == '"':
            quoted = not quoted
        elif letter == "," and not quoted:
            parts.append(text[start:position])
            start = position + 1
    return [*parts, text[start:]]


def to_float(text: str) -> float:
    """Return a field as a number; Fortran's exponent letter D is one of the language's forms.

    Raises `ValueError` for anything else; digits grouped by underscores are no number.
    """
    if "_" in text:
        raise ValueError(text)
    try:
        return float(text)
    except ValueError:
        return float(text.upper().replace("D", "E"))


def label(text: str) -> str:
    """Return the name that a field refers to: as written inside quotes, else upper case without blanks.

    A name qualified by its part instance keeps the point: ``"my part".set`` is ``my part.SET``.
    """
    if '"' not in text:
        return text.upper().replace(" ", "")
    pieces = text.split('"')
    return "".join(piece if index % 2 else piece.upper().replace(" ", "") for index, piece in enumerate(pieces))
