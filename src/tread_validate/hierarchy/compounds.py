"""Does what the paper's spring model misses depend on the compound? The same passes with published ones.

The condensed model stands for the finite element runs: both take the same series, so that their difference is what the
springs leave out, whatever the compound. Poisson's ratio stays that of the case; friction laws stay as they are.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ..compare import MetricRow, compare
from ..compare.quantities import Tolerances
from ..material.worth import rates_of_loading
from ..spring import run
from ..spring.rubber import series_of
from ..study import Case
from ..study.library import library_compound, library_names
from ..units import IN_MPA
from .pareto import GROUPS

MODEL, REFERENCE = "paper", "condensed"
QUANTITIES = (
    ("peak_normal_force", "scalar"),
    ("normal_impulse", "scalar"),
    ("peak_positive_tangential_force", "scalar"),
    ("peak_negative_tangential_force", "scalar"),
    ("tangential_to_normal_ratio", "scalar"),
    ("normal_force", "iso18571_r"),
    ("tangential_force", "iso18571_r"),
)


Table = list[dict[str, Any]]


def compound_tables(cases: Sequence[Case], root: Path, judged: Tolerances) -> tuple[Table, Table]:
    """Return the errors of the paper's springs by compound, and how far they depend on it.

    `cases` have a creep ratio; `root` is the study's, with the compounds of the library below it. Columns are those
    of `CompoundError` and `CompoundDependence`.
    """
    found: dict[str, list[tuple[Case, dict[tuple[str, str], MetricRow]]]] = {}
    for case in cases:
        for name, one in _with_compounds(case, root).items():
            rows = compare(run(one, REFERENCE), run(one, MODEL), case_id=case.case_id, uncertainty=0.0,
                           tolerances=judged)  # fmt: skip
            found.setdefault(name, []).append((one, {(row.quantity, row.metric): row for row in rows}))
    groups = [(name, chosen) for name, chosen in GROUPS if name != "all" and any(map(chosen, cases))]
    table, dependence = [], []
    for group, chosen in groups:
        inside = {name: [item for item in items if chosen(item[0])] for name, items in found.items()}
        inside = {name: items for name, items in inside.items() if items}
        for key in QUANTITIES:
            own = {name: [(case, row[key]) for case, row in items if key in row] for name, items in inside.items()}
            own = {name: items for name, items in own.items() if items}
            table += [_errors(name, group, items) for name, items in own.items()]
            dependence.append(_dependence(group, key, own))
    return table, dependence


def _with_compounds(case: Case, root: Path) -> dict[str, Case]:
    """Return a case as it is, by its compound's name, and with every compound of the library."""
    made = {case.compound_name: case}
    for name in library_names(root):
        other = library_compound(name, root).model_copy(update={"poissons_ratio": case.compound.poissons_ratio})
        made.setdefault(name, replace(case, compound=other, compound_name=name))
    return made


def _modulus(case: Case) -> complex:
    """Return E* in Pa at the middle, in logarithm, of the frequencies that a pass needs."""
    w = float(np.sqrt(np.prod(rates_of_loading(case))))
    series = series_of(case)
    return complex(float(series.storage_modulus(w)), float(series.loss_modulus(w)))


def _errors(name: str, group: str, items: Sequence[tuple[Case, MetricRow]]) -> dict[str, Any]:
    case, first = items[0]
    errors = [float(row.error) for _, row in items if row.error is not None]
    modulus = np.mean([_modulus(one) for one, _ in items])
    return {
        "compound": name,
        "origin": case.compound.origin,
        "group": group,
        "quantity": first.quantity,
        "metric": first.metric,
        "cases": len(items),
        "storage_modulus_MPa": float(IN_MPA * modulus.real),
        "loss_factor": float(modulus.imag / modulus.real),
        "unit": first.unit if first.error_type == "absolute" else "1",
        "error_type": first.error_type,
        "mean_error": float(np.mean(errors)) if errors else None,
        "least_error": min(errors, default=None),
        "largest_error": max(errors, default=None),
        "passed": sum(row.passed is True for _, row in items),
        "criterion": first.criterion,
        "assumed": "; ".join(sorted({name for one, _ in items for name in one.assumed()})),
    }


def _dependence(
    group: str, key: tuple[str, str], rows: Mapping[str, Sequence[tuple[Case, MetricRow]]]
) -> dict[str, Any]:
    """Say how far one error moves over the compounds; the first of `rows` is the study's own."""
    own = next(iter(rows))
    means = {
        name: float(np.mean([row.error for _, row in items if row.error is not None]))
        for name, items in rows.items()
        if any(row.error is not None for _, row in items)
    }
    passed = {name: {row.case_id: row.passed is True for _, row in items} for name, items in rows.items()}
    changes = {case_id for case_id in passed[own] if len({one.get(case_id) for one in passed.values()}) > 1}
    first = rows[own][0][1]
    return {
        "group": group,
        "quantity": key[0],
        "metric": key[1],
        "unit": first.unit if first.error_type == "absolute" else "1",
        "error_type": first.error_type,
        "compounds": len(rows),
        "own_mean_error": means.get(own),
        "least_mean_error": min(means.values(), default=None),
        "largest_mean_error": max(means.values(), default=None),
        "own_passed": sum(passed[own].values()),
        "cases": len(passed[own]),
        "least_passed": min(sum(one.values()) for one in passed.values()),
        "largest_passed": max(sum(one.values()) for one in passed.values()),
        "cases_that_change": len(changes),
        "depends": bool(changes),
    }
