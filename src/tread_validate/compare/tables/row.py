"""What a table of the results is: a row class whose fields are its columns."""

from __future__ import annotations

import math
import types
import typing
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, ClassVar, Literal, Self, TypeVar

from ...errors import InputError, one_line
from ..quantities import Noise

AnyRow = TypeVar("AnyRow")
Kind = Literal["string", "number", "integer", "boolean", "list"]
EXACT = Noise(0.0, 0.0)
PRINTED = Noise(2e-6, 0.0)  # numbers are printed with seven digits, and the last may turn over
WORDS = {"true": True, "false": False}


@dataclass(frozen=True)
class TableColumn:
    """One column: its name in the header, kind of values, unit (empty where it has none) and what it holds.

    `noise` is how far another processor may move its numbers; `free` says that the baseline does not hold it: words for
    people, and digests of files whose numbers it holds anyway.
    """

    name: str
    kind: Kind
    unit: str
    description: str
    optional: bool
    noise: Noise = EXACT
    free: bool = False


@dataclass(frozen=True)
class ColumnSpread:
    """Several number columns behind one field, which maps their keys to values."""

    columns: tuple[tuple[str, TableColumn], ...]


def column(
    description: str, unit: str = "", default: Any = MISSING, noise: Noise | None = None, free: bool = False
) -> Any:
    """Declare a column of a row class; its kind and whether it may be empty follow from the annotation."""
    return field(default=default, metadata={"description": description, "unit": unit, "noise": noise, "free": free})


def spread(columns: Mapping[str, TableColumn]) -> Any:
    """Declare a field that stands for several number columns, by key."""
    return field(metadata={"spread": ColumnSpread(tuple(columns.items()))})


@typing.dataclass_transform(frozen_default=True, field_specifiers=(column, spread))
def table_row(cls: type[AnyRow]) -> type[AnyRow]:
    """Make a class of columns the row of a table: a frozen dataclass."""
    return dataclass(frozen=True)(cls)


@dataclass(frozen=True)
class TableRow:
    """A row of a table; a sub-class is the one declaration of its columns.

    Class attributes: `table`, its file's stem; `title`, one line on what it holds; `key`, the columns that make a row
    the same row in another run's table.
    """

    table: ClassVar[str]
    title: ClassVar[str]
    key: ClassVar[tuple[str, ...]]

    @classmethod
    def columns(cls) -> tuple[TableColumn, ...]:
        """Return the columns in the order of the header."""
        return tuple(found for _, _, found in _layout(cls))

    @classmethod
    def header(cls) -> tuple[str, ...]:
        """Return the names of the columns."""
        return tuple(found.name for found in cls.columns())

    def cells(self) -> dict[str, Any]:
        """Return the values by column."""
        return {
            found.name: getattr(self, name) if key is None else getattr(self, name).get(key)
            for name, key, found in _layout(type(self))
        }

    def identity(self) -> tuple[str, ...]:
        """Return the values of the key's columns as text."""
        return tuple(str(getattr(self, name)) for name in self.key)

    def noise(self, found: TableColumn) -> Noise:
        """Return how far the value of a column may move before it counts as moved; words and counts not at all."""
        return found.noise

    @classmethod
    def read(cls, texts: Mapping[str, str], where: str) -> Self:
        """Return the row that a table's cells spell; raises `InputError` at the cell that is wrong."""
        values: dict[str, Any] = {}
        for name, key, found in _layout(cls):
            value = _value(found, texts[found.name], where)
            if key is None:
                values[name] = value
            else:
                values.setdefault(name, {})[key] = value
        return cls(**values)


Layout = tuple[tuple[str, str | None, TableColumn], ...]
_layouts: dict[type[TableRow], Layout] = {}


def _layout(cls: type[TableRow]) -> Layout:
    """Return (field, key inside the field or None, column) for every column."""
    if cls not in _layouts:
        _layouts[cls] = _make_layout(cls)
    return _layouts[cls]


def _make_layout(cls: type[TableRow]) -> Layout:
    hints = typing.get_type_hints(cls)
    found: list[tuple[str, str | None, TableColumn]] = []
    for item in fields(cls):
        if "spread" in item.metadata:
            found += [(item.name, key, one) for key, one in item.metadata["spread"].columns]
            continue
        kind, optional = _kind(hints[item.name])
        given = item.metadata
        noise = given["noise"] or (PRINTED if kind == "number" else EXACT)
        made = TableColumn(item.name, kind, given["unit"], given["description"], optional, noise, given["free"])
        found.append((item.name, None, made))
    return tuple(found)


def _kind(hint: Any) -> tuple[Kind, bool]:
    optional = False
    if typing.get_origin(hint) in (types.UnionType, typing.Union):
        members = [member for member in typing.get_args(hint) if member is not type(None)]
        optional, hint = True, members[0]
    kinds: dict[Any, Kind] = {float: "number", int: "integer", bool: "boolean", str: "string"}
    if typing.get_origin(hint) is tuple:
        return "list", optional
    return kinds.get(hint, "string"), optional


def _value(found: TableColumn, text: str, where: str) -> Any:
    if found.kind == "string":
        return text
    if found.kind == "list":
        return tuple(text.split())
    if text == "":
        if found.optional:
            return None
        raise InputError(f"{where}: {found.name}", "an empty cell", f"a {found.kind}")
    if found.kind == "boolean":
        if text not in WORDS:
            raise InputError(f"{where}: {found.name}", one_line(repr(text), 40), "true or false")
        return WORDS[text]
    try:
        value = int(text) if found.kind == "integer" else float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{where}: {found.name}", one_line(repr(text), 40), f"a finite {found.kind}")
    return value
