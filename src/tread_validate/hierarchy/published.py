"""Which published figure of the belt run each level meets, and what would have to change to meet all at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from ..compare import Scalars, scalars
from ..compare.runs import Runs
from ..errors import EngineError, InputError
from ..spring import free_rolling_creep, run
from ..study import Case
from ..units import IN_MM, MM
from .tables import CombinationRow, PublishedFigure

Array = NDArray[np.float64]

NORMAL, TANGENTIAL, CREEP = 200.0, 80.0, 0.003
"""N, N and 1: N ~ 200 N, |T|max ~ 80 N, creep 0.3 % without net longitudinal impulse (section 5 of the paper)."""
VARIED = ("edge_radius_mm", "patch_length_mm")
TOLERANCE = 0.10
"""The paper prints one or two figures: a value within this share of it is counted as met."""


def published_rows(cases: Sequence[Case], references: Runs, engine: str, levels: Sequence[str]) -> list[dict[str, Any]]:
    """Return the published figures of the belt run beside those of each level and of the reference runs.

    Simplified profile, as the paper's spring model; the creep ratio of the force figures is the published 0.3 %. The
    rows' columns are those of `PublishedFigure`.
    """
    belt = [case for case in cases if case.path.varies(*VARIED)]
    at_published = next((case for case in belt if case.creep_ratio == CREEP), None)
    if at_published is None:
        return []
    rows = []
    for level in levels:
        creep: float | None
        try:
            creep = free_rolling_creep(at_published, level)
            note = ""
        except InputError as error:
            creep, note = None, str(error)
        rows += _rows(level, at_published, scalars(run(at_published, level)), creep, note)
    for case in belt:
        found = references.get((f"fe:{engine}", case.case_id))
        if found is None or found.scalars is None or case is not at_published:
            continue
        rows += _rows(f"fe:{engine}", case, found.scalars, None, "no search: net impulse at 0.3 % instead")
    return rows


def _rows(level: str, case: Case, found: Scalars, creep: float | None, note: str) -> list[dict[str, Any]]:
    tangential = max(found.peak_positive_tangential_force, -found.peak_negative_tangential_force)
    figures: list[tuple[str, float | None, float | None, str]] = [
        ("peak normal force", NORMAL, found.peak_normal_force, "N"),
        ("peak longitudinal force", TANGENTIAL, tangential, "N"),
        ("peak longitudinal over peak normal force", 1.0 / 3.0, found.tangential_to_normal_ratio, "1"),
        ("free-rolling creep ratio", CREEP, creep, "1"),
        ("longitudinal force changes sign again at the exit", 1.0, found.late_sign_change, "1"),
    ]
    if creep is None:
        share = found.net_tangential_impulse / (found.normal_impulse * found.tangential_to_normal_ratio)
        figures.append(("net longitudinal impulse at 0.3 % over ratio times normal impulse", 0.0, share, "1"))
    out = []
    for figure, published, computed, unit in figures:
        error = met = None
        if computed is not None and published is not None:
            error = computed - published if published == 0.0 else computed / published - 1.0
            met = abs(error) <= TOLERANCE
        entries = (level, case.case_id, figure, published, computed, unit, error, met, note, "; ".join(case.assumed()))
        out.append(dict(zip(PublishedFigure.header(), entries, strict=True)))
    return out


@dataclass(frozen=True)
class Combination:
    """Edge radius and patch length (m), and a factor on all moduli."""

    edge_radius: float
    patch_length: float
    modulus_factor: float

    def of(self, case: Case) -> Case:
        """Return the case so changed."""
        path = case.path.model_copy(
            update={"edge_radius_mm": IN_MM * self.edge_radius, "patch_length_mm": IN_MM * self.patch_length}
        )
        return replace(case, path=path, compound=scaled(case, self.modulus_factor))


def scaled(case: Case, factor: float) -> Any:
    """Return the case's compound with all moduli multiplied."""
    compound = case.compound
    if compound.kind == "fractional_zener":
        return compound.model_copy(
            update={
                "long_term_modulus_MPa": factor * compound.long_term_modulus_MPa,
                "modulus_rise_MPa": factor * compound.modulus_rise_MPa,
            }
        )
    raise InputError(f"case {case.case_id}: compound", compound.kind, "a fractional_zener, whose moduli can be scaled")


def combination_rows(case: Case, levels: Sequence[str]) -> list[dict[str, Any]]:
    """Search edge radius, patch length and modulus that give N = 200 N, |T|max = 80 N and creep 0.3 % at once.

    `case` is a belt case on the simplified profile. The rows' columns are those of `CombinationRow`.
    """
    published = Combination(MM * case.path.value(VARIED[0]), MM * case.path.value(VARIED[1]), 1.0)
    rows = []
    for level in levels:
        at_start = _outcome(case, level, published)
        rows.append(_row(case, level, "as published", published, at_start, ""))
        found, note = _search(case, level, published, at_start)
        rows.append(_row(case, level, "all three met", found, _outcome(case, level, found), note))
    return rows


@dataclass(frozen=True)
class PublishedFeatures:
    """What a combination gives."""

    normal: float
    tangential: float
    creep: float
    late: float


def _outcome(case: Case, level: str, combination: Combination) -> PublishedFeatures:
    changed = combination.of(case)
    creep = free_rolling_creep(changed, level)
    found = scalars(run(changed.with_creep(creep), level))
    tangential = max(found.peak_positive_tangential_force, -found.peak_negative_tangential_force)
    return PublishedFeatures(found.peak_normal_force, tangential, creep, found.late_sign_change)


def _search(case: Case, level: str, start: Combination, at_start: PublishedFeatures) -> tuple[Combination, str]:
    """Solve in logarithms; forces scale with the modulus, so its factor starts where N is right."""

    def residual(x: Array) -> Array:
        try:
            found = _outcome(case, level, Combination(*np.exp(x)))
        except (InputError, EngineError):
            return np.full(3, 3.0)
        return np.log([found.normal / NORMAL, found.tangential / TANGENTIAL, max(found.creep, 1e-6) / CREEP])

    x0 = np.log([start.edge_radius, start.patch_length, NORMAL / at_start.normal])
    bounds = (np.log([0.03, 0.04, 0.1]), np.log([3.0, 1.0, 10.0]))
    solved = least_squares(residual, x0, bounds=bounds, diff_step=[0.02, 0.02, 0.02], xtol=1e-4, ftol=1e-6, max_nfev=25)
    miss = float(np.max(np.abs(solved.fun)))
    note = f"largest miss {100 * miss:.1f} %" + ("" if miss < 0.02 else ": no solution inside the bounds")
    return Combination(*(float(v) for v in np.exp(solved.x))), note


def _row(
    case: Case, level: str, what: str, combination: Combination, found: PublishedFeatures, note: str
) -> dict[str, Any]:
    pairs = ((found.normal, NORMAL), (found.tangential, TANGENTIAL), (found.creep, CREEP))
    meets_all = all(abs(value / published - 1.0) <= TOLERANCE for value, published in pairs) and found.late == 1.0
    entries = (
        level, what, IN_MM * combination.edge_radius, IN_MM * combination.patch_length, combination.modulus_factor,
        found.normal, found.tangential, 100.0 * found.creep, found.late, meets_all,
        note, "; ".join(case.assumed()),
    )  # fmt: skip
    return dict(zip(CombinationRow.header(), entries, strict=True))
