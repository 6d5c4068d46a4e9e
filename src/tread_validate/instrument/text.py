"""From the bytes of an export to its lines, whatever the encoding."""

from __future__ import annotations

import codecs
from pathlib import Path

from ..errors import InputError

LARGEST = 200_000_000  # bytes
MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig", "UTF-8"),
    (codecs.BOM_UTF16_LE, "utf-16", "UTF-16"),
    (codecs.BOM_UTF16_BE, "utf-16", "UTF-16"),
)
SPREADSHEETS = {
    b"PK\x03\x04": "a zipped file",
    b"\xd0\xcf\x11\xe0": "an old binary workbook (.xls)",
}


def read_lines(path: Path | str) -> tuple[list[str], str]:
    """Return the lines of a text file and its encoding: UTF-8, UTF-16 or, where neither fits, Latin-1 (Windows-1252).

    Raises `InputError` for a missing, empty, binary or old Excel file.
    """
    source = Path(path)
    try:
        if source.stat().st_size > LARGEST:
            raise InputError(path, f"{source.stat().st_size} bytes", f"at most {LARGEST}")
        data = source.read_bytes()
    except FileNotFoundError:
        raise InputError(path, "no such file", "an existing file") from None
    except OSError as error:
        raise InputError(path, error.strerror or error, "a readable file") from None
    if not data.strip():
        raise InputError(path, "an empty file", "a table")
    for start, what in SPREADSHEETS.items():
        if data.startswith(start):
            raise InputError(path, what, "text, or a workbook named .xlsx (save it as one)")
    text, name = _decoded(path, data)
    if "\x00" in text:
        raise InputError(path, "binary data (a NUL byte)", "text or a workbook (.xlsx)")
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for number, line in enumerate(lines, start=1):
        if "\ufeff" in line:
            raise InputError(f"{path}:{number}", "a byte-order mark inside the file", "one file, not several joined")
    return lines, name


def _decoded(path: Path | str, data: bytes) -> tuple[str, str]:
    for mark, codec, name in MARKS:
        if data.startswith(mark):
            try:
                return data.decode(codec), name
            except UnicodeDecodeError as error:
                raise InputError(path, f"no {name} at byte {error.start}", f"{name}, as the file's mark says") from None
    if data[1:2] == b"\x00" and data[3:4] == b"\x00":
        return data.decode("utf-16-le", errors="replace"), "UTF-16"
    try:
        return data.decode("utf-8"), "UTF-8"
    except UnicodeDecodeError as error:
        control = sum(byte < 32 and byte not in b"\t\n\r\x0c\x1b" for byte in data[:100_000])
        if control:
            raise InputError(path, f"binary data at byte {error.start}", "text or a workbook (.xlsx)") from None
        return data.decode("cp1252", errors="replace"), "Latin-1"
