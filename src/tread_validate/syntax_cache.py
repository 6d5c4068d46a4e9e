"""What the syntax trees of source files say, kept between runs and found by the text itself: never out of date.

A key is the digest of a file's text, of what is asked of it, of the Python version and of the code that reads it.
"""

from __future__ import annotations

import hashlib
import json
import sys
from pathlib import Path
from typing import Any

from .cache_folder import cache_folder
from .errors import InputError
from .files import read_text, write_text

FOLDER = "syntax"
MOST = 4000  # entries of a file; beyond, it begins anew


class SyntaxCache:
    """A file of entries, read at first use; what cannot be read or written is no fault, only slower."""

    def __init__(self, reader: Path) -> None:
        version = f"{sys.version_info.major}.{sys.version_info.minor}"
        self._of_reader = hashlib.sha256(reader.read_bytes()).hexdigest() + version
        self._entries: dict[str, Any] | None = None
        self._new = 0

    def key(self, *asked: str) -> str:
        """Return the key of a text and of what is asked of it."""
        return hashlib.sha256("\0".join((self._of_reader, *asked)).encode()).hexdigest()

    def get(self, key: str) -> Any:
        """Return what is kept under a key, None where nothing is."""
        if self._entries is None:
            self._entries = self._read()
        return self._entries.get(key)

    def put(self, key: str, value: Any) -> None:
        """Keep a value that is made of lists, mappings and texts."""
        assert self._entries is not None, "asked before told"
        self._entries[key] = value
        self._new += 1

    def save(self) -> None:
        """Write what is new to the file."""
        file = self._file()
        if file is None or not self._new or self._entries is None:
            return
        kept = self._entries if len(self._entries) <= MOST else {}
        self._new = 0
        try:
            write_text(file, json.dumps({**self._read(), **kept} if kept else kept, separators=(",", ":")))
        except (OSError, InputError):
            return

    def _file(self) -> Path | None:
        folder = cache_folder()
        return None if folder is None else folder / FOLDER / f"{self._of_reader[:16]}.json"

    def _read(self) -> dict[str, Any]:
        file = self._file()
        if file is None or not file.is_file():
            return {}
        try:
            found = json.loads(read_text(file))
        except (OSError, InputError, ValueError):
            return {}
        return found if isinstance(found, dict) else {}
