"""A keyword block while its lines are being read."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass, field

from .deck import KeywordBlock, Lines


@dataclass
class OpenBlock:
    """A block still being read."""

    keyword: str
    parameters: dict[str, str | None]
    raw: dict[str, str]
    file: str
    line: int
    files: str | list[str] = ""
    numbers: Sequence[int] = ()
    texts: list[str] = field(default_factory=list)

    def extend(self, file: str, numbers: Sequence[int], texts: list[str]) -> None:
        """Append data lines; the numbers stay a range and the file one as long as they are."""
        if not self.texts:
            self.files, self.numbers, self.texts = file, numbers, texts
            return
        if self.files != file:
            before = self.files if isinstance(self.files, list) else [self.files] * len(self.texts)
            self.files = before + [file] * len(texts)
        joined = array("I", self.numbers)
        joined.extend(numbers)
        self.numbers = joined
        self.texts += texts

    def closed(self) -> KeywordBlock:
        """Return the finished block; a factor of 1 on an amplitude is left out, as the same deck without it reads."""
        for name in ("SCALEX", "SCALEY"):
            if self.keyword == "AMPLITUDE" and self.parameters.get(name) in ("1", "1.", "1.0"):
                del self.parameters[name]
        data = Lines(self.files or self.file, self.numbers, self.texts)
        return KeywordBlock(self.keyword, self.parameters, data, self.file, self.line, self.raw)
