"""Files that are described by a pydantic model: one way in, and one line for the first fault."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from .errors import InputError, one_line
from .yaml_text import read_yaml

Model = TypeVar("Model", bound=BaseModel)


def read_model(path: Path | str, model: type[Model]) -> Model:
    """Read a YAML (or JSON) file as `model`; every fault is one `InputError` line with file and key."""
    return as_model(read_yaml(path), model, path)


def as_model(data: Any, model: type[Model], where: object, section: str = "") -> Model:
    """Return data, a mapping of keys, as `model`; `where` is the file that they come from, `section` the key in it."""
    if not isinstance(data, dict):
        raise InputError(f"{where}: {section}" if section else where, type(data).__name__, "a mapping of keys")
    try:
        return model.model_validate(data)
    except ValidationError as error:
        raise first_fault(error, where, data, section) from None


def first_fault(error: ValidationError, where: object, data: Any, section: str = "") -> InputError:
    """Turn pydantic's list of faults into one line about the first: file and key, what stands there, what should."""
    source = f"{where}: {section}." if section else f"{where}: "
    faults = error.errors(include_url=False)
    # a union reports every branch: prefer the fault that lies deepest and is not about a sibling type
    fault = max(faults, key=lambda item: (_reachable(item["loc"], data), -faults.index(item)))
    place = f"{source}{_key(fault['loc'], data)}"
    kind = fault["type"]
    if kind == "extra_forbidden":
        return InputError(place, "an unknown key", "a key of the file's schema (misspelt?)")
    if kind == "missing":
        return InputError(place, "nothing", "a value (the key is missing)")
    if kind == "value_error":
        message = fault["msg"].removeprefix("Value error, ")
        if ": got " in message and ", expected " in message:
            key, _, rest = message.partition(": got ")
            found, _, expected = rest.partition(", expected ")
            return InputError(f"{source}{key}", found, expected)
        return InputError(place, "values that do not fit", message)
    found = fault.get("input")
    shown = one_line(repr(found), 80)
    same = [item for item in faults if item["input"] is found and _key(item["loc"], data) == _key(fault["loc"], data)]
    return InputError(place, shown, _expected(same))


def _expected(faults: list[ErrorDetails]) -> str:
    """Return what would have been right, in words, of the branches of a union that refuse one value.

    Where a number is out of its range, the branches that want another type are left out, as those that want a list are.
    """
    wrong_type = ("_type", "_parsing")
    plain = [item for item in faults if item["type"] not in ("tuple_type", "list_type")] or faults
    ranged = [item for item in plain if not item["type"].endswith(wrong_type) and item["type"] != "literal_error"]
    if ranged:
        plain = ranged + [item for item in plain if item["type"] == "literal_error"]
    said = [one_line(item["msg"]).partition(", unable to")[0] for item in plain]
    said = [text.removeprefix("Input should be ").replace("Input should", "it to") for text in said]
    return " or ".join(dict.fromkeys(said))


def _reachable(location: tuple[int | str, ...], data: Any) -> int:
    return len(_keys(location, data))


def _keys(location: tuple[int | str, ...], data: Any) -> list[int | str]:
    """Keep the parts of pydantic's location that are keys of the file, not names of union branches."""
    kept: list[int | str] = []
    for position, part in enumerate(location):
        here = isinstance(part, int) and isinstance(data, list) and part < len(data)
        if here or (isinstance(data, dict) and part in data):
            kept.append(part)
            data = data[part]
        elif position == len(location) - 1 and isinstance(data, dict):
            kept.append(part)
    return kept


def _key(location: tuple[int | str, ...], data: Any) -> str:
    text = ""
    for part in _keys(location, data):
        text += f"[{part}]" if isinstance(part, int) else (f".{part}" if text else str(part))
    return one_line(text or "the whole file", 120)
