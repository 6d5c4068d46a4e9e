"""The map made: points run, table and figures written, the rule tried on points that it did not see."""

from __future__ import annotations

import csv
import io
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import write_text
from ..provenance import commit, version
from ..source_code import code_digest
from ..spring.variants import code_digest as model_digest
from ..study import Case
from ..yaml_text import write_yaml
from .calibration import coverage, factors, fitted, held_out
from .design import design
from .figures import error_figure, held_out_figure
from .points import MESHES, MODELS
from .rule import Rule
from .store import run_points
from .summary import summary
from .table import ERRORS, Point, point_of, table_text


@dataclass(frozen=True)
class MapSettings:
    """How much of the map is made: points, minutes after which no new one begins, processes side by side."""

    runs: int
    minutes: float
    jobs: int = 1


def build(base: Case, output: Path, settings: MapSettings, say: Callable[[str], None]) -> tuple[Point, ...]:
    """Run what is missing, write table, record (what made it) and figures, and return the points.

    Raises `InputError` where no point is done yet.
    """
    begin = time.monotonic()
    cases = design(base, settings.runs)
    done = run_points(
        cases, output / "points", say, lambda: time.monotonic() - begin < 60.0 * settings.minutes, settings.jobs
    )
    points = [point for point in (point_of(data, MESHES[1]) for data in done) if point is not None]
    refused = sum("refused" in data for data in done)
    weak = len(done) - refused - len(points)
    left = settings.runs - len(done)
    told = f"{refused} refused, {weak} whose FE is no reference, {left} still to run"
    say(f"{len(points)} of {settings.runs} points, {told}")
    if not points:
        raise InputError("map", "no point done", "more minutes")
    rows = tried(cases, points)
    for (model, quantity), found in coverage(rows).items():
        say(f"{model}, {quantity}: {found} of the held-out errors below the limit for nine in ten")
    write_text(output / "map.csv", table_text(points))
    counts = {"points": len(points), "refused": refused, "no_reference": weak, "asked_for": settings.runs}
    record = {**counts, **_made_by(), **_worth(points, rows)}
    write_yaml(output / "map.yaml", record)
    write_text(output / "summary.md", summary(points, record))
    write_text(output / "held_out.csv", _csv(rows))
    error_figure(points, output / "figures" / "errors")
    if rows:
        held_out_figure(rows, output / "figures" / "held_out")
    return tuple(points)


def _made_by() -> dict[str, Any]:
    return {
        "engine_code": code_digest("fe"), "models_code": {model: model_digest(model) for model in MODELS},
        "meshes": list(MESHES), "version": version(), "commit": commit(),
    }  # fmt: skip


def _worth(points: Sequence[Point], rows: Sequence[Row]) -> dict[str, Any]:
    """Return the factors of the rule, and the share of the held-out errors below their limits with its interval."""
    shares = {
        f"{model} {quantity}": {
            "below": found.inside, "of": found.count, "interval_95": [round(end, 3) for end in found.interval]
        }
        for (model, quantity), found in coverage(rows).items()
    }  # fmt: skip
    widened = {
        model: {
            name: {each: round(value, 3) for each, value in own.items()} for name, own in factors(points, model).items()
        }
        for model in points[0].errors
    }
    return {"fitted": len(fitted(points)), "held_out": len(held_out(points)), "factors": widened, "coverage": shares}


Row = Mapping[str, object]


def tried(cases: Sequence[Case], points: Sequence[Point]) -> list[Row]:
    """Return a row for each model and quantity of each held-out point inside the map: what is expected, what is."""
    by_id = {case.case_id: case for case in cases}
    rule, rows = Rule(points), list[Row]()
    for point in held_out(points):
        for model, errors in point.errors.items():
            found = rule.expect(by_id[point.case_id], model)
            if found.normal is None or found.outside:
                continue
            rows += [
                {"case_id": point.case_id, "model": model, "quantity": each, "expected": getattr(found, each),
                 "limit": found.likely[each], "actual": abs(errors[each])}
                for each in ERRORS
            ]  # fmt: skip
    return rows


def _csv(rows: Sequence[Row]) -> str:
    text = io.StringIO()
    writer = csv.DictWriter(text, ("case_id", "model", "quantity", "expected", "limit", "actual"), lineterminator="\n")
    writer.writeheader()
    writer.writerows({k: f"{v:.4f}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)
    return text.getvalue()
