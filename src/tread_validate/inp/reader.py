"""From the text of a deck to keyword blocks.

The rules are the keyword language's own: a line that begins with one ``*`` is a keyword line, ``**`` a comment; a
keyword line that ends with a comma goes on in the next line; keywords, parameters and labels do not depend on case
unless quoted, blanks in them do not count, and keywords and parameters may be abbreviated as long as they stay unique.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_left
from collections.abc import Callable, Sequence
from pathlib import Path

from ..errors import InputError
from .assembly import resolve
from .continuation import goes_on
from .deck import Deck, label, split_commas
from .open_block import OpenBlock
from .parameters import Value, assign, substitute
from .source import MOST_BYTES, read_lines
from .vocabulary import keyword_name, parameter_name, value_name

DEEPEST_INCLUDE = 5
MOST_INCLUDES = 1000
LABELS = frozenset({
    "NAME", "NSET", "ELSET", "MATERIAL", "CONTROLS", "ORIENTATION", "INTERACTION", "AMPLITUDE", "CPSET", "SURFACE",
    "PART", "INSTANCE", "REF NODE", "TIE NSET", "PIN NSET", "ANALYTICAL SURFACE",
})  # fmt: skip
"""Parameters whose values are labels: blanks in them do not count."""
VERBATIM = frozenset({"HEADING", "PARAMETER"})
"""Keywords whose data lines are text in which ``<name>`` stays as it is."""

HARMLESS = frozenset({"trailing-comma"})
"""Rules about what can be read in one way only."""

Report = Callable[[str, str, object, str], None]
"""Takes a rule, a place, what was found and what was expected."""


def stop(rule: str, where: str, found: object, expected: str) -> None:
    """Raise `InputError`: the report of readers that go no further than the first fault."""
    if rule in HARMLESS:
        return
    raise InputError(where, found, expected)


def read_deck(path: Path | str, report: Report = stop) -> Deck:
    """Read a deck and the files it includes, evaluate its parameters and place its part instances.

    Parameters
    ----------
    path : Path or str
        The main ``.inp`` file. ``*INCLUDE, INPUT=`` names a file relative to the file it stands in, inside the folder
        of the main file only.
    report : callable, optional
        Is told of a missing include, an undefined parameter or an assembly that does not resolve; by default the first
        of them stops the reading.

    Returns
    -------
    Deck

    Raises
    ------
    InputError
        A missing or binary file, more than the size limits, a parameter without a name
        or given twice, an include that leaves the folder or includes itself.
    """
    source = Path(path)
    reader = _Reader(source.resolve().parent, report)
    reader.read(source, source.name, ())
    if not reader.blocks:
        raise InputError(f"{source.name}:1", "no keyword line", "a keyword line such as *NODE")
    written = tuple(one.closed() for one in reader.blocks)
    blocks, instances = resolve([block for block in written if block.keyword != "PARAMETER"], report)
    text = "\n".join("\n".join(part) for part in reader.text) + "\n"
    files = tuple(dict.fromkeys(reader.files))
    return Deck(source, blocks, text, written, reader.parameters, tuple(reader.gaps), instances, files)


class _Reader:
    """Collects blocks from a file and its includes."""

    def __init__(self, folder: Path, report: Report) -> None:
        self.folder = folder
        self.report = report
        self.blocks: list[OpenBlock] = []
        self.text: list[list[str]] = []
        self.parameters: dict[str, Value] = {}
        self.gaps: list[str] = []
        self.files: list[Path] = []
        self.includes = 0
        self.budget = MOST_BYTES

    def read(self, path: Path, name: str, above: tuple[Path, ...]) -> None:
        """Append the blocks of one file."""
        lines, size = read_lines(path, self.budget)
        self.files.append(path)
        self.budget -= size
        self.text.append(lines)
        marked = any("<" in line for line in lines)
        starred = [row for row, line in enumerate(lines) if "*" in line and line.lstrip().startswith("*")]
        row = 0
        while row < len(lines):
            at = bisect_left(starred, row)
            following = starred[at] if at < len(starred) else len(lines)
            if following > row:
                self._data(lines, row, following, name, marked)
                row = following
                continue
            stripped = lines[row].strip()
            if stripped.startswith("**"):
                row += 1
                continue
            first = row
            stripped, row = self._continued(lines, row, name)
            if marked and "<" in stripped:
                stripped = self._substituted(stripped, f"{name}:{first + 1}")
            block = _parse_keyword(stripped, name, first + 1)
            if block.keyword == "INCLUDE":
                self._include(block, path, (*above, path.resolve()))
            else:
                self.blocks.append(block)
                if block.raw.get("INPUT"):
                    self._input(block, path)

    def _continued(self, lines: list[str], row: int, name: str) -> tuple[str, int]:
        """Return a keyword line with the lines that it goes on in, and the row after them."""
        stripped, first = lines[row].strip(), row
        row += 1
        while stripped.endswith(","):
            ahead = row
            while ahead < len(lines) and (not lines[ahead].strip() or lines[ahead].strip().startswith("**")):
                ahead += 1
            following = lines[ahead].strip() if ahead < len(lines) else ""
            keyword = keyword_name(" ".join(split_commas(stripped[1:])[0].upper().split()))
            if not goes_on(keyword, following):
                where = f"{name}:{first + 1}: *{keyword}"
                self.report("trailing-comma", where, "a comma at the end", "parameters in the next line, or no comma")
                break
            stripped += following
            row = ahead + 1
        return stripped, row

    def _data(self, lines: list[str], first: int, last: int, name: str, marked: bool) -> None:
        """Append data lines `first` to `last` - 1 (from 0) to the block that is open."""
        texts = [line.strip() for line in lines[first:last]]
        numbers: Sequence[int] = range(first + 1, last + 1)
        if not all(texts):
            kept = [(number, text) for number, text in zip(numbers, texts, strict=True) if text]
            numbers, texts = array("I", [number for number, _ in kept]), [text for _, text in kept]
        if not texts:
            return
        if not self.blocks:
            self.report("syntax", f"{name}:{numbers[0]}", texts[0][:40], "a keyword line first")
            return
        block = self.blocks[-1]
        if block.keyword == "PARAMETER":
            self._assign(block, numbers, texts, name)
        elif marked and block.keyword not in VERBATIM:
            texts = [
                self._substituted(text, f"{name}:{number}") if "<" in text else text
                for number, text in zip(numbers, texts, strict=True)
            ]
        block.extend(name, numbers, texts)

    def _assign(self, block: OpenBlock, numbers: Sequence[int], texts: list[str], name: str) -> None:
        if "TABLE" in block.parameters:
            self.report("parameter", f"{block.file}:{block.line}", "*PARAMETER, TABLE", "name = expression")
            self.gaps.append("*PARAMETER, TABLE")
            return
        begun = ""
        for number, text in zip(numbers, texts, strict=True):
            if text.endswith("\\"):  # the language's own sign that an expression goes on
                begun += text[:-1]
                continue
            text, begun = begun + text, ""
            try:
                assign(text, self.parameters)
            except ValueError as error:
                self.report("parameter", f"{name}:{number}: *PARAMETER", error, "simple arithmetic on known names")
                self.gaps.append(text[:40])

    def _substituted(self, text: str, where: str) -> str:
        try:
            return substitute(text, self.parameters)
        except KeyError as error:
            if not self.gaps:
                self.report("parameter", where, f"<{error.args[0]}>", "a name that *PARAMETER defines before")
            return text

    def _target(self, block: OpenBlock, path: Path, above: tuple[Path, ...]) -> Path | None:
        """Return the file that INPUT= names; None where it is missing and the report goes on."""
        where = f"{block.file}:{block.line}: *{block.keyword}"
        named = block.raw["INPUT"]
        if "\0" in named or len(named) > 1000:
            raise InputError(where, named[:40], "a file name")
        target = (path.resolve().parent / named.replace("\\", "/")).resolve()
        if not target.is_relative_to(self.folder):
            self.report("missing-include", where, f"{named}, not read", "a file inside the folder of the deck")
            self.gaps.append(named)
            return None
        if target in above:
            raise InputError(where, named, "a file that does not include itself")
        if len(above) > DEEPEST_INCLUDE:
            raise InputError(where, f"{len(above)} levels", f"includes at most {DEEPEST_INCLUDE} deep")
        self.includes += 1
        if self.includes > MOST_INCLUDES:
            raise InputError(where, f"more than {MOST_INCLUDES} includes", f"at most {MOST_INCLUDES}")
        if not target.exists():
            self.report("missing-include", where, f"no file {named}", "an existing file")
            self.gaps.append(named)
            return None
        return target

    def _include(self, block: OpenBlock, path: Path, above: tuple[Path, ...]) -> None:
        """Read the file an *INCLUDE names."""
        where = f"{block.file}:{block.line}: *INCLUDE"
        if set(block.parameters) == {"FILE"}:
            self.report("missing-include", where, f"FILE={block.raw.get('FILE', '')}, not read", "INPUT=file")
            self.gaps.append(block.raw.get("FILE", ""))
            return
        if not set(block.parameters) <= {"INPUT", "PASSWORD"} or not block.raw.get("INPUT"):
            raise InputError(where, ", ".join(block.parameters) or "no parameter", "INPUT=file and nothing else")
        if "PASSWORD" in block.parameters:
            self.report("missing-include", where, f"{block.raw['INPUT']}, encrypted", "a file that can be read")
            self.gaps.append(block.raw["INPUT"])
            return
        target = self._target(block, path, above)
        if target is not None:
            self.read(target, _relative(target, self.folder), above)

    def _input(self, block: OpenBlock, path: Path) -> None:
        """Read data lines from the file that a keyword's INPUT= names; such lines are counted in that file."""
        target = self._target(block, path, (path.resolve(),))
        if target is None:
            return
        lines, size = read_lines(target, self.budget)
        self.files.append(target)
        self.budget -= size
        self.text.append(lines)
        kept = [(i, line.strip()) for i, line in enumerate(lines, 1) if line.strip() and not line.startswith("**")]
        wrong = next((i for i, line in kept if line.startswith("*")), None)
        if wrong is not None:
            raise InputError(f"{_relative(target, self.folder)}:{wrong}", "a keyword line", "data lines only")
        block.extend(_relative(target, self.folder), array("I", [i for i, _ in kept]), [line for _, line in kept])


def _relative(target: Path, folder: Path) -> str:
    return target.relative_to(folder).as_posix()


def _parse_keyword(text: str, file: str, line: int) -> OpenBlock:
    """Split one (joined) keyword line into keyword and parameters."""
    head, *rest = split_commas(text[1:])
    keyword = " ".join(head.upper().split())
    where = f"{file}:{line}"
    if not re.fullmatch(r"[A-Z][A-Z0-9 _\-]*", keyword):
        raise InputError(where, f"*{head.strip()[:40]}", "a keyword")
    keyword = keyword_name(keyword)
    parameters: dict[str, str | None] = {}
    raw: dict[str, str] = {}
    for part in rest:
        if not part.strip():
            continue
        name, equals, value = part.partition("=")
        name = parameter_name(keyword, " ".join(name.upper().split()))
        value = value.strip()
        if not name or name in parameters:
            found = f"{name} twice" if name else part.strip()[:40]
            raise InputError(f"{where}: *{keyword}", found, "each parameter once, as NAME or NAME=value")
        if not equals:
            parameters[name] = None
            continue
        raw[name] = value[1:-1] if len(value) > 1 and value[0] == value[-1] == '"' else value
        if '"' in value or name in LABELS:
            parameters[name] = label(value)
        else:
            parameters[name] = value_name(keyword, name, " ".join(value.upper().split()))
    return OpenBlock(keyword, parameters, raw, file, line)
