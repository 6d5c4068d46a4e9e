"""Force histories before and after, of the runs whose errors moved most since the baseline."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from matplotlib.axes import Axes

from ...compare.baseline.histories import Histories
from ...compare.baseline.movement import Movement
from ...compare.thinned import Packed, thin, unpack
from ...history import History
from ...palette import Look
from ...units import IN_MS
from .. import wording
from ..cases import CaseView
from ..content import Figure
from ..histories import SAMPLES
from ..marks import Marks
from .style import draw_pair

MOST = 3  # figures
FORCES = (("n", "normal force N, N"), ("q", "longitudinal force T, N"))
BEFORE = "#9aa3ab"


def worst(found: Sequence[Movement], accepted: Histories) -> list[Movement]:
    """Return the runs to draw: of the movements, worst first, those with a history of before, each run once."""
    chosen: dict[tuple[str, str], Movement] = {}
    for item in found:
        run = (item.predicted_source, item.case_id)
        if run in accepted and run not in chosen:
            chosen[run] = item
    return list(chosen.values())[:MOST]


def before_after(
    folder: Path,
    item: Movement,
    accepted: Histories,
    now: Mapping[str, History],
    view: CaseView,
    looks: Mapping[str, Look],
    marks: Marks,
) -> Figure:
    """Draw the reference and one model, as accepted and as they are, normal and longitudinal force side by side."""
    sources = (item.reference_source, item.predicted_source)
    key = f"moved-{item.predicted_source}-{item.case_id}".replace(":", "-")

    def paint(*grid: Axes) -> None:
        for axes, (series, label) in zip(grid, FORCES, strict=True):
            for source in sources:
                before = accepted.get((source, item.case_id))
                if before is not None:
                    _before(axes, before, series, wording.source(source), source == sources[0])
                if source in now:
                    _now(axes, now[source], series, wording.source(source), looks[source])
            axes.axhline(0.0, color="#57606a", lw=0.7)
            axes.set(xlabel="time from first contact, ms", ylabel=label)

    title = f"Before and after: {wording.source(item.predicted_source)}"
    drawn = draw_pair(folder, key, title, _caption(item, view), paint, marks.of(view.assumed))
    assert drawn.figure is not None
    return replace(drawn.figure, case=item.case_id)


def _before(axes: Axes, packed: Packed, series: str, name: str, reference: bool) -> None:
    values = unpack(packed, series)
    if values.size:
        width, style = (3.6, "-") if reference else (2.2, (0, (4, 1.5)))
        axes.plot(unpack(packed, "t"), values, color=BEFORE, lw=width, ls=style, alpha=0.7, label=f"{name}, accepted")


def _now(axes: Axes, history: History, series: str, name: str, look: Look) -> None:
    keep = thin(history, SAMPLES)
    values = history.normal_force if series == "n" else history.tangential_force
    if series == "n" or history.gives_tangential:
        axes.plot(IN_MS * history.time[keep], values[keep], color=look.color, ls=look.line, label=f"{name}, now")


def _caption(item: Movement, view: CaseView) -> str:
    kind = item.error_type
    before, now = (wording.size(value, kind, item.unit) for value in (item.before, item.now))
    quantity = wording.quantity(item.quantity, item.metric)
    return f"{view.label}. {quantity}: |E| was {before} and is {now}."
