"""One look for every figure: size, fonts, axes, files."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as Canvas
from matplotlib.layout_engine import ConstrainedLayoutEngine

from ...files import atomic_path
from ..content import Figure, Figures, Item, Mark, Paragraph
from ..marks import in_words

WIDTH, HEIGHT = 4.7, 3.2  # inches: legible on a phone, two abreast on a desk
RC: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 9.0,
    "legend.fontsize": 7.5,
    "legend.frameon": False,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.8,
    "axes.edgecolor": "#57606a",
    "axes.grid": True,
    "grid.color": "#e6e9ec",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "lines.linewidth": 1.5,
    "svg.fonttype": "path",
    "svg.hashsalt": "tread_validate",
    "path.simplify": True,
    "path.simplify_threshold": 0.3,
}
MARGINS = {"left": 0.145, "right": 0.985, "bottom": 0.15, "top": 0.915}
DPI = 150


@dataclass(frozen=True)
class Drawn:
    """A figure, or in words why there is none."""

    figure: Figure | None
    reason: str = ""


@contextmanager
def styled() -> Iterator[None]:
    """Draw with the report's settings and nobody else's."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(RC)
        yield


def panel(size: tuple[float, float] | None) -> tuple[Canvas, Axes]:
    """Return a canvas with one pair of axes: of the usual size with fixed margins, of any other size laid out to fit.

    Finding margins that fit costs as much as the drawing itself.
    """
    canvas = Canvas(figsize=size or (WIDTH, HEIGHT), layout="constrained" if size else None)
    FigureCanvasAgg(canvas)
    if size is None:
        canvas.subplots_adjust(**MARGINS)
    return canvas, canvas.add_subplot()


def draw(
    folder: Path,
    key: str,
    title: str,
    caption: str,
    paint: Callable[[Axes], None],
    marks: tuple[Mark, ...] = (),
    size: tuple[float, float] | None = None,
    wide: bool = False,
) -> Drawn:
    """Paint one panel and save it as SVG; a note of its marks is printed in the figure itself."""
    with styled():
        canvas, axes = panel(size)
        paint(axes)
        if marks:
            canvas.text(0.995, 0.995, in_words(marks), ha="right", va="top", fontsize=6.0, color="#6b5200")
            engine = canvas.get_layout_engine()
            if isinstance(engine, ConstrainedLayoutEngine):
                engine.set(rect=(0, 0, 1, 0.965))
        svg = folder / f"{key}.svg"
        with atomic_path(svg) as temporary:
            canvas.savefig(temporary, format="svg", dpi=DPI, metadata={"Date": None, "Creator": None})
    return Drawn(Figure(key, title, caption, svg, marks, wide))


def figure_items(drawn: tuple[Drawn, ...], pdf: bool = False) -> tuple[Item, ...]:
    """Group figures; those that could not be drawn leave their reason in words. `pdf`: for the PDF alone."""
    found: list[Item] = []
    shown = tuple(item.figure for item in drawn if item.figure is not None)
    if shown:
        found.append(Figures(shown, pdf_only=pdf))
    found += [Paragraph(item.reason, tone="mute", pdf_only=pdf) for item in drawn if item.figure is None]
    return tuple(found)
