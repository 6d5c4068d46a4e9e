"""The map made: points run, table and figures written, the rule tried on points that it did not see."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..files import write_text
from ..provenance import commit, version
from ..study import Case
from ..yaml_text import write_yaml
from .design import design
from .figures import error_figure, held_out_figure
from .points import MESHES, run_points
from .rule import expected_error
from .table import ERRORS, Point, point_of, table_text

HELD_OUT = 5
"""Every fifth point is predicted from the others."""


@dataclass(frozen=True)
class Settings:
    """How much of the map is made: points, and minutes after which no new one begins."""

    runs: int
    minutes: float


def build(base: Case, output: Path, settings: Settings, say: Callable[[str], None]) -> tuple[Point, ...]:
    """Run what is missing, write table, record (what made it) and figures, and return the points.

    Raises `InputError` where no point is done yet.
    """
    begin = time.monotonic()
    cases = design(base, settings.runs)
    done = run_points(cases, output / "points", say, lambda: time.monotonic() - begin < 60.0 * settings.minutes)
    points = [point for point in (point_of(data, MESHES[1]) for data in done) if point is not None]
    refused = sum("refused" in data for data in done)
    weak = len(done) - refused - len(points)
    left = settings.runs - len(done)
    told = f"{refused} refused, {weak} whose FE is no reference, {left} still to run"
    say(f"{len(points)} of {settings.runs} points, {told}")
    if not points:
        raise InputError("map", "no point done", "more minutes")
    write_text(output / "map.csv", table_text(points))
    bound = {str(data["bound"]["fe"]) for data in done}
    record = {
        "points": len(points), "refused": refused, "no_reference": weak, "asked_for": settings.runs,
        "fe_code": sorted(bound), "models_code": done[0].get("models_bound", {}), "version": version(),
        "commit": commit(),
    }  # fmt: skip
    write_yaml(output / "map.yaml", record)
    rows = held_out(cases, points)
    write_text(output / "held_out.csv", _csv(rows))
    error_figure(points, output / "figures" / "errors")
    if rows:
        held_out_figure(rows, output / "figures" / "held_out")
        for model, share in coverage(rows).items():
            say(f"{model}: {100 * share:.0f} % of the held-out errors below the limit for nine in ten")
    return tuple(points)


Row = tuple[str, str, str, float, float, float]


def held_out(cases: Sequence[Case], points: Sequence[Point]) -> list[Row]:
    """Return (case, model, quantity, expected, likely, actual error) of every fifth point, from the others."""
    by_id = {case.case_id: case for case in cases}
    away = points[HELD_OUT - 1 :: HELD_OUT]
    rest = [point for point in points if point not in away]
    rows: list[Row] = []
    for point in away:
        for model, errors in point.errors.items():
            found = expected_error(by_id[point.case_id], model, rest)
            if found.normal is None:
                continue
            for each in ERRORS:
                expected = getattr(found, each)
                rows.append((point.case_id, model, each, expected, found.likely[each], abs(errors[each])))
    return rows


def coverage(rows: Sequence[Row]) -> dict[str, float]:
    """Return for each model the share of the actual errors below what nine in ten should stay below."""
    models = dict.fromkeys(row[1] for row in rows)
    return {model: float(np.mean([row[5] <= row[4] for row in rows if row[1] == model])) for model in models}


def _csv(rows: Sequence[Row]) -> str:
    head = "case_id,model,quantity,expected,likely,actual\n"
    return head + "".join(f"{','.join(row[:3])},{row[3]:.4f},{row[4]:.4f},{row[5]:.4f}\n" for row in rows)
