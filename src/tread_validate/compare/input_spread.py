"""How far the assumed inputs of a study spread its outputs, from the sensitivity study of the model hierarchy."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..errors import InputError
from ..study import Case, conditions_digest
from ..text_table import read_text_table
from ..yaml_text import read_mapping

TABLE, RECORD = "sobol.csv", "record.yaml"


def input_spreads(hierarchy_dir: Path, cases: Sequence[Case]) -> dict[str, dict[str, float]]:
    """Return relative standard deviations by quantity, by family of paths; empty where they are not known.

    `hierarchy_dir` holds the study's sensitivity study.

    The inputs are drawn from their ranges (Saltelli's sample), so that the standard deviation of an output is what
    all of them together make of it. They count for one rig and one belt case and are taken for all of its kind; a table
    that was made under other conditions than the study's says nothing.
    """
    table, record = hierarchy_dir / TABLE, hierarchy_dir / RECORD
    if not table.is_file() or not record.is_file():
        return {}
    if read_mapping(record).get("study_digest") != conditions_digest(cases):
        return {}
    by_id = {case.case_id: case for case in cases}
    found: dict[str, dict[str, float]] = {}
    rows = read_text_table(table)
    rows.check(("run", "quantity", "mean", "sd"))
    for where, row in rows.records():
        case = by_id.get(row["run"])
        if case is None:
            continue
        try:
            mean, sd = float(row["mean"]), float(row["sd"])
        except ValueError:
            raise InputError(where, "no mean and sd", "numbers in mean and sd") from None
        if mean != 0.0:
            found.setdefault(case.path.family, {})[row["quantity"].replace(" ", "_")] = sd / abs(mean)
    return found
