"""What the mesh and the step of a spring model are worth: the same pass, made finer."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..history import History
from ..spring import run
from ..study import Case
from .quantities import SCALARS, scalars
from .scores.align import align
from .scores.uncertainty import SAFETY

FINER = 2.0
COARSER = {"condensed": "condensed_coarse"}
"""Variants whose face is divided by its own rule: the coarser sibling on half the division takes the finer's place."""


def numerical_uncertainties(cases: Sequence[Case], variant: str) -> dict[tuple[str, str], Mapping[str, float]]:
    """Return relative standard uncertainties by quantity, for every (path, block) of the cases.

    The largest of three cases of each path and block counts. Springs: element and step at least halved; the distance
    from the limit is twice the difference for an order of 1, the least that is observed. Of a face of its own division,
    the difference to its coarser sibling is the distance from the limit, for the same order. As with the references'
    meshes the standard uncertainty is half of 1.25 times that distance.
    """
    groups: dict[tuple[str, str], list[Case]] = {}
    for case in cases:
        groups.setdefault((case.path_name, case.block_name), []).append(case)
    return {key: _largest([_of_case(case, variant) for case in _chosen(members)]) for key, members in groups.items()}


def _chosen(cases: Sequence[Case]) -> list[Case]:
    """Return the first, the middle and the last of some cases."""
    return [cases[index] for index in sorted({0, len(cases) // 2, len(cases) - 1})]


def _largest(found: Sequence[Mapping[str, float]]) -> dict[str, float]:
    names = dict.fromkeys(name for item in found for name in item)
    return {name: max(item.get(name, 0.0) for item in found) for name in names}


def _of_case(case: Case, variant: str) -> dict[str, float]:
    if variant in COARSER:
        fine, other, distance = run(case, variant), run(case, COARSER[variant]), 1.0
    else:
        finer = {
            "element_length_mm": case.spring.element_length_mm / FINER,
            # the model may step finer than the study asks: this fraction halves its step all the same
            "step_fraction": case.spring.step_fraction / FINER**2,
        }
        spring = case.spring.model_copy(update=finer)
        fine, other, distance = run(replace(case, spring=spring), variant), run(case, variant), 2.0
    factor = 0.5 * SAFETY * distance
    a, b = scalars(fine).as_dict(), scalars(other).as_dict()
    found = {
        quantity.name: factor * abs(b[quantity.name] - a[quantity.name]) / abs(a[quantity.name])
        for quantity in SCALARS
        if not quantity.flag and a.get(quantity.name) and quantity.name in b
    }
    return found | _of_histories(fine, other, factor)


def _of_histories(fine: History, other: History, factor: float) -> dict[str, float]:
    pair = align(fine, other)
    found = {}
    for name in ("normal_force", "tangential_force"):
        reference, predicted = pair.forces(name)
        scale = float(np.max(np.abs(reference)))
        if scale > 0.0:
            found[name] = factor * float(np.sqrt(np.mean((predicted - reference) ** 2))) / scale
    return found
