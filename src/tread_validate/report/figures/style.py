"""How a figure of the report is made: painted in the package's look, its marks printed in it, saved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure as Canvas

from ...files import read_text, write_text
from ...plotting import MARGINS, canvas, note, panel, save, styled
from ..content import Figure, Figures, Item, Mark, Paragraph
from ..marks import in_words
from ..svg import lighter
from .numbers import Numbers, numbers_text

PAIR = (9.4, 2.9)  # inches: two panels over the page's width
SIGNS_PER_INCH, HANDLE, LINE = 15.0, 8, 0.17  # of a legend: signs an inch, width of a handle in signs, inches a line


@dataclass(frozen=True)
class Drawn:
    """A figure, or in words why there is none."""

    figure: Figure | None
    reason: str = ""


def draw(
    folder: Path,
    key: str,
    title: str,
    caption: str,
    paint: Callable[[Axes], None],
    marks: tuple[Mark, ...] = (),
    size: tuple[float, float] | None = None,
    wide: bool = False,
    numbers: Numbers | None = None,
) -> Drawn:
    """Paint one panel, save it as SVG and its numbers as CSV; a note of its marks is printed in the figure itself.

    `numbers` stand for what cannot be read back from the panel.
    """
    with styled():
        canvas, axes = panel(size)
        paint(axes)
        _legend_above(canvas, axes)
        if marks:
            note(canvas, in_words(marks))
        svg, data = folder / f"{key}.svg", folder / f"{key}.csv"
        save_light(canvas, svg)
        write_text(data, numbers_text([axes], numbers))
    return Drawn(Figure(key, title, caption, svg, marks, wide, data))


def draw_pair(
    folder: Path,
    key: str,
    title: str,
    caption: str,
    paint: Callable[[Axes, Axes], None],
    marks: tuple[Mark, ...] = (),
    size: tuple[float, float] = PAIR,
) -> Drawn:
    """Paint two panels side by side with one legend above both; saved as `draw` does."""
    with styled():
        figure = canvas(size)
        grid = figure.subplots(1, 2)
        paint(*grid)
        handles, labels = grid[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper left", ncols=4)
        if marks:
            note(figure, in_words(marks), low=True)
        svg, data = folder / f"{key}.svg", folder / f"{key}.csv"
        save_light(figure, svg)
        write_text(data, numbers_text(grid))
    return Drawn(Figure(key, title, caption, svg, marks, wide=True, data=data))


def save_light(canvas: Canvas, file: Path) -> None:
    """Save a figure as SVG with no more digits than are seen."""
    save(canvas, file)
    write_text(file, lighter(read_text(file)))


def _legend_above(canvas: Canvas, axes: Axes) -> None:
    """Move a legend out of the axes, above them, so that it covers nothing that is drawn."""
    inside = axes.get_legend()
    if inside is None:
        return
    handles, labels = axes.get_legend_handles_labels()
    inside.remove()
    width, height = canvas.get_size_inches()
    columns = max(1, min(len(labels), int(SIGNS_PER_INCH * width / (max(map(len, labels)) + HANDLE))))
    lines = -(-len(labels) // columns)
    if canvas.get_layout_engine() is None:
        room = LINE * lines + 0.08
        canvas.set_size_inches(width, height + room)
        top = (MARGINS["top"] * height) / (height + room)
        canvas.subplots_adjust(bottom=MARGINS["bottom"] * height / (height + room), top=top)
        canvas.legend(
            handles, labels, loc="lower left", bbox_to_anchor=(0.01, top + 0.22 / (height + room)), ncols=columns
        )
    else:
        canvas.legend(handles, labels, loc="outside upper left", ncols=columns)


def figure_items(drawn: tuple[Drawn, ...], pdf: bool = False) -> tuple[Item, ...]:
    """Group figures; those that could not be drawn leave their reason in words. `pdf`: for the PDF alone."""
    found: list[Item] = []
    shown = tuple(item.figure for item in drawn if item.figure is not None)
    if shown:
        found.append(Figures(shown, pdf_only=pdf))
    found += [Paragraph(item.reason, tone="mute", pdf_only=pdf) for item in drawn if item.figure is None]
    return tuple(found)
