"""Figures of the ladder: error against cost, Sobol indices, rate and temperature coefficients."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from ..files import atomic_path

# Okabe and Ito's colours, told apart by marker as well
STYLES = {
    "paper": ("#0072B2", "o"),
    "bonded_theory": ("#E69F00", "v"),
    "bonded": ("#D55E00", "^"),
    "coupled_coarse": ("#CC79A7", "s"),
    "coupled": ("#009E73", "D"),
    "fe": ("#000000", "P"),
}
RC: dict[Any, Any] = {
    "font.family": "DejaVu Sans", "font.size": 9.0, "axes.titlesize": 9.0, "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False, "legend.fontsize": 7.5, "axes.grid": True,
    "grid.color": "#e6e9ec", "grid.linewidth": 0.6, "axes.axisbelow": True, "svg.fonttype": "path",
    "svg.hashsalt": "tread_validate",
}  # fmt: skip
Rows = Sequence[Mapping[str, Any]]


def pareto_figure(rows: Rows, meshes: Rows, path: Path) -> None:
    """Draw the error of the peak normal force and the score of the tangential force against the time of a pass."""
    with _styled():
        figure = Figure(figsize=(8.6, 4.2), layout="constrained")
        FigureCanvasAgg(figure)
        _leave_room(figure)
        left, right = figure.subplots(1, 2)
        for row in rows:
            error = row["mean_abs_peak_normal_force_error"]
            if row["group"] == "all" or error is None:
                continue
            color, marker = STYLES[row["rung"]]
            look = {
                "color": color, "ms": 7, "ls": "none", "label": f"{row['rung']}, {row['group']}",
                "mfc": color if row["group"] == "rig" else "white",
            }  # fmt: skip
            left.plot(row["seconds_per_pass"], 100.0 * error, marker, **look)
            right.plot(row["seconds_per_pass"], row["mean_iso18571_tangential"], marker, **look)
        color, marker = STYLES["fe"]
        for row in meshes:
            if row["seconds_estimated"] is None:
                continue
            filled = row["case_id"].startswith("rig")
            place = row["seconds_estimated"], max(100.0 * abs(row["peak_normal_force_error"]), 0.02)
            left.plot(*place, marker, color=color, ms=8, mfc=color if filled else "white", ls="none")
            left.annotate(f"FE {row['element_size_mm']:g} mm", place, textcoords="offset points", xytext=(5, 5), size=7)
        left.set(xscale="log", yscale="log", xlabel="processor time of one pass, s")
        left.set_ylabel("mean |error| of the peak normal force, %")
        left.set_title("Normal force, against the FE runs\n(FE meshes: against their own limit)", loc="left")
        right.set(xscale="log", ylim=(0.0, 1.02), xlabel="processor time of one pass, s")
        right.set_ylabel("mean ISO/TS 18571 score")
        right.set_title("Tangential force history, against the FE runs\n(1 is perfect)", loc="left")
        figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=5)
        _mark(figure, rows)
        _save(figure, path)


def sobol_figure(rows: Rows, path: Path) -> None:
    """Draw total and first-order indices for each run and quantity, the inputs sorted by their largest total."""
    panels = list(dict.fromkeys((row["run"], row["quantity"]) for row in rows))
    if not panels:
        return
    with _styled():
        columns = min(2, len(panels))
        lines = -(-len(panels) // columns)
        figure = Figure(figsize=(4.6 * columns, 0.5 + 2.6 * lines), layout="constrained")
        FigureCanvasAgg(figure)
        _leave_room(figure)
        for index, (run, quantity) in enumerate(panels):
            own = sorted(
                (row for row in rows if (row["run"], row["quantity"]) == (run, quantity)), key=lambda row: row["total"]
            )
            axes: Axes = figure.add_subplot(lines, columns, index + 1)
            names = [row["input"] for row in own]
            axes.barh(names, [row["total"] for row in own], color="#56B4E9", height=0.75, label="total")
            axes.barh(names, [max(row["first_order"], 0.0) for row in own], color="#0072B2", height=0.35,
                      label="first order")  # fmt: skip
            scale, unit = (100.0, "%") if own[0]["unit"] == "1" else (1.0, own[0]["unit"])
            low, high = scale * own[0]["p05"], scale * own[0]["p95"]
            axes.set_title(f"{run.split('-')[0]}: {quantity}\n5..95 %: {low:.3g} to {high:.3g} {unit}", loc="left")
            axes.set(xlim=(0.0, 1.0), xlabel="Sobol index")
            axes.tick_params(axis="y", labelsize=7)
            if index == 0:
                axes.legend(loc="lower right")
        _mark(figure, rows)
        _save(figure, path)


def compatibility_figure(rows: Rows, path: Path) -> None:
    """Draw a_v against a_theta for the families of spectra, with the published pair and its spread."""
    look = {
        "published": ("#000000", "s"), "power law": ("#0072B2", "o"), "the study's compound": ("#009E73", "D"),
        "one bell": ("#E69F00", "^"), "any spectrum >= 0": ("#D55E00", "X"),
    }  # fmt: skip
    if not rows:
        return
    with _styled():
        figure, axes = _panel()
        seen: set[str] = set()
        for row in rows:
            color, marker = look[row["family"]]
            spread = row["a_v_sd_percent_s_per_m"]
            axes.errorbar(
                row["a_theta_percent_per_degC"], row["a_v_percent_s_per_m"], yerr=spread or None, fmt=marker,
                color=color, ms=7, lw=0.8, capsize=2, label=None if row["family"] in seen else row["family"],
            )  # fmt: skip
            seen.add(row["family"])
        axes.set(xlabel="a_theta, % per degC", ylabel="a_v, % per m/s (bar: sd over the sets)")
        axes.set_title("Rate and temperature coefficients of linear compounds", loc="left")
        axes.legend()
        figure.text(0.995,
            0.997, "WLF constants of the paper; rig geometry with an assumed big wheel", ha="right",
                    va="top", fontsize=6.0, color="#6b5200")  # fmt: skip
        _save(figure, path)


def _leave_room(figure: Figure) -> None:
    engine = figure.get_layout_engine()
    assert isinstance(engine, ConstrainedLayoutEngine)
    engine.set(rect=(0, 0, 1, 0.96))


def _mark(figure: Figure, rows: Rows) -> None:
    """Print the assumed and synthetic inputs that the rows rest on."""
    names = sorted({name for row in rows for name in (row["assumed"] or "").split("; ") if name})
    if names:
        text = "rests on: " + ", ".join(names)
        figure.text(0.995, 0.997, text, ha="right", va="top", fontsize=6.0, color="#6b5200")


def _styled() -> Any:
    return mpl.rc_context(RC)


def _panel() -> tuple[Figure, Axes]:
    figure = Figure(figsize=(5.6, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    _leave_room(figure)
    return figure, figure.add_subplot()


def _save(figure: Figure, path: Path) -> None:
    for suffix, metadata in ((".svg", {"Date": None, "Creator": None}), (".png", {"Software": None})):
        with atomic_path(path.with_suffix(suffix)) as temporary:
            figure.savefig(temporary, format=suffix[1:], dpi=150, metadata=metadata)
