"""What is good enough: the defaults of the catalogue, and what a study puts in their place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ...errors import InputError
from .catalogue import HISTORY_METRIC, SCALAR
from .quantity import HistoryMetric, Quantity

SCALES = {
    "peak_normal_force": "the peak normal force",
    "normal_impulse": "the normal impulse",
    "contact_duration": "the contact duration",
}


class Chosen(Protocol):
    """A tolerance as a study states it."""

    @property
    def value(self) -> float:
        """Share of what the quantity is judged by."""

    @property
    def floor(self) -> float | None:
        """Error in the quantity's unit that is always good enough."""

    @property
    def reason(self) -> str:
        """Why."""


@dataclass(frozen=True)
class Tolerance:
    """How large an error of one quantity or score is good enough.

    Attributes
    ----------
    name, unit : str
        Quantity or score, and the unit of its floor.
    value : float
        Share of what it is judged by.
    floor : float or None
        Error in `unit` that is always good enough.
    criterion : str
        The two in words.
    origin : str
        ``default`` or ``study``.
    reason : str
    """

    name: str
    unit: str
    value: float
    floor: float | None
    criterion: str
    origin: str
    reason: str


Tolerances = Mapping[str, Tolerance]


def tolerances(chosen: Mapping[str, Chosen] | None = None, source: Path | str = "study") -> dict[str, Tolerance]:
    """Return every tolerance by the name of its quantity or score.

    Raises `InputError` for a name that is none, and for a floor where the quantity has none.
    """
    known: dict[str, Quantity | HistoryMetric] = {**SCALAR, **HISTORY_METRIC}
    found = {name: _made(item, item.tolerance, item.floor, "default", item.reason) for name, item in known.items()}
    for name, own in (chosen or {}).items():
        where = f"{source}: tolerances.{name}"
        if name not in known:
            raise InputError(where, "an unknown name", f"one of {', '.join(known)}")
        item = known[name]
        if own.floor is not None and item.floor is None:
            raise InputError(f"{where}.floor", own.floor, "no floor: it is not judged in its unit")
        floor = item.floor if own.floor is None else own.floor
        found[name] = _made(item, own.value, floor, "study", own.reason)
    return found


def _made(item: Quantity | HistoryMetric, value: float, floor: float | None, origin: str, reason: str) -> Tolerance:
    unit = item.unit if isinstance(item, Quantity) else "N"
    return Tolerance(item.name, unit, value, floor, _criterion(item, value, floor), origin, reason)


def _criterion(item: Quantity | HistoryMetric, value: float, floor: float | None) -> str:
    percent = f"{100.0 * value:g} %"
    if isinstance(item, HistoryMetric):
        if item.error_type == "score":
            return f"score at least {1.0 - value:g}"
        return f"{percent} of the largest reference; tangential at least {floor:g} N" if floor else percent
    if item.flag:
        return "equal"
    if item.scale == "one":
        return f"{value:g}"
    if item.scale in SCALES and item.scale != "itself":
        return f"{percent} of {SCALES[item.scale]}"
    unit = "" if item.unit == "1" else f" {item.unit}"
    return f"{percent} of the reference" + (f", at least {floor:g}{unit}" if floor is not None else "")
