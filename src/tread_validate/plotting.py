"""One look for every figure that the package draws: fonts, axes, sizes, files. Colours are in `palette`."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from .files import atomic_path

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
SVG_DPI = 90  # of what is drawn as pixels inside a drawing
NOTE_COLOR = "#6b5200"
METADATA: dict[str, dict[str, str | None]] = {".svg": {"Date": None, "Creator": None}, ".png": {"Software": None}}
"""What would make the same figure other bytes."""


@contextmanager
def styled() -> Iterator[None]:
    """Draw with the package's settings and nobody else's."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(RC)
        yield


def canvas(size: tuple[float, float] | None = None) -> Figure:
    """Return an empty figure: of the usual size with fixed margins, of any other size (inches) laid out to fit.

    Finding margins that fit costs as much as the drawing itself.
    """
    figure = Figure(figsize=size or (WIDTH, HEIGHT), layout="constrained" if size else None)
    FigureCanvasAgg(figure)
    if size is None:
        figure.subplots_adjust(**MARGINS)
    return figure


def panel(size: tuple[float, float] | None = None) -> tuple[Figure, Axes]:
    """Return a `canvas` with one pair of axes."""
    figure = canvas(size)
    return figure, figure.add_subplot()


def note(figure: Figure, text: str, room: float = 0.965, low: bool = False) -> None:
    """Print what the figure depends on in its upper, or lower, right corner; one laid out to fit leaves it room."""
    place, side = (0.003, "bottom") if low else (0.997, "top")
    figure.text(0.995, place, text, ha="right", va=side, fontsize=6.0, color=NOTE_COLOR)
    engine = figure.get_layout_engine()
    if isinstance(engine, ConstrainedLayoutEngine):
        engine.set(rect=(0, 1.0 - room, 1, room) if low else (0, 0, 1, room))


def save(figure: Figure, path: Path | str) -> None:
    """Write a figure, atomically, as its name's ending says; the same figure gives the same bytes."""
    suffix = Path(path).suffix.lower()
    with atomic_path(path) as temporary:
        figure.savefig(
            temporary,
            dpi=SVG_DPI if suffix == ".svg" else DPI,
            format=suffix[1:] or "png",
            metadata=METADATA.get(suffix or ".png"),
        )
