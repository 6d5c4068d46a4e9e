"""The factors of a study: what a run may vary, said once for the grid, the case ids, the tables and the report."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from .run import Run

Level = Any  # a name, a number, "free_rolling" or None


@dataclass(frozen=True)
class Factor:
    """One factor.

    Attributes
    ----------
    key : str
        Name of the factor.
    label : str
        What a reader is shown, without the unit.
    unit : str
        Empty for names and ratios.
    column : str
        Column of the table of cases with the level.
    run_keys : tuple of str
        Keys of a run of which one gives the levels.
    kind : str
        ``name`` (of an input of the study), ``number``, or ``own`` for a factor with words of its own.
    tag : callable
        (run, level) -> part of the case id, without the parts that never vary; None for no part.
    """

    key: str
    label: str
    unit: str
    column: str
    run_keys: tuple[str, ...]
    kind: Literal["name", "number", "own"]
    tag: Callable[[Run, Level], str | None]

    @property
    def title(self) -> str:
        """Label and unit."""
        return f"{self.label}, {self.unit}" if self.unit else self.label

    def levels(self, run: Run) -> tuple[Level, ...]:
        """Return the levels of the factor in a run, one or more."""
        value = next((found for key in self.run_keys if (found := getattr(run, key)) is not None), None)
        return value if isinstance(value, tuple) else (value,)


def short_number(value: float) -> str:
    """Write a number with letters, digits only: 0.2 -> 0p2, -5 -> m5."""
    text = f"{abs(value):.9g}".replace(".", "p").replace("e", "x").replace("+", "").replace("-", "m")
    return ("m" if math.copysign(1.0, value) < 0 and value != 0 else "") + text


def _name(run: Run, level: Level) -> str:
    return str(level)


def _with_unit(unit: str) -> Callable[[Run, Level], str]:
    return lambda run, level: f"{short_number(level)}{unit}"


def _speed(run: Run, level: Level) -> str:
    return f"{short_number(level)}{'rpm' if run.speed_rpm is not None else 'mps'}"


def _creep(run: Run, level: Level) -> str | None:
    if level == "free_rolling":
        return "free"
    varies = isinstance(run.creep_percent, tuple) and len(run.creep_percent) > 1
    return f"creep{short_number(level)}" if level != 0.0 or varies else None


def _poisson(run: Run, level: Level) -> str | None:
    return None if level is None else f"nu{short_number(level)}"


FACTORS = (
    Factor("path", "Path", "", "path", ("path",), "name", _name),
    Factor("block", "Block", "", "block", ("block",), "name", _name),
    Factor("compound", "Compound", "", "compound", ("compound",), "name", _name),
    Factor("friction", "Friction law", "", "friction", ("friction",), "name", _name),
    Factor("poissons_ratio", "Poisson's ratio", "", "poissons_ratio", ("poissons_ratio",), "number", _poisson),
    Factor(
        "temperature_degC", "Temperature", "°C", "temperature_degC", ("temperature_degC",), "number", _with_unit("c")
    ),
    Factor(
        "interference_mm", "Interference", "mm", "interference_mm", ("interference_mm",), "number", _with_unit("mm")
    ),
    Factor("speed", "Speed", "", "speed_m_s", ("speed_rpm", "speed_m_s"), "own", _speed),
    Factor("creep", "Creep ratio", "", "creep_percent", ("creep_percent",), "own", _creep),
)
"""In the order of the grid: the last varies fastest."""
