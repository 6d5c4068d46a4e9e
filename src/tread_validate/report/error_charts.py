"""Data of the page's error heat maps and of its scatter plot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from . import wording
from .cases import CaseView, Facet, facets
from .content import Widget
from .marks import Marks
from .palette import Look
from .results import HEADLINE
from .tables import Tables, number, records

SCATTER = (
    "peak_normal_force",
    "peak_positive_tangential_force",
    "peak_negative_tangential_force",
    "normal_impulse",
    "contact_duration",
)


def heatmap(tables: Tables, views: tuple[CaseView, ...], marks: Marks) -> tuple[Widget, list[dict[str, Any]]]:
    """Return the heat maps' grid and, for every model and quantity, each case's text and place on the colour scale.

    A quantity may be judged in per cent for some cases and in newtons for others; each kind has its own scale.
    """
    frame = tables.errors
    pairs = list(dict.fromkeys(zip(frame["predicted_source"], frame["reference_source"], strict=True)))
    choices: dict[str, list[tuple[int, str]]] = {}
    data: list[dict[str, Any]] = []
    known = {(row["predicted_source"], row["reference_source"]) for row in records(frame) if _shown(row) is not None}
    pairs = [pair for pair in pairs if pair in known] or pairs[:1]
    for quantity, metric in HEADLINE:
        own = records(frame[(frame["quantity"] == quantity) & (frame["metric"] == metric)])
        found = [(row, value) for row in own if (value := _shown(row)) is not None]
        limits: dict[str, float] = {}
        for row, value in found:
            kind = _kind(row)
            limits[kind] = max(limits.get(kind, 0.0), abs(value - _centre(row)))
        for predicted, reference in pairs if own else ():
            cells = {
                str(row["case_id"]): [_text(row, value), _rounded((value - _centre(row)) / (limits[_kind(row)] or 1.0))]
                for row, value in found
                if (row["predicted_source"], row["reference_source"]) == (predicted, reference)
            }
            names = f"{wording.source(str(predicted))} against {wording.source(str(reference))}"
            choices.setdefault(names, []).append((len(data), wording.quantity(quantity, metric)))
            low, high = _scale_ends(own[0], limits)
            data.append({"cells": cells, "lowText": low, "highText": high})
    grid = [_facet(facet, data[0]["cells"] if data else {}) for facet in facets(views)]
    low, high = (data[0]["lowText"], data[0]["highText"]) if data else ("", "")
    everything = marks.of_column(frame["assumed"])
    return Widget("heatmap", {"choices": choices, "facets": grid, "low": low, "high": high, "marks": everything}), data


def _shown(row: dict[str, Any]) -> float | None:
    """Return what a cell shows: a score itself, of anything else the error."""
    return number(row["predicted"] if row["error_type"] == "score" else row["error"])


def _centre(row: dict[str, Any]) -> float:
    return 1.0 if row["error_type"] == "score" else 0.0


def _kind(row: dict[str, Any]) -> str:
    return str(row["unit"]) if row["error_type"] == "absolute" else str(row["error_type"])


def _text(row: dict[str, Any], value: float) -> str:
    return wording.error(value, str(row["error_type"]), wording.unit(str(row["unit"])), str(row["metric"]))


def _scale_ends(row: dict[str, Any], limits: dict[str, float]) -> tuple[str, str]:
    """Name the ends of the colour scale: values where all cases are judged alike, words otherwise."""
    if len(limits) != 1:
        return "below the reference", "above"
    (kind, limit), centre = next(iter(limits.items())), _centre(row)
    if kind in ("relative", "score"):
        show = wording.percent if kind == "relative" else wording.digits
        return show(centre - limit), show(centre + limit)
    return f"{wording.digits(-limit)} {kind}", f"{wording.digits(limit)} {kind}"


def _facet(facet: Facet, cells: dict[str, list[Any]]) -> dict[str, Any]:
    def cell(view: CaseView | None) -> dict[str, str] | None:
        if view is None:
            return None
        return {"id": view.case_id, "label": view.label, "text": cells.get(view.case_id, ["n/a"])[0]}

    rows = [{"label": label, "cells": [cell(view) for view in members]} for label, members in facet.rows]
    return {"title": facet.title, "corner": facet.corner, "columns": facet.columns, "rows": rows}


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
        several = own["reference_source"].nunique() > 1
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
                    "label": wording.source(str(predicted))
                    + (f" against {wording.source(str(reference))}" if several else ""),
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
