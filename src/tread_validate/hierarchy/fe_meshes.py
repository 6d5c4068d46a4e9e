"""What the FE meshes of the mesh study cost, and how far they are from their limit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..reference import FeStore
from ..units import US
from .tables import FeMesh

COST_GROWTH = 4.0
"""Elements grow with the third power of 1/size, increments with the first."""


def mesh_rows(references: Path, engine: str) -> list[dict[str, Any]]:
    """Return what the finite element runs of the mesh study cost and how far they are from their limit.

    `references` is the reference data package, with mesh studies (forces on several meshes and their extrapolation)
    and the records of the runs in use. Times are estimated: the least time per element and increment of any record
    (the one least disturbed by other work) times elements and increments of the case's run, scaled to the other sizes.
    The rows' columns are those of `FeMesh`.
    """
    store = FeStore(references)
    records = [entry.record for entry in store.entries(engine)]
    costs = [US * float(record["us_per_element_step"]) for record in records if "us_per_element_step" in record]
    by_case = {record.get("case_id"): record for record in records}
    rows = []
    for study in store.mesh_errors.studies:
        if study.applies_to.engine != engine:
            continue
        run_in_use = by_case.get(study.case_id, {})
        seconds = None
        if costs and {"elements", "increments"} <= set(run_in_use):
            seconds = min(costs) * run_in_use["elements"] * run_in_use["increments"]
        normal, impulse = study.quantities.get("peak_normal_force"), study.quantities.get("normal_impulse")
        if normal is None or impulse is None:
            continue
        for k, size in enumerate(study.sizes_mm):
            scale = (study.element_size_mm / size) ** COST_GROWTH
            entries = (
                study.case_id, size, None if seconds is None else seconds * scale,
                normal.values[k], normal.values[k] / normal.limit - 1.0,
                impulse.values[k] / impulse.limit - 1.0, "error against the limit of three meshes",
            )  # fmt: skip
            rows.append(dict(zip(FeMesh.header(), entries, strict=True)))
    return rows
