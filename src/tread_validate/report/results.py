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
# what agreement with a published statement is worth, by the claims' `kind`
CLAIM_GROUPS = {
    "model": "Predicted by a model, compared with the paper",
    "tuned": "Met because the stand-in compound was made to meet it",
    "study": "Follows from the study's inputs alone",
    "published": "Published numbers against each other",
    "input": "Taken over as an input",
    "context": "Not compared, and why",
}
COEFFICIENTS = {"a_v": "a_v, speed", "a_theta": "a_θ, temperature"}
UNITS = {"s/m": "%/(m/s)", "1/degC": "%/°C"}


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


def regression_sources(tables: Tables) -> list[str]:
    """Return the sources of the regressions: published first, then measured, FE and spring models."""
    names = list(dict.fromkeys(str(name) for name in tables.regression["source"]))
    rank = {"rig:published": 0, "fe:published": 1, "rig:measured": 2}
    kinds = {"fe": 3, "spring": 4}
    return sorted(names, key=lambda name: rank.get(name, kinds.get(name.split(":")[0], 5)))


def table1(tables: Tables, marks: Marks) -> Table:
    """Return the paper's Table 1 with a column for every source."""
    frame = tables.regression[tables.regression["set"] == "mean"]
    sources = regression_sources(tables)
    columns = [Column("Block"), Column("Coefficient", "per cent of the force")]
    for name in sources:
        own = frame[frame["source"] == name]
        columns.append(Column(wording.source(name), numeric=True, marks=marks.of_column(own["assumed"])))
    rows = []
    keys = dict.fromkeys(zip(frame["shape"], frame["coefficient"], strict=True))
    for shape, coefficient in keys:
        cells = [Cell(str(shape)), Cell(COEFFICIENTS.get(str(coefficient), str(coefficient)))]
        for name in sources:
            chosen = (frame["source"] == name) & (frame["shape"] == shape) & (frame["coefficient"] == coefficient)
            cells.append(_coefficient_cell(records(frame[chosen])))
        rows.append(Row(tuple(cells)))
    return Table(
        "table1",
        "Table 1 with every source: sensitivity of the peak normal force to speed and temperature",
        tuple(columns),
        tuple(rows),
        "Interferences of 0.1 and 0.2 mm, as in the paper. Under each value: its spread over the data sets (sd of four "
        "for a_v, range of two for a_θ) and the confidence interval of the mean.",
    )


def _coefficient_cell(found: list[dict[str, Any]]) -> Cell:
    if not found:
        return Cell("–", tone="mute")
    record = found[0]
    value, unit = number(record["value"]), UNITS.get(str(record["unit"]), str(record["unit"]))
    if value is None:
        return Cell("–", tone="mute", note=str(record["note"] or "") or wording.status(str(record["status"])))
    low, high = number(record["low"]), number(record["high"])
    kind, spread = str(record["spread_kind"]), number(record["spread"])
    notes = []
    if kind == "sd" and spread is not None:
        notes.append(f"sd {_percent(spread)}")
    elif low is not None and high is not None:
        notes.append(f"{_percent(low)} to {_percent(high)}")
    ci = number(record["ci_low"]), number(record["ci_high"])
    if ci[0] is not None and ci[1] is not None:
        level = 100.0 * (number(record["ci_level"]) or 0.95)
        notes.append(f"{level:.0f} % CI {_percent(ci[0])} to {_percent(ci[1])}")
    return Cell(f"{_percent(value)} {unit}", sort=value, note="; ".join(notes))


def _percent(value: float) -> str:
    return f"{100.0 * value:.2f}".replace("-", "−")


def differences_table(tables: Tables, marks: Marks) -> Table:
    """Return whether two sources' coefficients differ significantly."""
    rows = []
    for record in records(tables.regression_differences):
        significant = str(record["significant"]).lower()
        known = significant in ("true", "1", "1.0", "false", "0", "0.0")
        yes = significant in ("true", "1", "1.0")
        low, high, difference = (number(record[key]) for key in ("ci_low", "ci_high", "difference"))
        interval = f"{_percent(low)} to {_percent(high)}" if low is not None and high is not None else "–"
        outcome = Cell("differ" if yes else "no significant difference", tone="bad" if yes else "")
        if not known:
            outcome = Cell("cannot tell", tone="mute")
        cells = (
            Cell(str(record["shape"])),
            Cell(COEFFICIENTS.get(str(record["coefficient"]), str(record["coefficient"]))),
            Cell(f"{wording.source(str(record['source_a']))} – {wording.source(str(record['source_b']))}"),
            value_cell(difference, "–" if difference is None else _percent(difference)),
            value_cell(low, interval),
            value_cell(number(record["p_value"]), wording.digits(number(record["p_value"]), 2)),
            Cell(outcome.text, tone=outcome.tone, note=str(record["note"] or "")),
        )
        rows.append(Row(cells, marks.of(record["assumed"])))
    columns = (
        Column("Block"),
        Column("Coefficient"),
        Column("Sources compared", wide=True),
        Column("Difference", "% per m/s or °C", numeric=True),
        Column("Confidence interval", "% per m/s or °C", numeric=True),
        Column("p", numeric=True),
        Column("Outcome"),
    )
    return Table(
        "differences", "Do the sources differ?", columns, tuple(rows), with_marks=True, folded=True, empty="No pairs."
    )


def claims_table(tables: Tables, marks: Marks) -> Table:
    """Return every published statement with its computed counterpart and verdict."""
    rows: list[tuple[int, Row]] = []
    order = {kind: rank for rank, kind in enumerate(CLAIM_GROUPS)}
    for record in records(tables.claims):
        computed, published = number(record["computed"]), number(record["published"])
        unit = wording.unit(str(record["unit"]))
        stated, bounds = _stated(record, published, unit)
        error = number(record["error"])
        cells = (
            Cell(str(record["section"])),
            Cell(str(record["statement"])),
            value_cell(published, stated, note=bounds),
            Cell(wording.source(str(record["source"])) if record["source"] else "–"),
            value_cell(computed, f"{wording.plain(computed, 4)} {unit}".strip() if computed is not None else "–"),
            value_cell(error, wording.error(error, str(record["error_type"]), unit)),
            verdict_cell(record["verdict"], record["note"], record["status"]),
        )
        group = "context" if record["status"] == "not_compared" else str(record["kind"])
        rows.append(
            (order.get(group, 0), Row(cells, marks.of(record["assumed"]), group=CLAIM_GROUPS.get(group, group)))
        )
    rows.sort(key=lambda item: item[0])
    columns = (
        Column("Section"),
        Column("Published statement", wide=True),
        Column("Published", numeric=True),
        Column("Source"),
        Column("Computed", numeric=True),
        Column("Error", numeric=True),
        Column("Verdict", wide=True),
    )
    title = "What the paper states, and what is found here"
    return Table("claims", title, columns, tuple(row for _, row in rows), with_marks=True)


def _stated(record: dict[str, Any], value: float | None, unit: str) -> tuple[str, str]:
    """Return the published value as printed, and its bounds; a range without a value stands in the value's place."""
    low, high = number(record["published_low"]), number(record["published_high"])
    kind = str(record.get("spread_kind", "") or "")
    kind = "" if kind == "none" else kind
    bounds = f"{wording.plain(low)} to {wording.plain(high)}" if low is not None and high is not None else ""
    if value is None:
        return (f"{bounds} {unit}".strip() if bounds else "–"), kind if bounds else ""
    return f"{wording.plain(value)} {unit}".strip(), f"{bounds} ({kind})" if bounds and kind else bounds or kind


def count_verdicts(frame: pd.DataFrame) -> dict[str, int]:
    """Count the verdicts of some rows; rows without one count as ``none``."""
    counts = {"agrees": 0, "disagrees": 0, "cannot tell": 0, "none": 0}
    for verdict in frame["verdict"]:
        counts[str(verdict) if str(verdict) in counts else "none"] += 1
    return counts
