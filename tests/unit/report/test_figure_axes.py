"""Every drawn figure of a report: axes that say what they show in which unit, and legends that cover nothing."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.legend import Legend

from tread_validate.report.build import ReportPlaces, compose
from tread_validate.report.figures import style

DIMENSIONLESS = ("coefficient of friction",)
UNIT = re.compile(r", (?:%|N|ms|mm|m/s|rad/s|MPa|1/m|°C|% [a-z ]*(?:m/s|°C|[a-z]+))$")


@pytest.fixture(scope="module")
def drawn(inputs: Any, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Figure]:
    """Compose the made-up report and keep every figure as matplotlib has it when it is saved."""
    kept: dict[str, Figure] = {}
    saved = style.save

    def keep(figure: Figure, path: Path) -> None:
        figure.canvas.draw()
        kept[path.stem] = figure
        saved(figure, path)

    out = tmp_path_factory.mktemp("axes")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(style, "save", keep)
        compose(inputs.study, ReportPlaces(inputs.tables, inputs.spring, inputs.reference, inputs.decks, out))
    assert len(kept) == len(list((out / "figures").glob("*.svg"))) > 15
    return kept


def test_every_axis_has_a_title_with_its_unit(drawn: dict[str, Figure]) -> None:
    """Exact: an x and a y title that end in a unit; rows of a dot plot or of a heat map have names instead."""
    for key, figure in drawn.items():
        for axes in figure.axes:
            if not axes.axison:
                continue
            names = [axes.get_xlabel(), axes.get_ylabel()]
            if key.startswith(("coefficient", "heat")):
                assert any(label.get_text() for label in axes.get_yticklabels()), key
                names = names[:1] if key.startswith("coefficient") else []
            if axes.get_label() == "<colorbar>":
                names = names[1:]
            for name in names:
                assert name in DIMENSIONLESS or UNIT.search(name), f"{key}: {name!r}"


def test_no_legend_lies_over_a_drawn_point(drawn: dict[str, Figure]) -> None:
    """Exact: no point of a line, of a scatter or of a band, in pixels, is inside a legend's box."""
    for key, figure in drawn.items():
        legends = [item for item in figure.findobj(Legend) if isinstance(item, Legend)]
        points = np.concatenate([np.zeros((0, 2)), *(_points(axes) for axes in figure.axes)])
        for legend in legends:
            box = legend.get_window_extent()
            inside = (points > [box.x0, box.y0]) & (points < [box.x1, box.y1])
            assert not inside.all(axis=1).any(), key


def _points(axes: Any) -> np.ndarray:
    """Return what is drawn within the axes' box, in pixels."""
    parts = [line.get_transform().transform(np.column_stack(line.get_data())) for line in axes.lines]
    parts += [item.get_offset_transform().transform(item.get_offsets()) for item in axes.collections]
    parts += [axes.transData.transform(path.vertices) for item in axes.collections for path in item.get_paths()[:1]]
    found = np.concatenate([np.zeros((0, 2)), *(np.asarray(part, dtype=float).reshape(-1, 2) for part in parts)])
    box = axes.bbox
    return found[((found >= [box.x0, box.y0]) & (found <= [box.x1, box.y1])).all(axis=1)]
