"""What the laboratory verbs share: origin of the data, provenance, writing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import InputError, one_line
from ..files import write_text

if TYPE_CHECKING:
    from ..instrument import Measurand, Reading
    from ..study import Case

ORIGINS = ("measured", "synthetic")


def checked_origin(path: Path, origin: str, source: str) -> tuple[str, str]:
    """Return the origin and the source line; what the command line leaves open is read from the file's name and head.

    A file that says it is synthetic, in its name or in an ``# origin: synthetic`` line, stays synthetic.
    """
    said = _head(path)
    synthetic = "synthetic" in path.name.lower() or said.get("origin", "").lower() == "synthetic"
    if origin and origin not in ORIGINS:
        raise InputError("--origin", one_line(origin, 60), f"one of {', '.join(ORIGINS)}")
    if synthetic and origin == "measured":
        raise InputError("--origin", "measured", f"synthetic, as {path.name} says of itself")
    kind = "synthetic" if synthetic else (origin or "measured")
    return kind, one_line(source or said.get("source", "") or path.name, 280)


def _head(path: Path) -> dict[str, str]:
    if not path.is_file() or path.suffix.lower() == ".tdms":
        return {}
    said: dict[str, str] = {}
    with path.open(encoding="utf-8", errors="replace") as stream:
        for line in stream:
            if not line.lstrip("\ufeff").startswith("#"):
                break
            key, colon, value = line.lstrip("\ufeff# ").partition(":")
            if colon:
                said[key.strip()] = value.strip()
    return said


def provenance(*paths: Path) -> dict[str, str]:
    """Return input names and checksums, and package version; no commit, so that the same input gives the same file."""
    from ..provenance import sha256_file, version

    found = {"input": paths[0].name, "input_sha256": sha256_file(paths[0])}
    for number, path in enumerate(paths[1:], start=2):
        found |= {f"input_{number}": path.name, f"input_{number}_sha256": sha256_file(path)}
    return found | {"version": version()}


def reading_of(
    columns: list[str] | None, units: Mapping[str, str | None], quantities: tuple[Measurand, ...]
) -> Reading:
    """Return what ``--column KEY=COLUMN`` and the unit options say of a file."""
    from ..instrument import Reading
    from ..instrument.quantities import choices

    known = {quantity.option: quantity.units for quantity in quantities if quantity.option}
    for option, unit in units.items():
        if unit is not None and unit.lower() not in known[option]:
            raise InputError(option, one_line(unit, 40), f"one of {choices(known[option])}")
    keys = [quantity.key for quantity in quantities]
    chosen = {}
    for pair in columns or []:
        key, equals, column = pair.partition("=")
        if not equals or key not in keys or not column:
            raise InputError("--column", one_line(pair, 60), f"KEY=COLUMN with KEY one of {', '.join(keys)}")
        chosen[key] = column
    return Reading(chosen, {option: unit for option, unit in units.items() if unit is not None})


def tell_worth(cases: Sequence[Case], study: Path, accept: bool) -> None:
    """Print what each compound's series is worth for these cases; raises `InputError` for one too far off."""
    import typer

    from ..material.worth import worths

    for worth in worths(cases):
        for line in worth.lines():
            typer.echo(line, err=line.startswith("warning"))
        if not accept:
            worth.refuse(str(study))


def write_all(files: Mapping[Path, str]) -> None:
    """Write several texts, each atomically."""
    for path, text in files.items():
        write_text(path, text)
