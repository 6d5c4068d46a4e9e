"""Figures of the map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..files import atomic_path
from ..palette import GREEN, PURPLE, VERMILION
from .table import Point

SHOWN: tuple[tuple[str, str, tuple[float, ...]], ...] = (
    ("interference", "D/h", (0.003, 0.01, 0.03)), ("length", "l/h", (1.5, 2.0, 3.0, 4.0)),
    ("radius", "R/l", (3.0, 6.0, 10.0, 30.0)), ("friction", "mu", ()),
    ("creep", "creep over the sticking limit", ()), ("poisson", "Poisson's ratio", ()),
)  # fmt: skip
"""Groups, their labels, and the ticks of those on a logarithmic axis."""
STYLES = {"shape_factor": (VERMILION, "^"), "condensed_coarse": (PURPLE, "s"), "condensed": (GREEN, "D")}
"""Colour and marker of the models that are drawn."""


def error_figure(points: Sequence[Point], path: Path) -> None:
    """Draw the error of peak N and of T against each group."""
    for quantity, label in (("normal", "error of peak N"), ("tangential", "error of the peaks of T")):
        figure = Figure(figsize=(9.0, 5.6), layout="constrained")
        FigureCanvasAgg(figure)
        for axes, (name, title, ticks) in zip(figure.subplots(2, 3, sharey=True).flat, SHOWN, strict=True):
            for model, (color, marker) in STYLES.items():
                x = [getattr(point.groups, name) for point in points]
                y = [100.0 * max(abs(point.errors[model][quantity]), 1e-4) for point in points]
                axes.plot(x, y, marker, color=color, ms=3.5, alpha=0.75, mew=0.0, label=model)
            axes.set_yscale("log")
            if ticks:
                axes.set_xscale("log")
                axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
                axes.minorticks_off()
            axes.set_xlabel(title)
            axes.grid(color="#e6e9ec", linewidth=0.6)
        figure.axes[0].legend(fontsize=7.5, frameon=False)
        figure.supylabel(f"{label}, %", fontsize=9.0)
        _save(figure, path.with_name(f"{path.name}_{quantity}"))


def held_out_figure(rows: Sequence[Mapping[str, object]], path: Path) -> None:
    """Draw actual against expected errors of the points that the rule did not see."""
    figure = Figure(figsize=(8.6, 3.2), layout="constrained")
    FigureCanvasAgg(figure)
    for axes, quantity in zip(figure.subplots(1, 3), ("normal", "impulse", "tangential"), strict=True):
        for model, (color, marker) in STYLES.items():
            chosen = [row for row in rows if row["model"] == model and row["quantity"] == quantity]
            x = [100.0 * float(str(row["expected"])) for row in chosen]
            y = [100.0 * max(float(str(row["actual"])), 1e-4) for row in chosen]
            axes.loglog(x, y, marker, color=color, ms=4, alpha=0.8, mew=0.0, label=model)
        axes.plot([0.05, 100.0], [0.05, 100.0], color="#57606a", lw=0.8)
        axes.set(xlabel="expected error, %", title=quantity)
        axes.grid(color="#e6e9ec", linewidth=0.6)
    figure.axes[0].set_ylabel("actual error, %")
    figure.axes[0].legend(fontsize=7.5, frameon=False)
    _save(figure, path)


def _save(figure: Figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    for suffix in (".svg", ".png"):
        with atomic_path(path.with_suffix(suffix)) as temporary:
            figure.savefig(temporary, dpi=120, metadata={"Date": None} if suffix == ".svg" else None)
