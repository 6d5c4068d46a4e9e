"""The section that leads from raw laboratory files to what the models take; absent where none is used."""

from __future__ import annotations

from ..material.compound import compound_route
from ..material.worth import worths
from ..study import LoadedStudy
from .content import Cell, Column, Item, Paragraph, Row, Table
from .figures import Drawings, figure_items
from .figures import route as drawings


def worth_items(study: LoadedStudy, draw: Drawings) -> tuple[Item, ...]:
    """Return for each compound what its series is worth for the runs of the study."""
    found = []
    for worth in worths(study.cases()):
        lines = [line.removeprefix("warning: ").removeprefix(f"compound {worth.name}: ") for line in worth.lines()]
        doubtful = any(line.startswith("warning") for line in worth.lines())
        text = f"Compound {worth.name.replace('_', ' ')}: " + "; ".join(lines) + "."
        found.append(Paragraph(text, "warn" if doubtful else "", draw.input_marks(f"compound {worth.name}")))
    return tuple(found)


def route_items(study: LoadedStudy, draw: Drawings) -> tuple[Item, ...]:
    """Return figures and quality of every compound made from sweeps and every belt path made from ridge heights."""
    found: list[Item] = []
    for name, compound in study.compounds().items():
        route = compound_route(compound, study.root)
        if route is None:
            continue
        marks = draw.input_marks(f"compound {name}")
        steps = (drawings.sweeps, drawings.master, drawings.residuals)
        found += figure_items(tuple(step(draw.folder, name, route, marks) for step in steps))
        rows = tuple(
            Row((Cell(key.replace("_", " ")), Cell(str(value))), marks) for key, value in route.quality().items()
        )
        columns = (Column("Figure of merit"), Column("Value"))
        found.append(
            Table(f"quality-{name}", f"Quality of the Prony fit, {name}", columns, rows, with_marks=True, folded=True)
        )
    for name, path in study.model.paths.items():
        traces = path.raw_ridges(study.root)
        if not traces:
            continue
        marks = draw.input_marks(f"path {name}")
        (used,) = (ridge.name for ridge in path.ridges(study.root) if ridge.used)
        drawn = (
            drawings.ridges(draw.folder, name, traces, marks),
            drawings.ridge_curvature(draw.folder, name, next(trace for trace in traces if trace.name == used), marks),
        )
        found += figure_items(drawn)
    return tuple(found)
