"""Force histories (the paper's Figs. 5, 14, 16) and peak forces against speed (Fig. 6)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from matplotlib.axes import Axes

from ...compare.rig_peaks import RigPeak
from ...compare.thinned import thin
from ...history import History
from ...palette import BLUE, GREEN, VERMILION, Look
from ...units import IN_MS
from .. import wording
from ..cases import CaseView
from ..content import Mark
from ..histories import SAMPLES
from ..tables import Tables
from .style import Drawn, draw

NAMES = {"normal": "normal", "tangential": "longitudinal"}


def history_panel(
    folder: Path,
    key: str,
    title: str,
    caption: str,
    histories: Mapping[str, History],
    looks: Mapping[str, Look],
    force: str,
    marks: tuple[Mark, ...],
) -> Drawn:
    """Draw the normal or tangential force of one case, every source over each other."""

    def paint(axes: Axes) -> None:
        for source in [name for name in looks if name in histories]:
            history, look = histories[source], looks[source]
            keep = thin(history, SAMPLES)
            if force != "normal" and not history.gives_tangential:
                continue
            values = history.normal_force if force == "normal" else history.tangential_force
            axes.plot(
                IN_MS * history.time[keep],
                values[keep],
                linestyle=look.line,
                color=look.color,
                label=wording.source(source),
            )
        axes.axhline(0.0, color="#57606a", lw=0.7)
        axes.set(xlabel="time from first contact, ms", ylabel=f"{NAMES[force]} force, N")
        axes.legend(loc="best")

    return draw(folder, key, title, caption, paint, marks)


def peaks_panel(
    folder: Path,
    tables: Tables,
    looks: Mapping[str, Look],
    chosen: tuple[CaseView, ...],
    shape: str,
    temperature: str,
    marks: tuple[Mark, ...],
    rig: Mapping[str, RigPeak],
) -> Drawn:
    """Draw peak normal force against speed for one shape and temperature: one colour per interference."""
    peaks = {(row.source, row.case_id): row.peak_normal_force_N for row in tables.peaks}
    depths = list(dict.fromkeys(view.levels["interference_mm"] for view in chosen))
    colors = dict(zip(depths, (GREEN, BLUE, VERMILION, *["#57606a"] * len(depths)), strict=False))

    def paint(axes: Axes) -> None:
        for source, look in looks.items():
            for depth in depths:
                points = [
                    (view.row.speed_m_s, peaks.get((source, view.case_id)))
                    for view in chosen
                    if view.levels["interference_mm"] == depth
                ]
                known = sorted((x, y) for x, y in points if y is not None)
                if known:
                    axes.plot(
                        [x for x, _ in known],
                        [y for _, y in known],
                        linestyle=look.line,
                        marker=look.marker,
                        ms=4,
                        lw=1.1,
                        color=colors[depth],
                        label=f"_{wording.source(source)}, {depth} mm",
                    )
        for view in chosen:
            measured, speed = rig.get(view.case_id), view.row.speed_m_s
            if measured is not None:
                color = colors[view.levels["interference_mm"]]
                axes.plot(
                    [speed, speed],
                    [measured.lowest, measured.highest],
                    "_-",
                    color=color,
                    lw=1.0,
                    ms=6,
                    label="_measured range",
                )
        for depth in depths:
            axes.plot([], [], color=colors[depth], label=f"{depth} mm")
        for source, look in looks.items():
            axes.plot(
                [], [], color="#57606a", linestyle=look.line, marker=look.marker, ms=4, label=wording.source(source)
            )
        axes.set(xlabel="surface speed, m/s", ylabel="peak normal force, N")
        axes.set_ylim(bottom=0)
        axes.legend(ncols=2, loc="best")

    title = f"Peak normal force against speed, {shape}, {temperature} °C"
    caption = "As the paper's Fig. 6, whose values are not published. Colour: interference; line and marker: source."
    if rig:
        caption += " Bars: least and largest measured peak."
    return draw(folder, f"peaks-{shape}-{temperature}c".replace(" ", "-"), title, caption, paint, marks)
