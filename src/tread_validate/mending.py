"""What mends a file that a command made: said in the line that refuses it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from .errors import InputError

COMMANDS = ("make ", "tread-validate ", "git ")


@contextmanager
def mended_by(command: str) -> Iterator[None]:
    """Name the command that mends what is read within, in every `InputError` that names none."""
    try:
        yield
    except InputError as error:
        if any(word in error.expected for word in COMMANDS):
            raise
        raise InputError(error.where, error.found, f"{error.expected} (mend: {command})") from None
