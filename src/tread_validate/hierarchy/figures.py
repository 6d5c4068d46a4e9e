"""Figures of the hierarchy: error against cost, Sobol indices, rate and temperature coefficients."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..palette import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION
from ..plotting import canvas, note, panel, save, styled

# told apart by marker as well
STYLES = {
    "paper": (BLUE, "o"),
    "shape_factor_theory": (ORANGE, "v"),
    "shape_factor": (VERMILION, "^"),
    "condensed_coarse": (PURPLE, "s"),
    "condensed": (GREEN, "D"),
    "fe": (BLACK, "P"),
}
NAMES = {
    "paper": "springs of the paper",
    "shape_factor_theory": "shape factor, theory",
    "shape_factor": "shape-factor springs",
    "condensed_coarse": "condensed FE, coarse",
    "condensed": "condensed FE",
}
NEAR = 0.15  # decades between points whose labels would lie on each other
OWN = (GREY, "X")  # a model of the user's own; its name stands in the legend
Rows = Sequence[Mapping[str, Any]]
ROOM = 0.96  # of the height, under the note


def pareto_figure(rows: Rows, meshes: Rows, path: Path) -> None:
    """Draw the error of the peak normal force and the score of the longitudinal force against the time of a pass."""
    with styled():
        figure = canvas((8.6, 4.2))
        left, right = figure.subplots(1, 2)
        for row in rows:
            error = row["mean_abs_peak_normal_force_error"]
            if row["group"] == "all" or error is None or row["seconds_per_pass"] is None:
                continue
            color, marker = STYLES.get(row["level"], OWN)
            label = f"{NAMES.get(row['level'], row['level'])}, {row['group']}"
            look = {
                "color": color, "ms": 7, "ls": "none", "label": label,
                "mfc": color if row["group"] == "rig" else "white",
            }  # fmt: skip
            left.plot(row["seconds_per_pass"], 100.0 * error, marker, **look)
            if row["mean_iso18571_tangential"] is not None:
                right.plot(row["seconds_per_pass"], row["mean_iso18571_tangential"], marker, **look)
        _mesh_points(left, meshes)
        left.set(xscale="log", yscale="log", xlabel="processor time of one pass, s")
        left.margins(0.08, 0.12)
        left.set_ylabel("mean |error| of the peak normal force, %")
        left.set_title("Normal force, compared with the FE runs\n(FE meshes: with their own limit)", loc="left")
        right.set(xscale="log", ylim=(0.0, 1.02), xlabel="processor time of one pass, s")
        right.set_ylabel("mean ISO/TS 18571 score")
        right.set_title("Longitudinal force history, compared with the FE runs\n(1 is perfect)", loc="left")
        figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=5, fontsize=7,
                      columnspacing=1.0, handletextpad=0.3)  # fmt: skip
        _mark(figure, rows)
        _save(figure, path)


def _mesh_points(axes: Axes, meshes: Rows) -> None:
    """Draw the FE meshes; of points that lie on each other one is labelled."""
    color, marker = STYLES["fe"]
    labelled: list[tuple[str, float, float]] = []
    for row in meshes:
        if row["seconds_estimated"] is None:
            continue
        filled = row["case_id"].startswith("rig")
        time, error = row["seconds_estimated"], max(100.0 * abs(row["peak_normal_force_error"]), 0.02)
        axes.plot(time, error, marker, color=color, ms=8, mfc=color if filled else "white", ls="none")
        label = (f"FE {row['element_size_mm']:g} mm", math.log10(time), math.log10(error))
        if any(name == label[0] and math.hypot(x - label[1], y - label[2]) < NEAR for name, x, y in labelled):
            continue
        labelled.append(label)
        offset = (0, 7) if filled else (0, -13)
        axes.annotate(label[0], (time, error), textcoords="offset points", xytext=offset, size=7, ha="center")


def sobol_figure(rows: Rows, path: Path) -> None:
    """Draw total and first-order indices for each run and quantity, the inputs sorted by their largest total."""
    panels = list(dict.fromkeys((row["run"], row["quantity"]) for row in rows))
    if not panels:
        return
    with styled():
        columns = min(2, len(panels))
        lines = -(-len(panels) // columns)
        figure = canvas((4.6 * columns, 0.5 + 2.6 * lines))
        for index, (run, quantity) in enumerate(panels):
            own = sorted(
                (row for row in rows if (row["run"], row["quantity"]) == (run, quantity)), key=lambda row: row["total"]
            )
            axes: Axes = figure.add_subplot(lines, columns, index + 1)
            names = [row["input"] for row in own]
            axes.barh(names, [row["total"] for row in own], color=SKY, height=0.75, label="total")
            axes.barh(names, [max(row["first_order"], 0.0) for row in own], color=BLUE, height=0.35,
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
        "published": (BLACK, "s"), "power law": (BLUE, "o"), "the study's compound": (GREEN, "D"),
        "one bell": (ORANGE, "^"), "any spectrum >= 0": (VERMILION, "X"),
    }  # fmt: skip
    if not rows:
        return
    with styled():
        figure, axes = panel((5.6, 4.2))
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
        note(figure, "WLF constants of the paper; rig geometry with an assumed big wheel", ROOM)
        _save(figure, path)


def compounds_figure(rows: Rows, path: Path) -> None:
    """Draw mean and range of three errors of the paper's springs for every compound, the least lossy first."""
    if not rows:
        return
    panels = (
        ("peak_normal_force", "scalar", "error of the peak normal force, %"),
        ("tangential_to_normal_ratio", "scalar", "error of the peak |T|/N, %"),
        ("tangential_force", "iso18571_r", "ISO/TS 18571 score of T, less 1, %"),
    )
    order = {row["compound"]: row["loss_factor"] for row in reversed(rows)}
    names = sorted(order, key=lambda name: order[name])
    with styled():
        figure = canvas((9.6, 3.9))
        for index, (quantity, metric, label) in enumerate(panels):
            axes: Axes = figure.add_subplot(1, 3, index + 1)
            for group, color, marker, side in (("rig", BLUE, "o", -0.12), ("belt", VERMILION, "D", 0.12)):
                known = [row for row in rows if row["group"] == group and row["mean_error"] is not None]
                own = [row for row in known if (row["quantity"], row["metric"]) == (quantity, metric)]
                mean, least, most = ([100.0 * row[key] for row in own] for key in
                                     ("mean_error", "least_error", "largest_error"))  # fmt: skip
                bars = [np.subtract(mean, least), np.subtract(most, mean)]
                axes.errorbar([names.index(row["compound"]) + side for row in own], mean, yerr=bars, fmt=marker,
                              color=color, ms=6, lw=0.9, capsize=2, label=group)  # fmt: skip
            axes.axhline(0.0, color=GREY, lw=0.7)
            ticks = [f"{name}\ntan d {order[name]:.2g}".replace("_", " ") for name in names]
            axes.set_xticks(range(len(names)), ticks, rotation=60, ha="right", fontsize=7)
            axes.set_title(label, loc="left", fontsize=8)
            if index == 0:
                axes.legend(fontsize=7)
        _mark(figure, rows)
        _save(figure, path)


def _mark(figure: Figure, rows: Rows) -> None:
    """Print the assumed and synthetic inputs that the rows depend on."""
    names = sorted({name for row in rows for name in (row["assumed"] or "").split("; ") if name})
    note(figure, "depends on: " + ", ".join(names) if names else "", ROOM)


def _save(figure: Figure, path: Path) -> None:
    for suffix in (".svg", ".png"):
        save(figure, path.with_suffix(suffix))
