"""Reading a study file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ..errors import InputError, one_line
from ..files import read_text
from ..provenance import sha256_text
from ..yaml_text import load_yaml
from .case import Case
from .document import Study
from .grid import expand

LARGEST_FILE = 1_000_000
MOST_CASES = 200_000


@dataclass(frozen=True)
class LoadedStudy:
    """A validated study with the place it came from."""

    model: Study
    source: Path
    root: Path
    digest: str

    def cases(self) -> tuple[Case, ...]:
        """Return every case; free-rolling ones still without a creep ratio."""
        return expand(self.model, self.source, self.root, self.digest)

    def case(self, case_id: str) -> Case:
        """Return one case by its id; raises `InputError` where there is none."""
        cases = {case.case_id: case for case in self.cases()}
        if case_id not in cases:
            near = ", ".join(list(cases)[:3])
            raise InputError(f"{self.source}: case {one_line(case_id, 80)}", "no such case", f"one of {near}, ...")
        return cases[case_id]


def load_study(path: Path | str) -> LoadedStudy:
    """Read and validate a study; every fault is one `InputError` line with the key that is wrong.

    File names in the study are relative to the folder that holds ``config/``, or to the study's own folder where it
    is not in a ``config`` folder.
    """
    source = Path(path)
    text = read_text(source)
    if len(text) > LARGEST_FILE:
        raise InputError(source, f"{len(text)} characters", f"at most {LARGEST_FILE}")
    data = load_yaml(text, source)
    if not isinstance(data, dict):
        raise InputError(source, type(data).__name__, "a mapping of keys")
    try:
        model = Study.model_validate(data)
    except ValidationError as error:
        raise _first_fault(error, source, data) from None
    root = source.resolve().parent
    if root.name == "config":
        root = root.parent
    study = LoadedStudy(model=model, source=source, root=root, digest=sha256_text(text))
    for section, table in (
        ("compounds", model.compounds),
        ("friction_laws", model.friction_laws),
        ("paths", model.paths),
    ):
        for name, item in table.items():
            file = getattr(item, "file", None)
            if file is not None and not (root / file).is_file():
                raise InputError(f"{source}: {section}.{name}.file", file, f"an existing file below {root.name}/")
    return study


def _first_fault(error: ValidationError, source: Path, data: dict[str, Any]) -> InputError:
    """Turn pydantic's list into one line about the first fault."""
    faults = error.errors(include_url=False)
    # a union reports every branch: prefer the fault that lies deepest and is not about a sibling type
    fault = max(faults, key=lambda item: (_reachable(item["loc"], data), -faults.index(item)))
    where = f"{source}: {_key(fault['loc'], data)}"
    kind = fault["type"]
    if kind == "extra_forbidden":
        return InputError(where, "an unknown key", "a key of the study's schema (misspelt?)")
    if kind == "missing":
        return InputError(where, "nothing", "a value (the key is missing)")
    if kind == "value_error":
        message = fault["msg"].removeprefix("Value error, ")
        if ": got " in message and ", expected " in message:
            key, _, rest = message.partition(": got ")
            found, _, expected = rest.partition(", expected ")
            return InputError(f"{source}: {key}", found, expected)
        return InputError(where, "values that do not fit", message)
    found = fault.get("input")
    shown = one_line(repr(found), 80)
    return InputError(
        where, shown, one_line(fault["msg"]).removeprefix("Input should be ").replace("Input should", "it to")
    )


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
