"""Speed and temperature coefficients with their intervals, and the regressions' residuals."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from ...compare.tables import Coefficient
from ...palette import BLACK, Look
from ...plotting import HEIGHT, WIDTH
from .. import wording
from ..content import Mark
from ..tables import Tables
from .style import Drawn, draw

NAMES = {"a_v": "a_v, % per m/s", "a_theta": "a_θ, % per °C"}


def coefficients(folder: Path, tables: Tables, sources: list[str], coefficient: str, marks: tuple[Mark, ...]) -> Drawn:
    """Draw one coefficient of every source and shape with its spread (thick) and confidence interval (thin)."""
    points: list[tuple[str, float, Coefficient]] = []
    for source in sources:
        own = [
            row for row in tables.regression if (row.source, row.set, row.coefficient) == (source, "mean", coefficient)
        ]
        own.sort(key=lambda row: row.shape, reverse=True)
        points += [(source, row.value, row) for row in own if row.value is not None]
    if not points:
        return Drawn(None, f"No values of {NAMES[coefficient].split(',')[0]} to draw.")

    def paint(axes: Axes) -> None:
        labels = []
        for place, (source, value, row) in enumerate(points):
            own = marks_color(source)
            low, high = row.low, row.high
            if row.ci_low is not None and row.ci_high is not None:
                axes.plot(
                    [100 * row.ci_low, 100 * row.ci_high],
                    [place, place],
                    lw=1.0,
                    color=own,
                    label="_confidence interval",
                )
            if low is not None and high is not None:
                axes.plot(
                    [100 * low, 100 * high], [place, place], lw=3.5, color=own, alpha=0.45, solid_capstyle="butt",
                    label="_spread over the data sets",
                )  # fmt: skip
            marker = "s" if row.shape == "rectangle" else "D"
            axes.plot(100 * value, place, marker, ms=5, color=own, label="_mean")
            labels.append(f"{wording.source(source)}, {row.shape}")
        axes.set_yticks(np.arange(len(labels)), labels, fontsize=7.0)
        axes.invert_yaxis()
        axes.axvline(0.0, color="#57606a", lw=0.7)
        axes.set_xlabel(NAMES[coefficient])

    def marks_color(source: str) -> str:
        return {"rig:published": BLACK, "fe:published": "#6b737c"}.get(source, "#0072B2")

    name = "speed" if coefficient == "a_v" else "temperature"
    title = f"Effect of {name} on the peak normal force"
    caption = (
        "Marker: mean; thick: spread over the data sets; thin: confidence interval of the mean, where one is given."
    )
    size = (WIDTH, max(HEIGHT, 0.28 * len(points) + 0.9))
    return draw(folder, f"coefficient-{coefficient.replace('_', '-')}", title, caption, paint, marks, size)


def residuals(
    folder: Path, tables: Tables, looks: Mapping[str, Look], coefficient: str, marks: tuple[Mark, ...]
) -> Drawn:
    """Draw the residuals of the regressions in per cent of the fitted force."""
    rows = [row for row in tables.residuals if row.coefficient == coefficient and row.residual_percent is not None]
    if not rows:
        return Drawn(None, f"No residuals of {NAMES[coefficient].split(',')[0]} to draw.")
    if len({row.x for row in rows}) < 3:
        words = (
            f"Residuals of {NAMES[coefficient].split(',')[0]} are not drawn: two levels fix a line and show no curve."
        )
        return Drawn(None, words)
    sources = [name for name in dict.fromkeys(row.source for row in rows) if name in looks]

    def paint(axes: Axes) -> None:
        span = max(row.x for row in rows) - min(row.x for row in rows) or 1.0
        for place, source in enumerate(sources):
            own = [row for row in rows if row.source == source]
            shift = 0.012 * span * (place - 0.5 * (len(sources) - 1))  # side by side, so that none hides another
            look = looks[source]
            axes.plot(
                [row.x + shift for row in own],
                [row.residual_percent or 0.0 for row in own],
                look.marker,
                ms=3.5,
                color=look.color,
                mfc="none",
                label=wording.source(source),
            )
        axes.axhline(0.0, color="#57606a", lw=0.7)
        unit = {"m/s": "surface speed, m/s", "degC": "temperature, °C"}.get(rows[0].x_unit, "x")
        axes.set(xlabel=unit, ylabel="residual, % of fitted force")
        axes.legend()

    name = "speed" if coefficient == "a_v" else "temperature"
    caption = "A curve in the residuals says that the force is not linear, as Eq. (4) of the paper takes it to be."
    return draw(
        folder,
        f"residuals-{coefficient.replace('_', '-')}",
        f"Residuals of the {name} regressions",
        caption,
        paint,
        marks,
    )
