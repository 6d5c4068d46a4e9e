"""What all verbs share: numbers within their bounds, and files that are not both read and written."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import typer

from ..bounds import bounded
from ..errors import InputError

# Options that name what is written; every other path is read. A test goes through all verbs.
WRITTEN = {"--output", "--out", "--logs", "--abaqus-card", "--figure", "--peaks-figure", "--vfric", "--junit"} | {
    "--markdown",
    "--reports",
}


def within(name: str) -> Callable[[typer.Context, typer.CallbackParam, Any], Any]:
    """Return the callback of a number option, or of several numbers, that are the quantity called `name`."""

    def check(context: typer.Context, parameter: typer.CallbackParam, value: Any) -> Any:
        if value is not None and not context.resilient_parsing:
            option = parameter.opts[0]
            for number in value if isinstance(value, list | tuple) else (value,):
                bounded(float(number), name, option)
        return value

    check.quantity = name  # type: ignore[attr-defined]  # the range's name, for a test that goes through all options
    return check


def number(flag: str, quantity: str, told: str) -> Any:
    """Return the option of a number, or of several, within the bounds of the `quantity` (`tread_validate.bounds`)."""
    return typer.Option(flag, callback=within(quantity), help=told)


def refuse_overwriting(read: Mapping[str, Path], written: Mapping[str, Path]) -> None:
    """Raise `InputError` where an output is an input or another output, by whatever name or link."""
    taken = dict(read)
    for option, path in written.items():
        for other, file in taken.items():
            if same_file(path, file):
                expected = f"a file of its own (it is {'read' if other in read else 'written'} as {other})"
                raise InputError(option, path, expected)
        taken[option] = path


def same_file(one: Path, other: Path) -> bool:
    """Whether two paths lead to one file, through links too; folders may be shared."""
    if one.is_dir() or other.is_dir():
        return False
    if os.path.realpath(one) == os.path.realpath(other):
        return True
    return one.exists() and other.exists() and os.path.samefile(one, other)


def paths_of(command: Any, values: Mapping[str, Any]) -> tuple[dict[str, Path], dict[str, Path]]:
    """Return the paths that a verb reads and those that it writes, by the option (or argument) that names them."""
    read: dict[str, Path] = {}
    written: dict[str, Path] = {}
    for parameter in command.params:
        value = values.get(parameter.name)
        found = list(value) if isinstance(value, list | tuple) else [value]
        option = next((name for name in parameter.opts if name.startswith("--")), parameter.opts[0])
        for number, path in enumerate(item for item in found if isinstance(item, Path)):
            place = written if option in WRITTEN else read
            place[option if number == 0 else f"{option} ({number + 1})"] = path
    return read, written
