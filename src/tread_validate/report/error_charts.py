"""Data of the page's error heat maps and of its scatter plot."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..compare.quantities import HEADLINE
from ..compare.tables import MetricRow
from ..palette import Look
from . import wording
from .cases import CaseView, Facet, facets
from .content import Widget
from .marks import Marks
from .tables import Tables, pair_of, pairs_of

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
    choices: dict[str, list[tuple[int, str]]] = {}
    data: list[dict[str, Any]] = []
    pairs = pairs_of(tables.errors)
    pairs = pairs_of(row for row in tables.errors if _shown(row) is not None) or pairs[:1]
    for quantity, metric in HEADLINE:
        own = [row for row in tables.errors if (row.quantity, row.metric) == (quantity, metric)]
        found = [(row, value) for row in own if (value := _shown(row)) is not None]
        limits: dict[str, float] = {}
        for row, value in found:
            kind = _kind(row)
            limits[kind] = max(limits.get(kind, 0.0), abs(value - _centre(row)))
        for pair in pairs if own else ():
            cells = {
                row.case_id: [_text(row, value), _rounded((value - _centre(row)) / (limits[_kind(row)] or 1.0))]
                for row, value in found
                if pair_of(row) == pair
            }
            names = f"{wording.source(pair[0])} compared with {wording.source(pair[1])}"
            choices.setdefault(names, []).append((len(data), wording.quantity(quantity, metric)))
            low, high = _scale_ends(own[0], limits)
            data.append({"cells": cells, "lowText": low, "highText": high})
    grid = [_facet(facet, data[0]["cells"] if data else {}) for facet in facets(views)]
    low, high = (data[0]["lowText"], data[0]["highText"]) if data else ("", "")
    everything = marks.of_column(row.assumed for row in tables.errors)
    return Widget("heatmap", {"choices": choices, "facets": grid, "low": low, "high": high, "marks": everything}), data


def _shown(row: MetricRow) -> float | None:
    """Return what a cell shows: a score itself, of anything else the error."""
    return row.predicted if row.error_type == "score" else row.error


def _centre(row: MetricRow) -> float:
    return 1.0 if row.error_type == "score" else 0.0


def _kind(row: MetricRow) -> str:
    return row.unit if row.error_type == "absolute" else row.error_type


def _text(row: MetricRow, value: float) -> str:
    return wording.error(value, row.error_type, wording.unit(row.unit), row.metric)


def _scale_ends(row: MetricRow, limits: dict[str, float]) -> tuple[str, str]:
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
    scalars = [row for row in tables.errors if row.metric == "scalar"]
    labels = {view.case_id: view.label for view in views}
    choices: list[str] = []
    data: list[dict[str, Any]] = []
    for quantity in SCATTER:
        own = [row for row in scalars if row.quantity == quantity]
        if not own:
            continue
        unit = own[0].unit
        own = [row for row in own if row.reference and row.predicted and (row.reference > 0) == (row.predicted > 0)]
        series = []
        several = len({row.reference_source for row in own}) > 1
        for pair in pairs_of(own):
            points = [
                (row.case_id, abs(row.reference), abs(row.predicted))
                for row in own
                if pair_of(row) == pair and row.reference and row.predicted
            ]
            statistics = tables.statistics(pair, quantity)
            look = looks[pair[0]]
            series.append(
                {
                    "label": wording.source(pair[0]) + (f" compared with {wording.source(pair[1])}" if several else ""),
                    "ids": [case for case, _, _ in points],
                    "labels": [labels.get(case, case) for case, _, _ in points],
                    "x": [_rounded(x) for _, x, _ in points],
                    "y": [_rounded(y) for _, _, y in points],
                    "bias": None if statistics is None else statistics.bias,
                    "sigma": None if statistics is None else statistics.model_scatter,
                    "color": look.color,
                    "symbol": look.symbol,
                }
            )
        choices.append(wording.quantity(quantity))
        spreads = [row.reference_scatter for row in tables.ensemble if (row.group, row.quantity) == ("all", quantity)]
        reference = max((value for value in spreads if value is not None), default=None)
        data.append({"unit": unit, "series": series, "reference": reference})
    assumed = marks.of_column(row.assumed for row in scalars)
    return Widget("scatter", {"choices": choices, "marks": assumed}), data
