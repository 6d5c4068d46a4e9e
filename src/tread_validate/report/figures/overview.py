"""The picture of the first screen: one case, its reference with a band of uncertainty, and every model."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ...compare.tables import MetricRow
from ...compare.thinned import thin
from ...files import write_text
from ...history import History
from ...palette import Look
from ...plotting import canvas, note, styled
from ...units import IN_MS
from .. import wording
from ..cases import CaseView
from ..content import Figure, Mark
from ..histories import SAMPLES
from ..marks import in_words
from .numbers import numbers_text
from .style import save_light

SIZE = (6.6, 2.75)  # inches
PEAK = {"normal": "peak_normal_force", "tangential": "peak_positive_tangential_force"}
NAMES = {"normal": "normal force N, N", "tangential": "longitudinal force T, N"}


def overview(
    folder: Path,
    view: CaseView,
    histories: Mapping[str, History],
    looks: Mapping[str, Look],
    errors: tuple[MetricRow, ...],
    marks: tuple[Mark, ...],
) -> Figure:
    """Draw normal and longitudinal force of one case side by side, the legend above both."""
    drawn = [name for name in looks if name in histories]
    reference = next((name for name in drawn if name.startswith(("fe:", "rig:"))), "")
    with styled():
        figure = canvas(SIZE)
        grid = figure.subplots(1, 2)
        for axes, force in zip(grid, ("normal", "tangential"), strict=True):
            _panel(axes, force, drawn, histories, looks)
            if reference:
                _band(axes, histories[reference], force, errors, reference)
        handles, labels = grid[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper left", ncols=min(4, len(labels)))
        if marks:
            note(figure, in_words(marks), low=True)
        svg, data = folder / "overview.svg", folder / "overview.csv"
        save_light(figure, svg)
        write_text(data, numbers_text(grid))
    title = "reference and models" if reference else "the models, without a reference"
    caption = f"{view.label}."
    if reference:
        caption += f" Band: {wording.source(reference)} and the expanded uncertainty U of its peak's comparison."
    return Figure("overview", f"One case: {title}", caption, svg, marks, wide=True, data=data)


def _panel(
    axes: Axes, force: str, drawn: list[str], histories: Mapping[str, History], looks: Mapping[str, Look]
) -> None:
    for source in drawn:
        history, look = histories[source], looks[source]
        keep = thin(history, SAMPLES)
        axes.plot(
            IN_MS * history.time[keep], _values(history, force)[keep], linestyle=look.line, color=look.color,
            label=wording.source(source),
        )  # fmt: skip
    axes.axhline(0.0, color="#57606a", lw=0.7)
    axes.set(xlabel="time from first contact, ms", ylabel=NAMES[force])


def _values(history: History, force: str) -> NDArray[np.float64]:
    return history.normal_force if force == "normal" else history.tangential_force


def _band(axes: Axes, history: History, force: str, errors: tuple[MetricRow, ...], reference: str) -> None:
    """Shade the reference by the largest U of the models' peaks: a share of the force, or newtons."""
    own = [row for row in errors if (row.quantity, row.metric) == (PEAK[force], "scalar")]
    known = [row for row in own if row.uncertainty is not None and row.reference_source == reference]
    if not known:
        return
    widest = max(known, key=lambda row: row.uncertainty or 0.0)
    values = _values(history, force)
    width = (widest.uncertainty or 0.0) * (np.abs(values) if widest.error_type == "relative" else np.ones(values.size))
    keep = thin(history, SAMPLES)
    time = IN_MS * history.time[keep]
    axes.fill_between(
        time, (values - width)[keep], (values + width)[keep], color="#9aa3ab", alpha=0.35, lw=0,
        label="_band of the expanded uncertainty",
    )  # fmt: skip
