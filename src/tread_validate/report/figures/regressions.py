"""Speed and temperature coefficients with their intervals, and the regressions' residuals."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from .. import wording
from ..content import Mark
from ..palette import BLACK, Look
from ..tables import Tables, number, records
from .style import HEIGHT, WIDTH, Drawn, draw

NAMES = {"a_v": "a_v, % per m/s", "a_theta": "a_θ, % per °C"}


def coefficients(folder: Path, tables: Tables, sources: list[str], coefficient: str, marks: tuple[Mark, ...]) -> Drawn:
    """Draw one coefficient of every source and shape with its spread (thick) and confidence interval (thin)."""
    frame = tables.regression[(tables.regression["set"] == "mean") & (tables.regression["coefficient"] == coefficient)]
    points: list[tuple[str, float, dict[str, Any]]] = []
    for source in sources:
        own = frame[frame["source"] == source].sort_values("shape", ascending=False, kind="stable")
        for record in records(own):
            value = number(record["value"])
            if value is not None:
                points.append((source, value, record))
    if not points:
        return Drawn(None, f"No values of {NAMES[coefficient].split(',')[0]} to draw.")

    def paint(axes: Axes) -> None:
        labels = []
        for place, (source, value, record) in enumerate(points):
            own = marks_color(source)
            low, high = number(record["low"]), number(record["high"])
            ci = number(record["ci_low"]), number(record["ci_high"])
            if ci[0] is not None and ci[1] is not None:
                axes.plot([100 * ci[0], 100 * ci[1]], [place, place], lw=1.0, color=own)
            if low is not None and high is not None:
                axes.plot([100 * low, 100 * high], [place, place], lw=3.5, color=own, alpha=0.45, solid_capstyle="butt")
            marker = "s" if record["shape"] == "rectangle" else "D"
            axes.plot(100 * value, place, marker, ms=5, color=own)
            labels.append(f"{wording.source(source)}, {record['shape']}")
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
    frame = tables.regression_residuals
    frame = frame[frame["coefficient"] == coefficient]
    if not len(frame):
        return Drawn(None, f"No residuals of {NAMES[coefficient].split(',')[0]} to draw.")
    sources = [name for name in dict.fromkeys(frame["source"]) if name in looks]

    def paint(axes: Axes) -> None:
        span = float(frame["x"].max() - frame["x"].min()) or 1.0
        for place, source in enumerate(sources):
            own = frame[frame["source"] == source]
            shift = 0.012 * span * (place - 0.5 * (len(sources) - 1))  # side by side, so that none hides another
            look = looks[source]
            axes.plot(
                own["x"] + shift,
                own["residual_percent"],
                look.marker,
                ms=3.5,
                color=look.color,
                mfc="none",
                label=wording.source(source),
            )
        axes.axhline(0.0, color="#57606a", lw=0.7)
        unit = {"m/s": "surface speed, m/s", "degC": "temperature, °C"}.get(str(frame["x_unit"].iloc[0]), "x")
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
