"""Sections that exist only where an optional stage has run."""

from __future__ import annotations

from pathlib import Path

from .content import Paragraph, Section
from .inputs import plain_table
from .marks import Marks
from .tables import read_table

LADDER = (
    ("published", "Which published values each rung of the ladder meets"),
    ("effects", "What each physical effect is worth"),
    ("pareto", "Cost and error of each model"),
    ("compatibility", "Which parameter sets would meet every published value"),
    ("sobol", "Which inputs the peak forces hang on (Sobol indices)"),
)


def ladder_section(folder: Path | None, marks: Marks) -> Section | None:
    """Return the tables of the model ladder as they are; None where there are none."""
    if folder is None or not folder.is_dir():
        return None
    tables = [
        plain_table(f"ladder-{name}", title, read_table(folder / f"{name}.csv", ()), marks, folded=True)
        for name, title in LADDER
        if (folder / f"{name}.csv").is_file()
    ]
    if not tables:
        return None
    note = Paragraph("From the simplest spring model to the finest: what each step adds, and what it costs.")
    return Section("ladder", "The model ladder", (note, *tables))
