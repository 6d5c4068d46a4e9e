"""Numbers that the paper prints, each with its place, spread and how it is compared."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, cast

from ..errors import InputError, one_line
from ..text_table import read_text_table

PUBLISHED = Path("published") / "published.csv"
COLUMNS = (
    "id", "quantity", "value", "unit", "low", "high", "spread_kind", "section", "statement", "comparability",
    "comparison",
)  # fmt: skip
Comparability = Literal["computed", "input", "context"]


@dataclass(frozen=True)
class PublishedValue:
    """One printed number.

    Attributes
    ----------
    id : str
        Key of the row.
    quantity, unit : str
        What it is; the unit as printed (``% s/m``), not SI.
    value, low, high : float or None
        Printed value and the interval it stands for, in `unit`.
    spread_kind : str
        What the interval is: ``sd``, ``range``, ``rounding``, ``last digit``, ``about``, ``sign``, ``exact``,
        ``exists``, ``grade`` or ``none``.
    section, statement : str
        Where it stands in the paper and what it says.
    comparability : str
        ``computed``, ``input`` or ``context``.
    comparison : str
        How it is compared, or why it cannot be.
    """

    id: str
    quantity: str
    value: float | None
    unit: str
    low: float | None
    high: float | None
    spread_kind: str
    section: str
    statement: str
    comparability: Comparability
    comparison: str


def load_published(folder: Path | str) -> tuple[PublishedValue, ...]:
    """Read the published numbers below the reference folder, in the order of the paper.

    Raises `InputError` for a wrong header, a row of another length, a number that is none, or an id given twice.
    """
    source = Path(folder) / PUBLISHED
    table = read_text_table(source)
    table.check(COLUMNS, exactly=True)
    values: dict[str, PublishedValue] = {}
    for where, row in table.records():
        numbers = {name: _number(row[name], f"{where}: {name}") for name in ("value", "low", "high")}
        if row["comparability"] not in ("computed", "input", "context"):
            raise InputError(f"{where}: comparability", row["comparability"], "computed, input or context")
        if numbers["low"] is not None and numbers["high"] is not None and numbers["low"] > numbers["high"]:
            raise InputError(f"{where}: low", row["low"], f"at most high, {row['high']}")
        if row["id"] in values:
            raise InputError(f"{where}: id", row["id"], "an id of its own")
        values[row["id"]] = PublishedValue(
            id=row["id"],
            quantity=row["quantity"],
            unit=row["unit"],
            spread_kind=row["spread_kind"],
            section=row["section"],
            statement=row["statement"],
            comparability=cast(Comparability, row["comparability"]),
            comparison=row["comparison"],
            **numbers,
        )
    if not values:
        raise InputError(source, "a header only", "at least one published number")
    return tuple(values.values())


def _number(text: str, where: str) -> float | None:
    if text == "":
        return None
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise InputError(where, one_line(text, 40), "a finite number or nothing")
    return number
