"""Sections that exist only where an optional stage has run."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import read_text
from ..study import load_yaml
from . import wording
from .content import Cell, Column, Figure, Figures, Item, Paragraph, Row, Section, Table
from .inputs import plain_table
from .marks import Marks
from .tables import number, read_table

FIGURES = (
    ("pareto", "Cost and error of each rung", "Error of the peak normal force against the time of one pass."),
    ("sobol", "Which inputs the peak forces hang on", "First-order and total Sobol indices over the inputs' ranges."),
    ("compatibility", "Speed and temperature together", "Which spectra of the compound could give both coefficients."),
)
TABLES = (
    ("pareto", "Cost and error of each rung"),
    ("published", "Published figures of the belt run, rung by rung"),
    ("effects", "What each physical effect is worth"),
    ("combinations", "Which edge radius, patch length and modulus would meet all published figures"),
    ("compatibility", "Which compounds could give both published coefficients"),
    ("sobol", "Sobol indices"),
    ("stiffness", "Stiffness of the bonded block, solved and in closed form"),
    ("fe_meshes", "Cost and error of the FE meshes"),
    ("errors", "Errors of every rung and case"),
)


def ladder_section(folder: Path | None, drawn: Path, marks: Marks) -> Section | None:
    """Return the model ladder's figures and tables as it wrote them; None where it has not run."""
    if folder is None or not folder.is_dir():
        return None
    items: list[Item] = [
        Paragraph("From the simplest spring model to the finest: what each rung adds, and what it costs.")
    ]
    tables = {name: read_table(folder / f"{name}.csv", ()) for name, _ in TABLES if (folder / f"{name}.csv").is_file()}
    figures = []
    for name, title, caption in FIGURES:
        source = folder / "figures" / f"{name}.svg"
        if source.is_file():
            drawn.mkdir(parents=True, exist_ok=True)
            for path in (source, source.with_suffix(".png")):
                if path.is_file():
                    shutil.copyfile(path, drawn / f"ladder-{path.name}")
            table = tables.get(name)
            own = marks.of_column(table["assumed"]) if table is not None and "assumed" in table else ()
            figures.append(Figure(f"ladder-{name}", title, caption, drawn / f"ladder-{name}.svg", own))
    if figures:
        items.append(Figures(tuple(figures)))
    for name, title in TABLES:
        if name in tables:
            items.append(plain_table(f"ladder-{name}", title, tables[name], marks, folded=name != "pareto"))
    return Section("ladder", "The model ladder", tuple(items)) if tables else None


def mesh_table(reference: Path) -> Table | None:
    """Return the three-mesh studies of the FE runs, ``mesh/{rig,belt}.yaml`` below `reference`; None without any."""
    rows: list[Row] = []
    widest = 0
    for file in sorted((reference / "mesh").glob("*.yaml")):
        data = load_yaml(read_text(file), file)
        if not isinstance(data, dict) or not isinstance(data.get("quantities"), dict):
            raise InputError(file, "no quantities", "a mesh study, as `tread-validate mesh-error` writes it")
        sizes = [f"{size:g} mm" for size in data.get("sizes_mm", [])]
        widest = max(widest, len(sizes))
        for name, item in data["quantities"].items():
            rows.append(_mesh_row(str(name), item, data, sizes))
    if not rows:
        return None
    columns = (
        Column("Quantity", wide=True),
        *(Column(f"Mesh {index + 1}", numeric=True) for index in range(widest)),
        Column("Extrapolated", "to size 0", numeric=True),
        Column("Order", numeric=True),
        Column("Error that remains", numeric=True),
    )
    caption = (
        "Richardson extrapolation from three meshes of one case (doi:10.1115/1.2960953); the error that remains at the "
        "size in use is carried into every verdict as the reference's uncertainty."
    )
    return Table("meshes", "Mesh error of the FE runs", columns, tuple(rows), caption, folded=True)


def _mesh_row(name: str, item: dict[str, Any], data: dict[str, Any], sizes: list[str]) -> Row:
    values = [number(value) for value in item.get("values", [])]
    limit, order = number(item.get("limit")), number(item.get("order"))
    error = number(data.get("mesh_error", {}).get(name))
    cells = [Cell(wording.quantity(name))]
    for value, size in zip(values, sizes, strict=True):
        cells.append(Cell(wording.plain(value, 4), sort=value, note=size))
    cells += [
        Cell(wording.plain(limit, 4), sort=limit),
        Cell("–" if order is None else f"{order:.2f}", sort=order, note="" if order is not None else "meshes scatter"),
        Cell(wording.percent(error, 2), sort=error),
    ]
    group = f"{data.get('case_id', '')}, {number(data.get('element_size_mm')) or 0:g} mm in use"
    return Row(tuple(cells), group=group)
