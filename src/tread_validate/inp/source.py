"""From a file to its lines: encodings, line ends and sizes, within bounds."""

from __future__ import annotations

import re
import stat
from pathlib import Path

from ..errors import InputError

MOST_BYTES = 512 * 1024 * 1024  # of a deck with all that it includes
CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1f\x7f]")
UTF16_MARKS = (b"\xff\xfe", b"\xfe\xff")


def read_lines(path: Path, budget: int = MOST_BYTES) -> tuple[list[str], int]:
    """Read a text file of a deck.

    UTF-8 with or without its mark, else Latin-1; lines end with LF, CR LF or CR. A form feed or vertical tab is a
    blank.

    Parameters
    ----------
    path : Path
    budget : int
        Bytes that may still be read.

    Returns
    -------
    lines : list of str
        Without their ends.
    size : int
        Bytes read.

    Raises
    ------
    InputError
        No such file, not a regular file, empty, larger than the budget, or binary.
    """
    try:
        status = path.stat()
        if not stat.S_ISREG(status.st_mode):
            raise InputError(path, "not a regular file", "a text file")
        if status.st_size > budget:
            raise InputError(path, f"{status.st_size} bytes", f"at most {MOST_BYTES} bytes in the whole deck")
        data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(path, "no such file", "an existing file") from None
    except (OSError, ValueError) as error:
        raise InputError(path, getattr(error, "strerror", None) or error, "a readable file") from None
    if not data.strip():
        raise InputError(path, "an empty file", "text")
    if data.startswith(UTF16_MARKS):
        raise InputError(path, "UTF-16 text", "UTF-8 or Latin-1 text")
    data = data.rstrip(b"\x1a")  # the end of a file in DOS
    binary = CONTROL.search(data)
    if binary is not None:
        raise InputError(path, f"binary data at byte {binary.start()}", "UTF-8 or Latin-1 text")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    lines = text.split("\n")
    if not lines[-1]:
        lines.pop()
    return lines, len(data)
