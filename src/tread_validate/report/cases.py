"""Cases as the reader picks them: labels, factors and their levels."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any

import pandas as pd

from . import wording
from .tables import number, records

FACTORS = (
    ("path", "Path"),
    ("block", "Block"),
    ("compound", "Compound"),
    ("friction", "Friction law"),
    ("temperature_degC", "Temperature, °C"),
    ("interference_mm", "Interference, mm"),
    ("speed", "Speed"),
    ("creep", "Creep ratio"),
)
PATHS = {"rig": "two-wheel rig", "simplified": "belt, simplified", "mid_top": "belt, mid-top trace"}


@dataclass(frozen=True)
class CaseView:
    """One case with the words for its factor levels."""

    case_id: str
    run: str
    levels: dict[str, str]
    label: str
    assumed: str
    row: dict[str, Any]


def case_views(cases: pd.DataFrame) -> tuple[CaseView, ...]:
    """Return the cases in the table's order."""
    return tuple(_view(row) for row in records(cases))


def _view(row: dict[str, Any]) -> CaseView:
    rpm, speed = number(row["speed_rpm"]), number(row["speed_m_s"])
    creep = number(row["creep_percent"])
    free = str(row["free_rolling"]).lower() in ("true", "1", "1.0")
    levels = {
        "path": PATHS.get(str(row["path"]), str(row["path"]).replace("_", " ")),
        "block": str(row["block"]).replace("_", " "),
        "compound": str(row.get("compound", "")).replace("_", " "),
        "friction": str(row.get("friction", "")).replace("_", " "),
        "temperature_degC": _plain(number(row["temperature_degC"])),
        "interference_mm": _plain(number(row["interference_mm"])),
        "speed": f"{_plain(rpm)} rpm" if rpm is not None else f"{_plain(speed)} m/s",
        "creep": "free rolling" if free else f"{_plain(creep)} %",
    }
    parts = [
        levels["path"],
        levels["block"],
        f"{levels['temperature_degC']} °C",
        f"{levels['interference_mm']} mm",
        f"{levels['speed']} ({wording.digits(speed)} m/s)" if rpm is not None else levels["speed"],
    ]
    if free:
        parts.append("free rolling" + (f" (creep {wording.digits(creep)} %)" if creep is not None else ""))
    elif creep:
        parts.append(f"creep {levels['creep']}")
    return CaseView(str(row["case_id"]), str(row["run"]), levels, " · ".join(parts), str(row["assumed"]), row)


def factor_levels(views: tuple[CaseView, ...]) -> list[dict[str, Any]]:
    """Return the factors that vary in the study, each with its levels in order of appearance."""
    found = []
    for key, label in FACTORS:
        levels = list(dict.fromkeys(view.levels[key] for view in views))
        if len(levels) > 1 or key == "path":
            found.append({"key": key, "label": label, "levels": levels})
    return found


@dataclass(frozen=True)
class Facet:
    """A grid of cases: two factors span it, the others are fixed and stand in its title."""

    title: str
    corner: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, tuple[CaseView | None, ...]], ...]


def facets(views: tuple[CaseView, ...]) -> tuple[Facet, ...]:
    """Split the cases of every run into grids over their two factors with the most levels."""
    found: list[Facet] = []
    for run, members in itertools.groupby(views, key=lambda view: view.run):
        found += _facets_of_run(run, tuple(members))
    return tuple(found)


def _facets_of_run(run: str, views: tuple[CaseView, ...]) -> list[Facet]:
    levels = {key: list(dict.fromkeys(view.levels[key] for view in views)) for key, _ in FACTORS}
    varying = [key for key, _ in FACTORS if len(levels[key]) > 1]
    ranked = sorted(varying, key=lambda key: -len(levels[key]))
    across = ranked[0] if ranked else "speed"
    down = ranked[1] if len(ranked) > 1 else "path"
    fixed = [key for key in varying if key not in (across, down)]
    names = dict(FACTORS)
    found = []
    for combination in itertools.product(*(levels[key] for key in fixed)):
        chosen = {
            (view.levels[across], view.levels[down]): view
            for view in views
            if all(view.levels[key] == level for key, level in zip(fixed, combination, strict=True))
        }
        title = ", ".join([run.replace("_", " "), *map(_with_unit, fixed, combination)])
        rows = tuple((y, tuple(chosen.get((x, y)) for x in levels[across])) for y in levels[down])
        corner = f"{names[down]} \\ {names[across]}"
        found.append(Facet(title[:1].upper() + title[1:], corner, tuple(levels[across]), rows))
    return found


def _with_unit(key: str, level: str) -> str:
    return {"temperature_degC": f"{level} °C", "interference_mm": f"{level} mm"}.get(key, level)


def _plain(value: float | None) -> str:
    return "–" if value is None else f"{value:.6g}".replace("-", "−")
