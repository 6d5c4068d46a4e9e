"""Tables of results: ensemble statistics, Table 1, differences of slopes, published claims."""

from __future__ import annotations

from typing import Any

import pandas as pd

from . import wording
from .content import Cell, Column, Row, Table, Tone
from .marks import Marks
from .tables import Tables, number, records

HEADLINE = (
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


def value_cell(value: float | None, text: str, note: str = "", tone: Tone = "") -> Cell:
    """Return a numeric cell that sorts by its value."""
    return Cell(text, sort=value, note=note, tone=tone)


def verdict_cell(verdict: object, note: object = "", status: object = "current") -> Cell:
    """Return a verdict with its symbol and reason; without a verdict, the status in words."""
    key = str(verdict or "")
    if str(status) == "not_compared":
        return Cell("not compared", tone="mute", note=str(note or ""))
    if not key:
        words = wording.status(str(status)) if str(status) != "current" else "not judged"
        return Cell(words, tone="mute", note=str(note or ""))
    reason = str(note or "")
    if str(status) not in ("current", "", "not_compared"):
        reason = "; ".join(part for part in (wording.status(str(status)), reason) if part)
    return Cell(wording.verdict(key), tone=wording.TONES.get(key, "mute"), note=reason)


def ensemble_table(tables: Tables, marks: Marks, *, headline: bool) -> Table:
    """Return the ensemble statistics: the headline quantities over all cases, or every row."""
    frame = tables.ensemble
    if headline:
        wanted = {key: rank for rank, key in enumerate(HEADLINE)}
        found = [row for row in records(frame) if row["group"] == "all" and (row["quantity"], row["metric"]) in wanted]
        found.sort(key=lambda row: (*_order(row), wanted[row["quantity"], row["metric"]]))
        answered = {_pair(row) for row in found if number(row["compared"])}
        # a comparison with nothing to compare with is one row, not eleven
        found = [row for row in found if _pair(row) in answered or (row["quantity"], row["metric"]) == HEADLINE[0]]
    else:
        found = sorted(records(frame), key=_order)
    rows = tuple(_ensemble_row(record, marks, headline) for record in found)
    columns = [
        Column("Quantity", wide=True),
        Column("Cases compared", "of all", numeric=True),
        Column("Mean |error|", numeric=True),
        Column("Largest |error|", numeric=True),
        Column("Bias δ", "predicted / reference", numeric=True),
        Column("Scatter σ", "of the model", numeric=True),
        Column("Within tolerance", "cases", numeric=True),
    ]
    if not headline:
        columns.insert(1, Column("Cases"))
    title = "Models against their references, all cases" if headline else "Every ensemble statistic"
    caption = (
        "Bias and scatter over ln(predicted/reference), as in the FDS validation guide; δ = 1 is no bias. An ISO/TS "
        "18571 score is better the nearer it is to 1: > 0.94 excellent, > 0.80 good, > 0.58 fair."
    )
    return Table(
        "results" if headline else "ensemble",
        title,
        tuple(columns),
        rows,
        caption,
        with_marks=True,
        folded=not headline,
        empty="No comparison: no case has both a spring run and a current reference.",
    )


def _order(record: dict[str, Any]) -> tuple[bool, str, str]:
    """Spring models against FE come first."""
    predicted, reference = _pair(record)
    return not (predicted.startswith("spring") and reference.startswith("fe")), predicted, reference


def _pair(record: dict[str, Any]) -> tuple[str, str]:
    return str(record["predicted_source"]), str(record["reference_source"])


def _ensemble_row(record: dict[str, Any], marks: Marks, headline: bool) -> Row:
    kind, unit = str(record["error_type"]), str(record["unit"])
    compared, cases = number(record["compared"]) or 0.0, number(record["cases"]) or 0.0
    mean, largest = number(record["mean_abs_error"]), number(record["largest_abs_error"])
    passed = number(record["passed"])
    note = str(record["note"] or "")
    if compared:  # how many are missing stands in the next column already
        note = "; ".join(part for part in note.split("; ") if not part.endswith("runs cannot be compared"))
    if compared == 0:
        note = note or wording.status(str(record["status"]))

    def show(value: float | None) -> str:
        if value is None or kind == "score":
            return wording.digits(value)
        return wording.percent(value) if kind == "relative" else f"{wording.digits(value)} {unit}".strip()

    cells = [
        Cell(wording.quantity(str(record["quantity"]), str(record["metric"])), note=note),
        value_cell(compared, f"{compared:.0f} of {cases:.0f}"),
        value_cell(mean, show(mean)),
        value_cell(largest, show(largest), note=str(record["largest_case_id"] or "")),
        value_cell(number(record["bias"]), wording.digits(number(record["bias"]))),
        value_cell(number(record["model_scatter"]), wording.percent(number(record["model_scatter"]))),
        value_cell(passed, f"{passed:.0f}" if passed is not None and compared else "–"),
    ]
    if not headline:
        cells.insert(1, Cell(wording.group(str(record["group"]))))
    pair = (
        f"{wording.source(str(record['predicted_source']))} against {wording.source(str(record['reference_source']))}"
    )
    return Row(tuple(cells), marks.of(record["assumed"]), group=pair)


def count_verdicts(frame: pd.DataFrame) -> dict[str, int]:
    """Count the verdicts of some rows; rows without one count as ``none``."""
    counts = {"agrees": 0, "disagrees": 0, "cannot tell": 0, "none": 0}
    for verdict in frame["verdict"]:
        counts[str(verdict) if str(verdict) in counts else "none"] += 1
    return counts
