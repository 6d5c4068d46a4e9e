"""Still versions of the page's heat maps and scatter plot, for the PDF."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from ...palette import Look
from ...plotting import WIDTH
from .. import wording
from ..cases import CaseView, facets
from ..content import Mark
from ..tables import Tables, pair_of, pairs_of
from .style import Drawn, draw

RAMP = LinearSegmentedColormap.from_list("error", ["#80b8de", "#ffffff", "#f29c68"])

MOST_ROWS = 60  # of a heat map on paper


def heat(
    folder: Path, tables: Tables, views: tuple[CaseView, ...], pair: tuple[str, str], marks: tuple[Mark, ...]
) -> Drawn:
    """Draw the peak normal force's error of one model over the test matrix."""
    values = {row.case_id: row.error for row in tables.of_pair(pair) if row.quantity == "peak_normal_force"}
    known = [abs(value) for value in values.values() if value is not None]
    names = f"{wording.source(pair[0])} compared with {wording.source(pair[1])}"
    if not known:
        return Drawn(None, f"{names}: no current reference, so there is no error to draw.")
    every = [row.error for row in tables.errors if (row.quantity, row.metric) == ("peak_normal_force", "scalar")]
    limit = max(abs(error) for error in every if error is not None)  # one scale for all models
    rows = [(facet, label, cells) for facet in facets(views) for label, cells in facet.rows]
    across = max(len(cells) for _, _, cells in rows)
    if len(rows) > MOST_ROWS:
        return Drawn(None, f"{names}: {len(views)} cases do not fit a page; the HTML page has a cell for each.")

    def paint(axes: Axes) -> None:
        grid = np.full((len(rows), across), np.nan)
        labels = []
        for i, (facet, label, cells) in enumerate(rows):
            labels.append(f"{facet.title}: {label}")
            for j, view in enumerate(cells):
                value = values.get(view.case_id) if view is not None else None
                if value is not None:
                    grid[i, j] = value
                text = "n/a" if value is None else wording.percent(value)
                axes.text(
                    j,
                    i,
                    f"{facet.columns[j]}\n{text}" if view is not None else "",
                    ha="center",
                    va="center",
                    fontsize=6,
                )
        axes.imshow(grid, cmap=RAMP, vmin=-limit, vmax=limit, aspect="auto")
        axes.set_xticks([])
        axes.set_yticks(np.arange(len(rows)), labels, fontsize=6)
        axes.grid(visible=False)
        axes.tick_params(length=0)

    size = (1.5 * WIDTH, 0.245 * len(rows) + 0.4)
    key = f"heat-{pair[0]}-{pair[1]}".replace(":", "-")
    caption = f"Colours from blue, {wording.percent(-limit)}, over white, none, to orange, {wording.percent(limit)}; "
    caption += "one scale for all models."
    numbers = (("case_id", "error"), list(values.items()))
    title = f"Error of the peak normal force, {names}"
    return draw(folder, key, title, caption, paint, marks, size, wide=True, numbers=numbers)


def scatter(folder: Path, tables: Tables, looks: Mapping[str, Look], quantity: str, marks: tuple[Mark, ...]) -> Drawn:
    """Draw predicted against reference with the ensemble's bias and two standard deviations."""
    own = [row for row in tables.errors if (row.quantity, row.metric) == (quantity, "scalar")]
    points: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for pair in pairs_of(own):
        both = [(row.reference, row.predicted) for row in own if pair_of(row) == pair]
        found = [(abs(x), abs(y)) for x, y in both if x and y and (x > 0) == (y > 0)]
        if found:
            points[pair] = found
    if not points:
        return Drawn(None, f"{wording.quantity(quantity)}: no current reference to compare with.")

    def paint(axes: Axes) -> None:
        every = np.array([point for found in points.values() for point in found])
        ends = np.array([0.85 * every.min(), 1.18 * every.max()])
        axes.plot(ends, ends, color="#000", lw=0.9, label="_equal")
        own_scatter = [
            row.reference_scatter for row in tables.ensemble if (row.group, row.quantity) == ("all", quantity)
        ]
        widest = max((value for value in own_scatter if value is not None), default=None)
        for sign in (-2.0, 2.0) if widest is not None else ():
            label = "_equality times exp(±2σ) of the reference"
            axes.plot(ends, ends * np.exp(sign * (widest or 0.0)), color="#57606a", lw=0.8, ls=":", label=label)
        for pair, found in points.items():
            look = looks[pair[0]]
            stats = tables.statistics(pair, quantity)
            name = wording.source(pair[0])
            bias, sigma = (None, None) if stats is None else (stats.bias, stats.model_scatter)
            if bias is not None:
                axes.plot(ends, bias * ends, color=look.color, lw=1.2, ls="--", label=f"_bias, {name}")
                if sigma is not None:
                    spread = np.exp(2.0 * sigma)
                    axes.fill_between(
                        ends,
                        bias * ends / spread,
                        bias * ends * spread,
                        color=look.color,
                        alpha=0.15,
                        lw=0,
                        label=f"_bias times exp(±2σ), {name}",
                    )
            x, y = np.array(found).T
            label = f"{name} compared with {wording.source(pair[1])}"
            axes.plot(x, y, look.marker, ms=4, color=look.color, mec="white", mew=0.5, label=label)
        unit = own[0].unit
        axes.set(xscale="log", yscale="log", xlabel=f"reference, {unit}", ylabel=f"predicted, {unit}")
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if ends[1] < 50.0 * ends[0] else (1.0,)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_formatter(NullFormatter())
        axes.legend()

    caption = "Line: equal; dotted: 2σ of the reference about it; dashed: bias δ; shaded: bias times exp(±2σ)."
    return draw(folder, f"scatter-{quantity.replace('_', '-')}", wording.quantity(quantity), caption, paint, marks)
