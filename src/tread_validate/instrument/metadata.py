"""What the lines above a table say."""

from __future__ import annotations

import re

TEMPERATURE = re.compile(
    r"(?:temp(?:erature)?|\bT)\b[^0-9+\-]{0,24}(?P<value>[+-]?\d+(?:[.,]\d+)?)\s*(?P<unit>°\s*C|degC|deg C|C\b|K\b)",
    re.IGNORECASE,
)


def temperature_above(lines: list[str]) -> float | None:
    """Return the one temperature in degC that the lines above a table state; None where none or several do."""
    found = set()
    for line in lines:
        for match in TEMPERATURE.finditer(line):
            value = float(match["value"].replace(",", "."))
            found.add(value - 273.15 if match["unit"].upper() == "K" else value)
    return found.pop() if len(found) == 1 else None
