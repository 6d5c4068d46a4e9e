"""The committed table of the map: one row a point, its groups and every model's errors."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import read_text
from ..text_table import text_table
from .groups import NAMES, Groups

TABLE = Path(__file__).resolve().parent / "map.csv"
ERRORS = ("normal", "impulse", "tangential")
"""Peak N and impulse over FE's, peaks of T over the larger one of FE's."""
MOST = {"residual": 0.01, "artificial": 0.02, "impact": 0.02, "unsteadiness": 0.005, "alternation": 0.02}
"""Energy unaccounted for, hourglass energy, loss at impacts and scatter of T beyond which a run is no reference, as
`fe.quality` has; share of T's impulse lost to chatter of nodes: four times as much, less than the mesh may cost."""
MOST_MESH_ERROR = 0.05
"""The same for the distance of the finer mesh from the limit of both, in peak N."""
LEAST_CONTACT = 3.0
"""Elements of the finer mesh over the rig's length of contact, 2 sqrt(2 D R), below which two meshes that agree mean
nothing: with 2.1 they were 1 % apart and 9 % from a mesh twice as fine."""
KINDS = ("belt, flat", "belt, conforming", "rig, conforming", "rig, flat")


@dataclass(frozen=True)
class Point:
    """A point of the map.

    Attributes
    ----------
    reference : mapping of str to float
        How far the finer FE mesh is from the limit of both, relative, for each of `ERRORS`.
    errors : mapping of str to mapping
        Error of each model against that limit, signed for N and impulse.
    """

    case_id: str
    kind: str
    groups: Groups
    reference: Mapping[str, float]
    errors: Mapping[str, Mapping[str, float]]


def point_of(data: Mapping[str, Any], mesh: int) -> Point | None:
    """Return the point of a run's data; None for one that was refused, or whose FE runs are no reference.

    `mesh` is the number of elements per height of the finer mesh.
    """
    if "refused" in data or "models" not in data or not is_reference(data, mesh):
        return None
    groups = Groups(**data["groups"])
    if data["kind"].startswith("rig") and mesh * contact_length(groups) < LEAST_CONTACT:
        return None
    finest, limit = f"fe_{mesh}", data["limit"]
    errors = {model: relative(forces, limit) for model, forces in data["models"].items()}
    return Point(data["case_id"], data["kind"], groups, relative(data[finest], limit), errors)


def contact_length(groups: Groups) -> float:
    """Return the length of contact on a wheel, 2 sqrt(2 D R), over the block's height."""
    return 2.0 * math.sqrt(2.0 * groups.interference * groups.radius * groups.length)


def is_reference(data: Mapping[str, Any], mesh: int) -> bool:
    """Tell whether the finer FE run balances its energy, is free of hourglass forces, steady, and near its limit."""
    if any(data[f"{name}_{mesh}"] > most for name, most in MOST.items()):
        return False
    return abs(float(data[f"fe_{mesh}"]["normal"]) / float(data["limit"]["normal"]) - 1.0) <= MOST_MESH_ERROR


def relative(forces: Mapping[str, float], limit: Mapping[str, float]) -> dict[str, float]:
    """Return the errors of forces against FE's."""
    largest = max(abs(limit["positive"]), abs(limit["negative"]), 0.02 * limit["normal"])
    tangential = max(abs(forces[name] - limit[name]) for name in ("positive", "negative"))
    return {
        "normal": forces["normal"] / limit["normal"] - 1.0,
        "impulse": forces["impulse"] / limit["impulse"] - 1.0,
        "tangential": tangential / largest,
    }


def table_text(points: Iterable[Point]) -> str:
    """Return the table as CSV."""
    points = list(points)
    models = list(points[0].errors)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([
        "case_id", "kind", *NAMES, *(f"reference_{each}" for each in ERRORS),
        *(f"{model}_{each}" for model in models for each in ERRORS),
    ])  # fmt: skip
    for point in points:
        groups = [f"{getattr(point.groups, name):.5g}" for name in NAMES]
        numbers = [point.reference[each] for each in ERRORS]
        numbers += [point.errors[model][each] for model in models for each in ERRORS]
        writer.writerow([point.case_id, point.kind, *groups, *(f"{number:.4f}" for number in numbers)])
    return text.getvalue()


def read_table(text: str) -> tuple[Point, ...]:
    """Read a table back; raises `InputError` for one of another shape."""
    table = text_table(text, "map")
    table.check(("case_id", "kind", *NAMES))
    heads = [name.removesuffix("_normal") for name in table.header if name.endswith("_normal")]
    models = [head for head in heads if head != "reference"]
    try:
        return tuple(
            Point(
                row["case_id"],
                row["kind"],
                Groups(**{name: float(row[name]) for name in NAMES}),
                {each: float(row[f"reference_{each}"]) for each in ERRORS},
                {head: {each: float(row[f"{head}_{each}"]) for each in ERRORS} for head in models},
            )
            for _, row in table.records()
        )
    except (KeyError, ValueError, TypeError) as error:
        raise InputError("map", error, "a number in each column") from error


@cache
def committed() -> tuple[Point, ...]:
    """Return the points that the package brings along; none where the table is not there."""
    return read_table(read_text(TABLE)) if TABLE.is_file() else ()
