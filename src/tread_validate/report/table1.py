"""The paper's Table 1 with every source, and whether two sources differ."""

from __future__ import annotations

from typing import Any

from . import wording
from .content import Cell, Column, Row, Table
from .marks import Marks
from .results import value_cell
from .tables import Tables, number, records

COEFFICIENTS = {"a_v": "a_v (speed), %/(m/s)", "a_theta": "a_θ (temperature), %/°C"}


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
    columns = [Column("Block"), Column("Coefficient", "of the force")]
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
    value = number(record["value"])
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
    return Cell(_percent(value), sort=value, note="; ".join(notes))


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
