"""Data of the page's error heat maps and of its scatter plot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from . import wording
from .cases import CaseView, facets
from .content import Widget
from .marks import Marks
from .palette import Look
from .tables import Tables, number

HEAT = (
    ("peak_normal_force", "scalar"),
    ("peak_positive_tangential_force", "scalar"),
    ("peak_negative_tangential_force", "scalar"),
    ("normal_impulse", "scalar"),
    ("contact_duration", "scalar"),
    ("normal_force", "relative_rms"),
    ("tangential_force", "relative_rms"),
    ("normal_force", "sprague_geers_c"),
    ("tangential_force", "sprague_geers_c"),
    ("normal_force", "iso18571_r"),
    ("tangential_force", "iso18571_r"),
)
SCATTER = (
    "peak_normal_force",
    "peak_positive_tangential_force",
    "peak_negative_tangential_force",
    "normal_impulse",
    "contact_duration",
)


def heatmap(tables: Tables, views: tuple[CaseView, ...], marks: Marks) -> tuple[Widget, list[dict[str, Any]]]:
    """Return the heat maps' grid and, for every model and quantity, the values."""
    frame = tables.errors
    choices: list[str] = []
    data: list[dict[str, Any]] = []
    pairs = list(dict.fromkeys(zip(frame["predicted_source"], frame["reference_source"], strict=True)))
    for quantity, metric in HEAT:
        own = frame[(frame["quantity"] == quantity) & (frame["metric"] == metric)]
        if not len(own):
            continue
        score = str(own["error_type"].iloc[0]) == "score"
        relative = str(own["error_type"].iloc[0]) == "relative" or metric == "relative_rms"
        shown = own["predicted"] if score else own["error"]
        sizes = [abs(v - (1.0 if score else 0.0)) for v in map(number, shown) if v is not None]
        limit = max(sizes, default=0.0) or 1.0
        for predicted, reference in pairs:
            chosen = (own["predicted_source"] == predicted) & (own["reference_source"] == reference)
            values = dict(zip(own.loc[chosen, "case_id"], map(number, shown[chosen]), strict=True))
            choices.append(
                f"{wording.quantity(quantity, metric)} – {wording.source(str(predicted))} against "
                f"{wording.source(str(reference))}"
            )
            centre = 1.0 if score else 0.0
            data.append(
                {
                    "values": {str(case): _rounded(value) for case, value in values.items()},
                    "relative": relative,
                    "centre": centre,
                    "limit": _rounded(limit),
                    "lowText": _ends(centre - limit, relative),
                    "highText": _ends(centre + limit, relative),
                }
            )
    grid = [_facet(facet, data[0] if data else None) for facet in facets(views)]
    low, high = (data[0]["lowText"], data[0]["highText"]) if data else ("", "")
    everything = marks.of_column(frame["assumed"])
    return Widget("heatmap", {"choices": choices, "facets": grid, "low": low, "high": high, "marks": everything}), data


def _facet(facet: Any, first: dict[str, Any] | None) -> dict[str, Any]:
    def cell(view: CaseView | None) -> dict[str, str] | None:
        if view is None:
            return None
        value = first["values"].get(view.case_id) if first else None
        text = "n/a" if value is None else _ends(value, bool(first and first["relative"]))
        return {"id": view.case_id, "label": view.label, "text": text}

    rows = [{"label": label, "cells": [cell(view) for view in members]} for label, members in facet.rows]
    return {"title": facet.title, "corner": facet.corner, "columns": facet.columns, "rows": rows}


def _ends(value: float, relative: bool) -> str:
    return wording.percent(value) if relative else wording.digits(value)


def _rounded(value: float | None) -> float | None:
    return None if value is None or not math.isfinite(value) else float(f"{value:.6g}")


def scatter(
    tables: Tables, views: tuple[CaseView, ...], looks: Mapping[str, Look], marks: Marks
) -> tuple[Widget, list[dict[str, Any]]]:
    """Return the scatter plot: one point a case, with the ensemble's bias and scatter."""
    frame = tables.errors[tables.errors["metric"] == "scalar"]
    labels = {view.case_id: view.label for view in views}
    choices: list[str] = []
    data: list[dict[str, Any]] = []
    for quantity in SCATTER:
        own = frame[frame["quantity"] == quantity]
        if not len(own):
            continue
        series = []
        for predicted, reference in dict.fromkeys(zip(own["predicted_source"], own["reference_source"], strict=True)):
            rows = own[(own["predicted_source"] == predicted) & (own["reference_source"] == reference)]
            points = [
                (str(case), abs(x), abs(y))
                for case, x, y in zip(
                    rows["case_id"], map(number, rows["reference"]), map(number, rows["predicted"]), strict=True
                )
                if x is not None and y is not None and x != 0.0 and y != 0.0 and (x > 0) == (y > 0)
            ]
            bias, sigma = _bias(tables, quantity, str(predicted), str(reference))
            look = looks[str(predicted)]
            series.append(
                {
                    "label": f"{wording.source(str(predicted))} against {wording.source(str(reference))}",
                    "ids": [case for case, _, _ in points],
                    "labels": [_escape(labels.get(case, case)) for case, _, _ in points],
                    "x": [_rounded(x) for _, x, _ in points],
                    "y": [_rounded(y) for _, _, y in points],
                    "bias": bias,
                    "sigma": sigma,
                    "color": look.color,
                    "symbol": look.symbol,
                }
            )
        choices.append(wording.quantity(quantity))
        data.append({"unit": str(own["unit"].iloc[0]), "series": series})
    return Widget("scatter", {"choices": choices, "marks": marks.of_column(frame["assumed"])}), data


def _bias(tables: Tables, quantity: str, predicted: str, reference: str) -> tuple[float | None, float | None]:
    frame = tables.ensemble
    chosen = frame[
        (frame["group"] == "all")
        & (frame["quantity"] == quantity)
        & (frame["metric"] == "scalar")
        & (frame["predicted_source"] == predicted)
        & (frame["reference_source"] == reference)
    ]
    if not len(chosen):
        return None, None
    return number(chosen["bias"].iloc[0]), number(chosen["model_scatter"].iloc[0])


def _escape(text: str) -> str:
    """Keep plotly from reading markup in a label: it knows a few tags."""
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
