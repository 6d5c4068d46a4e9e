"""What a map comes to, as Markdown: errors by model and by region, and what the rule's limits are worth."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from .calibration import CLASSES, Coverage
from .table import ERRORS, Point

HEADS = ("peak N", "impulse of N", "peaks of T")
REGIONS: tuple[tuple[str, Callable[[Point], bool]], ...] = (
    ("all", lambda point: True),
    ("belts, R/l of 6 or more", lambda point: point.kind.startswith("belt") and point.groups.radius >= 6.0),
    ("belts, R/l below 6", lambda point: point.kind.startswith("belt") and point.groups.radius < 6.0),
    ("rig", lambda point: point.kind.startswith("rig")),
    ("D/h below 0.01", lambda point: point.groups.interference < 0.01),
    ("D/h above 0.05", lambda point: point.groups.interference > 0.05),
    ("creep beyond the sticking limit", lambda point: abs(point.groups.creep) > 1.0),
    ("Poisson's ratio above 0.47", lambda point: point.groups.poisson > 0.47),
    ("parallelograms", lambda point: point.groups.skew > 0.0),
)
MODEL = "condensed"
"""Whose errors are told region by region."""


def summary(points: Sequence[Point], record: Mapping[str, Any]) -> str:
    """Return the page; `record` is that of ``map.yaml``."""
    counts = (
        f"{record['points']} points of {record['asked_for']} asked for; {record['no_reference']} whose FE is no "
        f"reference, {record['refused']} refused. Made at {record['commit']}."
    )
    mesh = ", ".join(
        f"{head} {_three([point.reference[each] for point in points])}"
        for head, each in zip(HEADS, ERRORS, strict=True)
    )
    parts = [
        f"{counts} Distance of the finer mesh from the limit of both (median / nine in ten / worst): {mesh}.",
        "Errors of the models against that limit, median / nine in ten / worst:",
        _table("model", {f"`{model}`": (points, model) for model in points[0].errors}),
        f"`{MODEL}`, region by region:",
        _table("region", {
            f"{name} ({len(own)})": (own, MODEL)
            for name, inside in REGIONS if (own := [point for point in points if inside(point)])
        }),
        *_worth(record),
    ]  # fmt: skip
    return "\n\n".join(parts) + "\n"


def _worth(record: Mapping[str, Any]) -> list[str]:
    """Return the coverage of the limits on the points held out, and the factors on the local scale."""
    if "coverage" not in record:
        return ["The map was made before its limits were tried on points held out."]
    lines = ["| model | " + " | ".join(HEADS) + " |", "|---|---|---|---|"]
    for model, factors in record["factors"].items():
        cells = []
        for each in ERRORS:
            found = record["coverage"].get(f"{model} {each}")
            share = "none inside the map" if found is None else str(Coverage(found["below"], found["of"]))
            widened = ", ".join(f"{factors[name][each]:.2g} {name}" for name in reversed(CLASSES))
            cells.append(f"{share}; factor {widened}")
        lines.append(f"| `{model}` | " + " | ".join(cells) + " |")
    return [
        f"The limit for nine in ten, calibrated on {record['fitted']} points and tried on {record['held_out']} others. "
        "Errors below their limit among those held out and inside the map, and the factor on the local scale:",
        "\n".join(lines),
    ]


def _table(head: str, rows: Mapping[str, tuple[Sequence[Point], str]]) -> str:
    lines = [f"| {head} | " + " | ".join(HEADS) + " |", "|---|---|---|---|"]
    for name, (points, model) in rows.items():
        cells = [_three([point.errors[model][each] for point in points]) for each in ERRORS]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _three(errors: Sequence[float]) -> str:
    sizes = 100.0 * np.abs(errors)
    return f"{np.median(sizes):.1f} / {np.quantile(sizes, 0.9):.1f} / {sizes.max():.0f} %"
