"""Cases as the reader picks them: labels, factors and their levels."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass

from ..compare.tables import CaseRow
from ..study.factors import FACTORS
from . import wording

TITLES = {factor.key: factor.title for factor in FACTORS}
UNITS = {factor.key: factor.unit for factor in FACTORS}
ALWAYS_TOLD = ("path", "block", "temperature_degC", "interference_mm", "speed", "creep")
PATHS = {"rig": "two-wheel rig", "simplified": "belt, simplified", "mid_top": "belt, mid-top trace"}


@dataclass(frozen=True)
class CaseView:
    """One case with the words for its factor levels."""

    case_id: str
    run: str
    levels: dict[str, str]
    label: str
    assumed: str
    row: CaseRow


def case_views(rows: Sequence[CaseRow]) -> tuple[CaseView, ...]:
    """Return the cases in the table's order."""
    return tuple(_view(row, _told([other for other in rows if other.run == row.run])) for row in rows)


def _told(rows: Sequence[CaseRow]) -> list[str]:
    """Return the factors that stand in a case's label: the usual ones, and what else varies in its run."""
    return [
        factor.key
        for factor in FACTORS
        if factor.key in ALWAYS_TOLD or len({getattr(row, factor.column) for row in rows}) > 1
    ]


def _view(row: CaseRow, told: list[str]) -> CaseView:
    rpm, speed, creep, free = row.speed_rpm, row.speed_m_s, row.creep_percent, row.free_rolling
    levels = {
        factor.key: _plain(getattr(row, factor.column))
        if factor.kind == "number"
        else str(getattr(row, factor.column)).replace("_", " ")
        for factor in FACTORS
    }
    levels |= {
        "path": PATHS.get(row.path, levels["path"]),
        "speed": f"{_plain(rpm)} rpm" if rpm is not None else f"{_plain(speed)} m/s",
        "creep": "free rolling" if free else f"{_plain(creep)} %",
    }
    words = {key: _with_unit(key, level) for key, level in levels.items()}
    words |= {key: f"{TITLES[key]} {level}" for key, level in levels.items() if key not in ALWAYS_TOLD}
    if rpm is not None:
        words["speed"] += f" ({wording.digits(speed)} m/s)"
    if free:
        words["creep"] += f" (creep {wording.digits(creep)} %)" if creep is not None else ""
    elif creep:
        words["creep"] = f"creep {levels['creep']}"
    else:
        told = [key for key in told if key != "creep"]
    label = " · ".join(words[key] for key in told)
    return CaseView(row.case_id, row.run, levels, label, row.assumed, row)


@dataclass(frozen=True)
class FactorLevels:
    """A factor of the study, with its levels in order of appearance."""

    key: str
    label: str
    levels: tuple[str, ...]


def factor_levels(views: tuple[CaseView, ...]) -> list[FactorLevels]:
    """Return the factors that vary in the study, each with its levels in order of appearance."""
    found = []
    for factor in FACTORS:
        levels = tuple(dict.fromkeys(view.levels[factor.key] for view in views))
        if len(levels) > 1 or factor.key == "path":
            found.append(FactorLevels(factor.key, factor.title, levels))
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
    levels = {key: list(dict.fromkeys(view.levels[key] for view in views)) for key in TITLES}
    varying = [key for key in TITLES if len(levels[key]) > 1]
    ranked = sorted(varying, key=lambda key: -len(levels[key]))
    across = ranked[0] if ranked else "speed"
    down = ranked[1] if len(ranked) > 1 else "path"
    fixed = [key for key in varying if key not in (across, down)]
    found = []
    for combination in itertools.product(*(levels[key] for key in fixed)):
        chosen = {
            (view.levels[across], view.levels[down]): view
            for view in views
            if all(view.levels[key] == level for key, level in zip(fixed, combination, strict=True))
        }
        title = ", ".join([run.replace("_", " "), *map(_with_unit, fixed, combination)])
        rows = tuple((y, tuple(chosen.get((x, y)) for x in levels[across])) for y in levels[down])
        corner = f"{TITLES[down]} \\ {TITLES[across]}"
        found.append(Facet(title[:1].upper() + title[1:], corner, tuple(levels[across]), rows))
    return found


def _with_unit(key: str, level: str) -> str:
    return f"{level} {UNITS[key]}".rstrip()


def _plain(value: float | None) -> str:
    return "–" if value is None else f"{value:.6g}".replace("-", "−")
