"""The one family of exceptions, and the exit code that the command line ends with for each (docs/exit_codes.md)."""

from __future__ import annotations


class TreadValidateError(Exception):
    """Base of every error that the package raises on purpose."""

    exit_code = 2


class InputError(TreadValidateError):
    """Wrong input: one line that says where, what was found and what was expected.

    Parameters
    ----------
    where : str
        File, and the key or line in it (``study.yaml: runs[2].interference_mm``).
    found : object
        What stands there.
    expected : str
        What would have been right.
    """

    def __init__(self, where: object, found: object, expected: str) -> None:
        self.where = str(where)
        self.found = found
        self.expected = expected
        super().__init__(one_line(f"{where}: got {found}, expected {expected}"))


class CheckFailedError(TreadValidateError):
    """A check ran and its answer is no."""

    exit_code = 1


class EngineError(TreadValidateError):
    """A solver, compiler or other tool is missing, failed, or took too long."""

    exit_code = 3


def one_line(text: str, limit: int = 400) -> str:
    """Fold `text` to one printable line of at most `limit` characters."""
    folded = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return folded if len(folded) <= limit else folded[: limit - 1] + "…"
