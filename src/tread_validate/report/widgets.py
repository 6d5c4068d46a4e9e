"""Data of the page's interactive parts: case browser, error heat maps, scatter plot."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from ..compare.tables import MetricRow
from ..compare.thinned import pack
from ..history import History
from ..palette import Look
from . import wording
from .cases import CaseView, factor_levels
from .content import Widget
from .histories import samples_each
from .html import deflated
from .marks import Marks, by_origin
from .models import judged
from .tables import Tables

OWN = ("current", "undefined", "no_contact", "not_given")  # statuses of one quantity, not of a whole run
FIRST = ("peak_normal_force", "peak_positive_tangential_force", "peak_negative_tangential_force")
"""Quantities whose errors a reader of one case sees first, beside the overall scores of its histories."""
# parts of a score that the browser leaves to the CSV tables
PARTS = ("iso18571_corridor", "iso18571_phase", "iso18571_magnitude", "iso18571_slope")


def browser(
    tables: Tables,
    views: tuple[CaseView, ...],
    histories: Mapping[str, Mapping[str, History]],
    looks: Mapping[str, Look],
    marks: Marks,
) -> tuple[Widget, dict[str, Any]]:
    """Return the case browser and its data."""
    factors = factor_levels(views)
    index = {factor.key: {level: i for i, level in enumerate(factor.levels)} for factor in factors}
    states = _states(tables)
    errors = _case_errors(tables)
    samples = samples_each(sum(len(sources) for sources in histories.values()))
    cases = [
        {
            "id": view.case_id,
            "run": view.run,
            "label": view.label,
            "levels": {key: index[key][view.levels[key]] for key in index},
            "marks": [[origin, [mark.code for mark in own]] for origin, own in by_origin(marks.of(view.assumed))],
            "status": states.get(view.case_id, "no FE reference recorded"),
        }
        for view in views
    ]
    data = {
        "cases": cases,
        "marks": {mark.code: mark.text for mark in marks.all()},
        "factors": [{"key": factor.key} for factor in factors],
        "first": _first(views, histories),
        "sources": [
            {
                "key": key,
                "label": wording.source(key),
                "color": look.color,
                "dash": look.dash,
                "reference": key.startswith("fe:"),
                "slips": not key.startswith("rig:"),  # sliding is not measured on the rig
            }
            for key, look in looks.items()
        ],
        "packed": {
            view.case_id: _packed(histories.get(view.case_id, {}), errors.get(view.case_id, []), samples)
            for view in views
        },
    }
    return Widget("browser", {"factors": factors}), data


def _packed(sources: Mapping[str, History], errors: list[dict[str, str]], samples: int) -> str:
    """Return what the browser shows of one case, deflated: it is inflated when the case is chosen."""
    own = {"histories": {key: pack(item, samples) for key, item in sources.items()}, "errors": errors}
    return deflated(json.dumps(own, separators=(",", ":"), sort_keys=True, allow_nan=False))


def _first(views: tuple[CaseView, ...], histories: Mapping[str, Mapping[str, History]]) -> str:
    """Choose the case to open with: the one with most histories, the first of these."""
    if not views:
        return ""
    return max(views, key=lambda view: len(histories.get(view.case_id, {}))).case_id


def _states(tables: Tables) -> dict[str, str]:
    found: dict[str, list[str]] = {}
    for row in tables.peaks:
        if row.source.startswith("fe:") and row.source != "fe:published":
            found.setdefault(row.case_id, []).append(f"{wording.source(row.source)}: {wording.status(row.status)}")
    return {case: "; ".join(texts) for case, texts in found.items()}


def _case_errors(tables: Tables) -> dict[str, list[dict[str, str]]]:
    """Return the errors of every case; what is said of a whole run stands once, beside its name."""
    groups: dict[tuple[str, str, str], list[MetricRow]] = {}
    for row in tables.errors:
        if row.metric not in PARTS and any(value is not None for value in (row.error, row.reference, row.predicted)):
            groups.setdefault((row.case_id, row.predicted_source, row.reference_source), []).append(row)
    found: dict[str, list[dict[str, str]]] = {}
    for (case, *_), rows in groups.items():
        alike = set.intersection(*(_parts(row.note) for row in rows)) if len(rows) > 1 else set()
        status = next((wording.status(row.status) for row in rows if row.status not in OWN), "")
        why = "; ".join(part for part in (status, *sorted(alike)) if part)
        found.setdefault(case, []).extend(_case_error(row, why, alike) for row in rows)
    return found


def _parts(note: str) -> set[str]:
    return {part for part in note.split("; ") if part}


def _case_error(row: MetricRow, why: str, alike: set[str]) -> dict[str, str]:
    first = row.metric == "iso18571" or (row.metric == "scalar" and row.quantity in FIRST)
    unit = wording.unit(row.unit)
    open_ = row.error is None and row.status not in OWN
    return {
        "q": wording.quantity(row.quantity, row.metric) + (f", {unit}" if unit else ""),
        "p": wording.source(row.predicted_source),
        "r": wording.source(row.reference_source),
        "a": wording.digits(row.reference, 4),
        "b": wording.digits(row.predicted, 4),
        "e": wording.error(row.error, row.error_type, metric=row.metric),
        "v": "–" if open_ else wording.assessment(row.assessment),
        "u": "" if row.error is None or (row.uncertainty is None and row.u_data is None) else judged(row),
        "tone": "" if open_ else wording.TONES.get(row.assessment, ""),
        "note": "; ".join(part for part in row.note.split("; ") if part not in alike),
        "why": why,
        "first": "1" if first else "",
    }
