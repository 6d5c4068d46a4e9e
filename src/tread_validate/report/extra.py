"""Sections that exist only where an optional stage has run."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path

from pydantic import BaseModel, ConfigDict

from ..compare.tables import TableRow as ResultRow
from ..compare.tables import read_rows
from ..files import read_text, write_text
from ..hierarchy.tables import TABLES, Level
from ..model_file import read_model
from ..reference import FeStore
from ..reference.mesh_errors import MeshQuantity, MeshStudy
from ..source_code import code_digest
from ..study import LoadedStudy, conditions_digest
from ..units import IN_MS
from . import wording
from .content import Cell, Column, Figure, Figures, Item, Paragraph, Row, Section, Table, Tone
from .inputs import plain_table
from .marks import Marks
from .svg import lighter

FIGURES = (
    ("pareto", "Cost and error of each model level", "Error of the peak normal force against the time of one pass."),
    (
        "compounds",
        "Errors with other compounds",
        "Errors of the paper's springs against the condensed model, mean "
        "and range over runs, for the study's compound and published rubbers.",
    ),
    ("sobol", "Which inputs the peak forces depend on", "First-order and total Sobol indices over the inputs' ranges."),
    ("compatibility", "Speed and temperature together", "Which spectra of the compound could give both coefficients."),
)


class HierarchyRecord(BaseModel):
    """What a model hierarchy was made from, as far as the report asks."""

    model_config = ConfigDict(frozen=True, extra="ignore")

    study: str
    study_digest: str
    code: str = ""


def hierarchy_section(folder: Path | None, study: LoadedStudy, drawn: Path, marks: Marks) -> Section | None:
    """Return the model hierarchy's figures and tables as it wrote them; None where it has not run on this study."""
    if folder is None or not folder.is_dir():
        return None
    record = read_model(folder / "record.yaml", HierarchyRecord)
    if record.study != study.model.name:
        return None
    items: list[Item] = [
        Paragraph("From the simplest spring model to the finest: what each level adds, and what it costs.")
    ]
    if record.study_digest != conditions_digest(study.cases()):
        items.append(Paragraph("Stale: made when the study had other conditions. Make the hierarchy anew."))
    if record.code != code_digest("hierarchy"):
        items.append(Paragraph("Made by other code than today's. Make the hierarchy anew: make hierarchy."))
    tables = {kind: read_rows(_file(folder, kind), kind) for kind in TABLES if _file(folder, kind).is_file()}
    figures = []
    for name, title, caption in FIGURES:
        source = folder / "figures" / f"{name}.svg"
        if source.is_file():
            svg, data = drawn / f"hierarchy-{name}.svg", drawn / f"hierarchy-{name}.csv"
            write_text(svg, lighter(read_text(source)))
            kind = next((kind for kind in tables if kind.table == name), None)
            if kind is not None:
                shutil.copyfile(_file(folder, kind), data)
            own = marks.of_column(getattr(row, "assumed", "") for row in tables[kind]) if kind is not None else ()
            figures.append(
                Figure(
                    svg.stem,
                    title,
                    caption,
                    svg,
                    own,
                    wide=name != "compatibility",
                    data=data if kind is not None else None,
                )
            )
    tall = [figure for figure in figures if figure.key == "hierarchy-sobol"]  # takes a page of the PDF to itself
    if len(figures) > len(tall):
        items.append(Figures(tuple(figure for figure in figures if figure not in tall)))
    if Level in tables:
        items.append(_pareto(read_rows(_file(folder, Level), Level), marks))
    if tall:
        items.append(Figures(tuple(tall)))
    for kind, rows in tables.items():
        items.append(plain_table(f"hierarchy-{kind.table}", kind, rows, marks, folded=True))
    return Section("hierarchy", "The model hierarchy", tuple(items)) if tables else None


def _file(folder: Path, kind: type[ResultRow]) -> Path:
    return folder / f"{kind.table}.csv"


def _pareto(levels: Sequence[Level], marks: Marks) -> Table:
    """Return what a reader asks first of each level: how long it takes, how wrong it is, if that was the target."""
    rows = []
    outcomes: dict[bool | None, tuple[str, Tone]] = {True: ("✓ met", "good"), False: ("✗ not met", "bad")}
    for level in levels:
        outcome, tone = outcomes.get(level.target_met, ("–", "mute"))
        words = "; ".join(part for part in (level.target, level.target_missed) if part)
        seconds, worst = level.seconds_per_pass, level.worst_peak_normal_force_error
        mean, within = level.mean_abs_peak_normal_force_error, level.tangential_within
        normal, tangential = level.least_iso18571_normal, level.least_iso18571_tangential
        cells = (
            Cell(level.group),
            Cell(f"{level.compared} of {level.cases}"),
            Cell(wording.digits(None if seconds is None else IN_MS * seconds), sort=seconds),
            Cell(wording.percent(mean), sort=mean),
            Cell(wording.percent(worst, sign=True), sort=worst, note=level.worst_case_id),
            Cell(wording.percent(within, 0), sort=within),
            Cell(f"{wording.digits(normal, 2)} / {wording.digits(tangential, 2)}", sort=normal),
            Cell(outcome, tone=tone, note=words),
        )
        rows.append(Row(cells, marks.of(level.assumed), group=level.level.replace("_", " ")))
    columns = (
        Column("Cases"),
        Column("Compared"),
        Column("Time of one pass", "ms", numeric=True),
        Column("Mean |error|", "peak normal force", numeric=True),
        Column("Largest error", "peak normal force", numeric=True),
        Column("Longitudinal peaks good enough", "of all, by the criterion of the results", numeric=True),
        Column("Least ISO/TS 18571", "normal / longitudinal", numeric=True),
        Column("Target", wide=True, long=True),
    )
    return Table(
        "hierarchy-levels",
        "The model levels",
        columns,
        tuple(rows),
        "Errors are those of the comparison with the FE runs.",
        with_marks=True,
    )


def mesh_table(reference: Path) -> Table | None:
    """Return the three-mesh studies of the FE runs in the reference data package; None without any."""
    rows: list[Row] = []
    widest = 0
    for study in FeStore(reference).mesh_errors.studies:
        sizes = [f"{size:g} mm" for size in study.sizes_mm]
        widest = max(widest, len(sizes))
        for name, item in study.quantities.items():
            rows.append(_mesh_row(name, item, study, sizes))
    if not rows:
        return None
    columns = (
        Column("Quantity", wide=True),
        *(Column(f"Mesh {index + 1}", numeric=True) for index in range(widest)),
        Column("Extrapolated", "to size 0", numeric=True),
        Column("Order", numeric=True),
        Column("Discretisation uncertainty", numeric=True),
    )
    caption = (
        "Richardson extrapolation from three meshes of one case (doi:10.1115/1.2960953); the discretisation "
        "uncertainty at the size in use is that of the reference runs of the same engine, block, kind of path and mesh."
    )
    return Table("meshes", "Mesh error of the FE runs", columns, tuple(rows), caption, folded=True)


def _mesh_row(name: str, item: MeshQuantity, study: MeshStudy, sizes: list[str]) -> Row:
    limit, order, error = item.limit, item.order, study.mesh_error.get(name)
    cells = [Cell(wording.quantity(name))]
    for value, size in zip(item.values, sizes, strict=True):
        cells.append(Cell(wording.plain(value, 4), sort=value, note=size))
    cells += [
        Cell(wording.plain(limit, 4), sort=limit),
        Cell(
            "–" if order is None else f"{order:.2f}",
            sort=order,
            note="" if order is not None else "no monotonic convergence",
        ),
        Cell(wording.percent(error, 2), sort=error),
    ]
    group = f"{study.case_id}, {study.element_size_mm:g} mm in use"
    return Row(tuple(cells), group=group)
