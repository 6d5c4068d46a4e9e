"""Reading and writing files without leaving anything half-written."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Iterator, Mapping
from pathlib import Path

from .errors import InputError

_INPUTS: dict[str, Path] = {}  # what the running command reads, by the option that names it


@contextlib.contextmanager
def protected(inputs: Mapping[str, Path]) -> Iterator[None]:
    """Refuse, while the block runs, to write over these files, by whatever name or link."""
    before = dict(_INPUTS)
    _INPUTS.update(inputs)
    try:
        yield
    finally:
        _INPUTS.clear()
        _INPUTS.update(before)


def _refuse_input(target: Path) -> None:
    for name, file in _INPUTS.items():
        if target.is_file() and file.is_file() and target.samefile(file):
            raise InputError(target, f"what is read as {name}", "another file to write (folder or name)")


@contextlib.contextmanager
def atomic_path(path: Path | str) -> Iterator[Path]:
    """Yield a temporary path beside `path`; it replaces `path` only when the block ends without an error."""
    target = Path(path)
    _refuse_input(target)
    target.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{target.stem}-", suffix=target.suffix, dir=target.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(0o666 & ~_umask())
        os.replace(temporary, target)
    except OSError as error:
        if error.filename is None:  # a full disk does not say which file it was
            error.filename = str(target)
        raise
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path | str, text: str) -> None:
    """Write `text` as UTF-8 with Unix line ends, atomically."""
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")


def write_bytes(path: Path | str, data: bytes | memoryview) -> None:
    """Write `data`, atomically."""
    with atomic_path(path) as temporary:
        temporary.write_bytes(data)


def read_text(path: Path | str) -> str:
    """Read a UTF-8 text file; a missing, empty or binary one is an `InputError`."""
    source = Path(path)
    try:
        data = source.read_bytes()
    except FileNotFoundError:
        raise InputError(source, "no such file", "an existing file") from None
    except OSError as error:
        raise InputError(source, error.strerror or error, "a readable file") from None
    if not data.strip():
        raise InputError(source, "an empty file", "text")
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(source, f"binary data at byte {error.start}", "UTF-8 text") from None
    if "\x00" in text:
        raise InputError(source, "binary data (a NUL byte)", "UTF-8 text")
    return text


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
