"""The decks that filed runs were made from: short lines in one text file, long tables by content, each stored once."""

from __future__ import annotations

import gzip
import hashlib
import zlib
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import read_text, write_bytes, write_text
from ..inp import Part, Problem

HEAD = "# tread-validate deck 1: keyword lines and their data; @digest stands for the lines of blocks/digest.gz"
LONG = 20  # lines: tables from here on are stored by content


def write_problem(blocks: Path, target: Path, problem: Problem) -> None:
    """Write a problem: long tables into the folder `blocks`, where one that is there is used, the rest to `target`."""
    lines = [HEAD]
    for part in problem.parts:
        lines.append(part.keyword)
        if len(part.lines) < LONG:
            lines += part.lines
            continue
        name = part.digest
        file = blocks / f"{name}.gz"
        if not file.is_file():
            write_bytes(file, gzip.compress("\n".join(part.lines).encode(), 9, mtime=0))
        lines.append(f"@{name} {part.count}")
    write_text(target, "\n".join(lines) + "\n")


def read_problem(blocks: Path, source: Path) -> Problem:
    """Read a problem; raises `InputError` for another format, a missing block, a block altered."""
    head, *lines = read_text(source).splitlines()
    if head != HEAD:
        raise InputError(f"{source}:1", head[:60], f"{HEAD[:23]} (another format: file the run again)")
    parts: list[tuple[str, list[str]]] = []
    for number, line in enumerate(lines, 2):
        if line.startswith("*"):
            parts.append((line, []))
        elif not parts:
            raise InputError(f"{source}:{number}", line[:60], "a keyword line first")
        else:
            parts[-1][1].append(line)
    return Problem(tuple(_part(blocks, keyword, tuple(data)) for keyword, data in parts))


class FiledTable(Part):
    """A part whose lines are read from their block when first asked for; its digest is the block's name."""

    def __init__(self, keyword: str, file: Path, digest: str, count: int) -> None:
        super().__init__(keyword, ())
        self.__dict__.update(file=file, digest=digest, _count=count)
        self.__dict__.pop("lines")

    def __getattr__(self, name: str) -> Any:
        if name != "lines":
            raise AttributeError(name)
        lines = _block(self.__dict__["file"], self.digest)
        self.__dict__["lines"] = lines
        return lines

    @property
    def count(self) -> int:
        """Number of lines."""
        return int(self.__dict__["_count"])


def _part(blocks: Path, keyword: str, data: tuple[str, ...]) -> Part:
    if len(data) == 1 and data[0].startswith("@"):
        name, _, count = data[0][1:].partition(" ")
        return FiledTable(keyword, blocks / f"{name}.gz", name, int(count))
    return Part(keyword, data)


def used_blocks(source: Path) -> set[str]:
    """Return the names of the blocks that a stored deck needs."""
    return {line[1:].partition(" ")[0] for line in read_text(source).splitlines() if line.startswith("@")}


def check_block(blocks: Path, name: str) -> None:
    """Raise `InputError` for a block that is missing or altered."""
    _block(blocks / f"{name}.gz", name)


def _block(file: Path, name: str) -> tuple[str, ...]:
    try:
        data = gzip.decompress(file.read_bytes())
    except FileNotFoundError:
        raise InputError(file, "no such file", "the block that a filed deck names") from None
    except (OSError, EOFError, zlib.error) as error:
        raise InputError(file, error, "a block compressed by gzip") from None
    if hashlib.sha256(data).hexdigest() != name:
        raise InputError(file, "another content", f"content with SHA-256 {name[:12]}...")
    return tuple(data.decode("utf-8").split("\n"))
