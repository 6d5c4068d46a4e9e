"""Which column is which: by name and unit, by the user's word where that leaves a doubt."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from ..errors import InputError, one_line
from .cells import CellBlock
from .quantities import SHEAR, Measurand, Unit, bare_name, choices

BRACKETED = re.compile(r"^(?P<name>.*?)\s*[\[(]\s*(?P<unit>[^\[\]()]*)\s*[\])]\s*$")
DIVIDED = re.compile(r"^(?P<name>.*?)\s*(?:/|\bin\b)\s*(?P<unit>\S+)\s*$")
SUFFIXED = re.compile(r"^(?P<name>.+?)_(?P<unit>rad_s|m_s|mm_s|[A-Za-z]+)$")


@dataclass(frozen=True)
class Reading:
    """What the user says of a file.

    Attributes
    ----------
    columns : mapping of quantity key to column
        Name in the heading, or number from 1 as text.
    units : mapping of option (``--modulus-unit``) to unit
        It holds whatever the heading says.
    """

    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Recognised:
    """One column: where it stands, its heading, its unit as found, and how to SI (degC for temperatures)."""

    column: int
    heading: str
    unit_name: str
    unit: Unit

    def told(self, quantity: Measurand) -> str:
        """Return "E' = column 3 'E_stor' in MPa"."""
        unit = f" in {self.unit_name}" if self.unit_name else ""
        return f"{quantity.told} = column {self.column + 1} '{self.heading}'{unit}"


def split_heading(heading: str, units: Mapping[str, Unit]) -> tuple[str, str]:
    """Return name and unit of a heading that may hold both: ``E' [MPa]``, ``Freq. (Hz)``, ``T/°C``, ``E_stor_MPa``."""
    for pattern in (BRACKETED, DIVIDED, SUFFIXED):
        found = pattern.match(heading.strip())
        if found and found["unit"].strip().lower() in units:
            return found["name"], found["unit"].strip()
    return heading, ""


def recognise(block: CellBlock, quantities: tuple[Measurand, ...], reading: Reading) -> dict[str, Recognised]:
    """Return the column of each quantity that the block has, by key.

    Raises `InputError` where two columns could be one quantity, the user's column is not there, or a unit is not said.
    """
    found: dict[str, Recognised] = {}
    for quantity in quantities:
        candidates = _candidates(block, quantity, reading)
        if len(candidates) > 1:
            candidates = _with_data(block, candidates)
        if len(candidates) > 1:
            names = ", ".join(f"{k + 1} '{block.names[k]}'" for k, _ in candidates)
            raise InputError(
                f"{block.where}:{_head_line(block)}",
                f"{quantity.told} in columns {one_line(names, 160)}",
                f"one of them: --column {quantity.key}=NUMBER",
            )
        if candidates:
            found[quantity.key] = _resolved(block, quantity, *candidates[0], reading)
    if "storage" not in found and "loss" not in found:
        _refuse_shear(block)
    return found


def _candidates(block: CellBlock, quantity: Measurand, reading: Reading) -> list[tuple[int, str]]:
    """Return columns that may be the quantity, each with the unit that its heading says."""
    chosen = reading.columns.get(quantity.key)
    if chosen is not None:
        k = _chosen(block, quantity, chosen)
        return [(k, split_heading(block.names[k], quantity.units)[1] or block.units[k])]
    found = []
    for k, heading in enumerate(block.names):
        name, unit = split_heading(heading, quantity.units)
        if bare_name(name) in quantity.names or bare_name(heading) in quantity.names:
            found.append((k, unit or block.units[k]))
    return found


def _chosen(block: CellBlock, quantity: Measurand, chosen: str) -> int:
    if chosen.isdigit() and 1 <= int(chosen) <= len(block.names):
        return int(chosen) - 1
    places = [k for k, name in enumerate(block.names) if name.strip() == chosen.strip()]
    if len(places) != 1:
        names = one_line(", ".join(f"{k + 1} '{name}'" for k, name in enumerate(block.names)), 200)
        raise InputError(
            f"{block.where}:{_head_line(block)}", f"columns {names}", f"one column {chosen!r} for {quantity.told}"
        )
    return places[0]


def _with_data(block: CellBlock, candidates: list[tuple[int, str]]) -> list[tuple[int, str]]:
    """Return the candidates that hold anything; a column that is empty throughout is no choice."""
    return [(k, unit) for k, unit in candidates if any(row[k].strip() for row in block.cells)]


def _resolved(block: CellBlock, quantity: Measurand, column: int, unit: str, reading: Reading) -> Recognised:
    said = reading.units.get(quantity.option, "") if quantity.option else ""
    name = said or unit
    if name.strip().lower() not in quantity.units:
        if not name and bare_name(block.names[column]).startswith(("angular", "ang", "omega", "ω")):
            name = "rad/s"
        elif not name and "" in quantity.units:
            return Recognised(column, block.names[column], "", Unit(1.0))
        else:
            raise InputError(
                f"{block.where}:{_head_line(block)}: column {column + 1} '{block.names[column]}'",
                f"the unit '{name}'" if name else "no unit",
                f"a unit of {quantity.told} ({choices(quantity.units)})"
                + (f": {quantity.option}" if quantity.option else ""),
            )
    return Recognised(column, block.names[column], name, quantity.units[name.strip().lower()])


def _refuse_shear(block: CellBlock) -> None:
    for k, name in enumerate(block.names):
        if bare_name(split_heading(name, {"pa": Unit(1), "kpa": Unit(1), "mpa": Unit(1), "gpa": Unit(1)})[0]) in SHEAR:
            raise InputError(
                f"{block.where}:{_head_line(block)}",
                f"a shear modulus in column {k + 1} '{name}'",
                "moduli in tension: multiply by 2 (1 + nu) first, and say which nu",
            )


def _head_line(block: CellBlock) -> int:
    return max(block.line[0] - (2 if any(block.units) else 1), 1)
