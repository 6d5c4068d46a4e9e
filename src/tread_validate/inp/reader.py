"""From the text of a deck to keyword blocks.

The rules are the keyword language's own: a line that begins with one ``*`` is a keyword line, ``**`` a comment; a
keyword line that ends with a comma goes on in the next line; keywords, parameters and labels do not depend on case
unless quoted; blanks in keywords fold to one.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError
from ..files import read_text
from .deck import Block, DataLine, Deck

DEEPEST_INCLUDE = 5


def read_deck(path: Path | str) -> Deck:
    """Read a deck and the files it includes.

    Parameters
    ----------
    path : Path or str
        The main ``.inp`` file. ``*INCLUDE, INPUT=`` may name files inside its folder only.

    Returns
    -------
    Deck

    Raises
    ------
    InputError
        A missing or binary file, data before the first keyword, a parameter without a name or given twice, an include
        that leaves the folder or includes itself.
    """
    source = Path(path)
    reader = _Reader(source.resolve().parent)
    reader.read(source, source.name, ())
    if not reader.blocks:
        raise InputError(f"{source.name}:1", "no keyword line", "a keyword line such as *NODE")
    blocks = tuple(Block(b.keyword, b.parameters, tuple(b.data), b.file, b.line, b.raw) for b in reader.blocks)
    return Deck(source, blocks, "\n".join(reader.text) + "\n")


@dataclass
class _Open:
    """A block still being read."""

    keyword: str
    parameters: dict[str, str | None]
    raw: dict[str, str]
    data: list[DataLine]
    file: str
    line: int


class _Reader:
    """Collects blocks from a file and its includes."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.blocks: list[_Open] = []
        self.text: list[str] = []

    def read(self, path: Path, name: str, above: tuple[Path, ...]) -> None:
        """Append the blocks of one file."""
        lines = read_text(path).splitlines()
        row = 0
        while row < len(lines):
            first = row
            text = lines[row]
            self.text.append(text)
            row += 1
            stripped = text.strip()
            if not stripped or stripped.startswith("**"):
                continue
            if not stripped.startswith("*"):
                if not self.blocks:
                    raise InputError(f"{name}:{first + 1}", stripped[:40], "a keyword line first")
                self.blocks[-1].data.append(DataLine(name, first + 1, stripped))
                continue
            while stripped.endswith(","):
                if row >= len(lines):
                    raise InputError(f"{name}:{row}", "end of file", "the keyword line to go on after its comma")
                following = lines[row].strip()
                self.text.append(lines[row])
                row += 1
                if following.startswith("**"):
                    continue
                if not following or following.startswith("*"):
                    raise InputError(f"{name}:{row}", following[:40] or "a blank line", "the keyword line to go on")
                stripped += following
            block = _parse_keyword(stripped, name, first + 1)
            if block.keyword == "INCLUDE":
                self._include(block, (*above, path.resolve()))
            else:
                self.blocks.append(block)

    def _include(self, block: _Open, above: tuple[Path, ...]) -> None:
        """Read the file an *INCLUDE names, inside the deck's folder only."""
        where = f"{block.file}:{block.line}: *INCLUDE"
        if set(block.parameters) != {"INPUT"} or not block.raw.get("INPUT"):
            raise InputError(where, ", ".join(block.parameters) or "no parameter", "INPUT=file and nothing else")
        target = (self.folder / block.raw["INPUT"]).resolve()
        if not target.is_relative_to(self.folder):
            raise InputError(where, block.raw["INPUT"], "a file inside the folder of the deck")
        if target in above:
            raise InputError(where, block.raw["INPUT"], "a file that does not include itself")
        if len(above) > DEEPEST_INCLUDE:
            raise InputError(where, f"{len(above)} levels", f"includes at most {DEEPEST_INCLUDE} deep")
        if not target.is_file():
            raise InputError(where, f"no file {block.raw['INPUT']}", "an existing file")
        self.read(target, str(target.relative_to(self.folder)), above)


def _parse_keyword(text: str, file: str, line: int) -> _Open:
    """Split one (joined) keyword line into keyword and parameters."""
    head, *rest = _split_commas(text[1:])
    keyword = " ".join(head.upper().split())
    where = f"{file}:{line}"
    if not re.fullmatch(r"[A-Z][A-Z0-9 \-]*", keyword):
        raise InputError(where, f"*{head.strip()[:40]}", "a keyword")
    parameters: dict[str, str | None] = {}
    raw: dict[str, str] = {}
    for part in rest:
        if not part.strip():
            continue
        name, equals, value = part.partition("=")
        name = " ".join(name.upper().split())
        value = value.strip()
        if not name or name in parameters:
            found = f"{name} twice" if name else part.strip()[:40]
            raise InputError(f"{where}: *{keyword}", found, "each parameter once, as NAME or NAME=value")
        if equals:
            raw[name] = value.strip('"')
            parameters[name] = value.strip('"') if value.startswith('"') else " ".join(value.upper().split())
        else:
            parameters[name] = None
    return _Open(keyword, parameters, raw, [], file, line)


def _split_commas(text: str) -> list[str]:
    """Split at commas outside double quotes."""
    return re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', text)
