"""How a figure of the report is made: painted in the package's look, its marks printed in it, saved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from matplotlib.axes import Axes

from ...plotting import note, panel, save, styled
from ..content import Figure, Figures, Item, Mark, Paragraph
from ..marks import in_words


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
) -> Drawn:
    """Paint one panel and save it as SVG; a note of its marks is printed in the figure itself."""
    with styled():
        canvas, axes = panel(size)
        paint(axes)
        if marks:
            note(canvas, in_words(marks))
        svg = folder / f"{key}.svg"
        save(canvas, svg)
    return Drawn(Figure(key, title, caption, svg, marks, wide))


def figure_items(drawn: tuple[Drawn, ...], pdf: bool = False) -> tuple[Item, ...]:
    """Group figures; those that could not be drawn leave their reason in words. `pdf`: for the PDF alone."""
    found: list[Item] = []
    shown = tuple(item.figure for item in drawn if item.figure is not None)
    if shown:
        found.append(Figures(shown, pdf_only=pdf))
    found += [Paragraph(item.reason, tone="mute", pdf_only=pdf) for item in drawn if item.figure is None]
    return tuple(found)
