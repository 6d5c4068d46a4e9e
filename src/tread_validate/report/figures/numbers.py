"""The numbers behind a drawn figure, read back from what was painted, so that drawing and numbers cannot disagree."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon

HEADER = ("panel", "series", "x", "y")
DIGITS = 5  # a drawing shows no more; the histories and tables themselves have all

Numbers = tuple[Sequence[str], Iterable[Sequence[object]]]
"""Header and rows of a figure whose numbers cannot be read back (an image, a mesh)."""


def numbers_text(panels: Iterable[Axes], own: Numbers | None = None) -> str:
    """Return the figure's numbers as CSV: a row a point, by panel (``y label against x label``) and series.

    A series without an entry in the legend is named by its label with an underscore before it. Lines that only guide
    the eye (axes, bands over the whole height) are left out, for they are not in the coordinates of the data.
    """
    header, rows = own or (HEADER, [row for axes in panels for row in _rows(axes)])
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return text.getvalue()


def _rows(axes: Axes) -> list[tuple[object, ...]]:
    panel = f"{axes.get_ylabel() or 'row'} against {axes.get_xlabel()}".strip()
    names = {
        position: tick.get_text() for position, tick in zip(axes.get_yticks(), axes.get_yticklabels(), strict=True)
    }
    named = not axes.get_ylabel()  # rows of a dot plot have names, not values
    found: list[tuple[object, ...]] = []
    for index, artist in enumerate(axes.get_children()):
        points = _points(artist, axes)
        label = str(getattr(artist, "get_label", str)()).lstrip("_")
        series = f"series {index + 1}" if not label or label.startswith("child") else label
        found += [(panel, series, x, names.get(y, y) if named else y) for x, y in points]
    return found


def _points(artist: object, axes: Axes) -> list[tuple[float, float]]:
    """Return the points of an artist that is drawn in the coordinates of the data; none of any other."""
    if isinstance(artist, Line2D) and artist.get_transform() == axes.transData:
        points = np.column_stack([np.atleast_1d(artist.get_xdata()), np.atleast_1d(artist.get_ydata())])
    elif isinstance(artist, PathCollection):
        points = np.asarray(artist.get_offsets())
    elif isinstance(artist, PolyCollection) and artist.get_paths():
        points = np.asarray(artist.get_paths()[0].vertices)
    elif isinstance(artist, Circle):
        around = np.array([(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)])
        points = np.asarray(artist.get_center()) + artist.get_radius() * around
    elif isinstance(artist, Polygon) and artist.get_data_transform() == axes.transData:
        points = np.asarray(artist.get_xy())
    else:
        return []
    known = np.isfinite(points.astype(float)).all(axis=1) if points.size else []
    return [(float(x), float(y)) for x, y in points[known]]


def _cell(value: object) -> object:
    return f"{value:.{DIGITS}g}" if isinstance(value, float) else value
