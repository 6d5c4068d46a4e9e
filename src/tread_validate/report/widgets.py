"""Data of the page's interactive parts: case browser, error heat maps, scatter plot."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..history import History
from ..palette import Look
from . import wording
from .cases import CaseView, factor_levels
from .content import Mark, Widget
from .histories import pack, samples_each
from .marks import Marks, by_origin
from .tables import Tables

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
    index = {factor["key"]: {level: i for i, level in enumerate(factor["levels"])} for factor in factors}
    states = _states(tables)
    samples = samples_each(sum(len(sources) for sources in histories.values()))
    cases = [
        {
            "id": view.case_id,
            "run": view.run,
            "label": view.label,
            "levels": {key: index[key][view.levels[key]] for key in index},
            "marks": [[origin, [_mark(mark) for mark in own]] for origin, own in by_origin(marks.of(view.assumed))],
            "status": states.get(view.case_id, "no FE reference recorded"),
        }
        for view in views
    ]
    data = {
        "cases": cases,
        "factors": [{"key": factor["key"]} for factor in factors],
        "first": _first(views, histories),
        "sources": [
            {
                "key": key,
                "label": wording.source(key),
                "color": look.color,
                "dash": look.dash,
                "reference": key.startswith("fe:"),
                "slips": not key.startswith("rig:"),  # slip is not measured on the rig
            }
            for key, look in looks.items()
        ],
        "histories": {
            case: {key: pack(item, samples) for key, item in sources.items()} for case, sources in histories.items()
        },
        "errors": _case_errors(tables),
    }
    return Widget("browser", {"factors": factors}), data


def _first(views: tuple[CaseView, ...], histories: Mapping[str, Mapping[str, History]]) -> str:
    """Choose the case to open with: the one with most histories, the first of these."""
    if not views:
        return ""
    return max(views, key=lambda view: len(histories.get(view.case_id, {}))).case_id


def _mark(mark: Mark) -> dict[str, str]:
    return {"text": mark.code, "title": mark.text, "href": f"assumption-{mark.code}"}


def _states(tables: Tables) -> dict[str, str]:
    found: dict[str, list[str]] = {}
    for row in tables.peaks:
        if row.source.startswith("fe:") and row.source != "fe:published":
            found.setdefault(row.case_id, []).append(f"{wording.source(row.source)}: {wording.status(row.status)}")
    return {case: "; ".join(texts) for case, texts in found.items()}


def _case_errors(tables: Tables) -> dict[str, list[dict[str, str]]]:
    found: dict[str, list[dict[str, str]]] = {}
    for row in tables.errors:
        if row.metric in PARTS:
            continue
        unit = wording.unit(row.unit)
        if row.error is None and row.reference is None and row.predicted is None:
            continue
        # a run that cannot be compared at all says so once, above its values
        alike = row.error is None and row.status not in ("current", "undefined", "no_contact")
        why = "; ".join(part for part in (wording.status(row.status), row.note) if part) if alike else ""
        found.setdefault(row.case_id, []).append(
            {
                "q": wording.quantity(row.quantity, row.metric) + (f", {unit}" if unit else ""),
                "p": wording.source(row.predicted_source),
                "r": wording.source(row.reference_source),
                "a": wording.digits(row.reference, 4),
                "b": wording.digits(row.predicted, 4),
                "e": wording.error(row.error, row.error_type, metric=row.metric),
                "v": "–" if alike else wording.verdict(row.verdict),
                "tone": "" if alike else wording.TONES.get(row.verdict, ""),
                "note": "" if alike else row.note,
                "why": why,
            }
        )
    return found
