"""The paper's Table 1 with every source, and whether two sources differ."""

from __future__ import annotations

from ..compare.tables import Coefficient
from . import wording
from .content import Cell, Column, Row, Table
from .marks import Marks
from .results import value_cell
from .tables import Tables

COEFFICIENTS = {"a_v": "a_v (speed), %/(m/s)", "a_theta": "a_θ (temperature), %/°C"}


def regression_sources(tables: Tables) -> list[str]:
    """Return the sources of the regressions: published first, then measured, FE and spring models."""
    names = list(dict.fromkeys(row.source for row in tables.regression))
    rank = {"rig:published": 0, "fe:published": 1, "rig:measured": 2}
    kinds = {"fe": 3, "spring": 4, "model": 5}
    return sorted(names, key=lambda name: rank.get(name, kinds.get(name.split(":")[0], 5)))


def table1(tables: Tables, marks: Marks) -> Table:
    """Return the paper's Table 1 with a column for every source."""
    means = [row for row in tables.regression if row.set == "mean"]
    sources = regression_sources(tables)
    columns = [Column("Block"), Column("Coefficient", "of the force")]
    for name in sources:
        own = marks.of_column(row.assumed for row in means if row.source == name)
        columns.append(Column(wording.source(name), numeric=True, marks=own))
    rows = []
    keys = dict.fromkeys((row.shape, row.coefficient) for row in means)
    by_key = {(row.source, row.shape, row.coefficient): row for row in means}
    for shape, coefficient in keys:
        cells = [Cell(shape), Cell(COEFFICIENTS.get(coefficient, coefficient))]
        cells += [_coefficient_cell(by_key.get((name, shape, coefficient))) for name in sources]
        rows.append(Row(tuple(cells)))
    return Table(
        "table1",
        "Table 1 with every source: sensitivity of the peak normal force to speed and temperature",
        tuple(columns),
        tuple(rows),
        "Interferences of 0.1 and 0.2 mm, as in the paper. Under each value: its spread over the data sets (sd of four "
        "for a_v, range of two for a_θ) and the confidence interval of the mean.",
        help="Per cent of the peak normal force per m/s of surface speed, and per degree.",
        csv="regression.csv",
    )


def _coefficient_cell(row: Coefficient | None) -> Cell:
    if row is None:
        return Cell("–", tone="mute")
    if row.value is None:
        return Cell("–", tone="mute", note=row.note or wording.status(row.status))
    notes = []
    if row.spread_kind == "sd" and row.spread is not None:
        notes.append(f"sd {_percent(row.spread)}")
    elif row.low is not None and row.high is not None:
        notes.append(f"{_percent(row.low)} to {_percent(row.high)}")
    if row.ci_low is not None and row.ci_high is not None:
        notes.append(f"{100.0 * row.ci_level:.0f} % CI {_percent(row.ci_low)} to {_percent(row.ci_high)}")
    return Cell(_percent(row.value), sort=row.value, note="; ".join(notes))


def _percent(value: float) -> str:
    return f"{100.0 * value:.2f}".replace("-", "−")


def differences_table(tables: Tables, marks: Marks) -> Table:
    """Return whether two sources' coefficients differ significantly."""
    rows = []
    for row in tables.differences:
        low, high = row.ci_low, row.ci_high
        interval = f"{_percent(low)} to {_percent(high)}" if low is not None and high is not None else "–"
        outcome, tone = ("differ", "bad") if row.significant else ("no significant difference", "")
        if row.significant is None:
            outcome, tone = "cannot tell", "mute"
        cells = (
            Cell(row.shape),
            Cell(COEFFICIENTS.get(row.coefficient, row.coefficient)),
            Cell(f"{wording.source(row.source_b)} less {wording.source(row.source_a)}"),
            value_cell(row.difference, "–" if row.difference is None else _percent(row.difference)),
            value_cell(low, interval),
            value_cell(row.p_value, wording.digits(row.p_value, 2)),
            value_cell(row.p_holm, wording.digits(row.p_holm, 2), note=f"of {row.tests}" if row.tests else ""),
            Cell(outcome, tone=tone, note=row.note),  # type: ignore[arg-type]  # the tone is one of the literals
        )
        rows.append(Row(cells, marks.of(row.assumed)))
    columns = (
        Column("Block"),
        Column("Coefficient"),
        Column("Sources compared", wide=True),
        Column("Difference", "% per m/s or °C", numeric=True),
        Column("Confidence interval", "% per m/s or °C", numeric=True),
        Column("p", "of this test alone", numeric=True),
        Column("p, corrected", "Holm, for all tests", numeric=True),
        Column("Outcome"),
    )
    return Table(
        "differences",
        "Do the sources differ?",
        columns,
        tuple(rows),
        with_marks=True,
        folded=True,
        empty="No pairs.",
        help="Second source less first. Holm's correction keeps the chance of one false difference in all at 5 %.",
        csv="regression_differences.csv",
    )
