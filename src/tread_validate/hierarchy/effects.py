"""What each physical effect is worth: the same pass with one thing changed, on two representative cases."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, one_line
from ..friction import coulomb_law
from ..geometry import path_of
from ..material import PronySeries, prony_series
from ..spring import pass_of
from ..spring.block_pass import prepare
from ..spring.condensed.face_pass import COARSE
from ..spring.condensed.roll import CondensedSettings, roll
from ..spring.shape_factor import ratios, stiffened
from ..spring.stiffness import gent_lindley, pressure_theory, shear_theory
from ..study import Case
from .tables import Effect, StiffnessRow

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Forces:
    """Peaks and impulse of one pass."""

    normal: float
    impulse: float
    positive: float
    negative: float


def _of(time: Array, normal: Array, tangential: Array) -> Forces:
    return Forces(
        float(normal.max()),
        float(np.trapezoid(normal, time)),
        max(float(tangential.max()), 0.0),
        min(float(tangential.min()), 0.0),
    )


def spring_forces(case: Case, variant: str) -> Forces:
    """Return the forces of a registered variant."""
    return _from_pass(pass_of(case, variant), case)


def _from_pass(block_pass: Any, case: Case) -> Forces:
    assert case.creep_ratio is not None
    rows = block_pass.forces(case.creep_ratio)
    return _of(block_pass.step * np.arange(rows.shape[0]), rows[:, 0], -rows[:, 1])


def face_forces(case: Case, settings: CondensedSettings | None = None, **physics: Any) -> Forces:
    """Return the forces of the condensed face; `physics` as `roll` takes it."""
    face = roll(case, settings, **physics)
    return _of(face.time, face.normal_force, face.tangential_force)


def elastic(case: Case) -> PronySeries:
    """Return an elastic solid with the relaxation modulus of the case's compound half-way through the contact."""
    series = prony_series(case.compound, case.root).at_temperature(case.temperature, case.compound.time_shift)
    modulus = float(series.relaxation_modulus(0.5 * path_of(case).contact_duration))
    return PronySeries(modulus, np.zeros(1), np.ones(1), case.temperature)


def effect_rows(cases: Sequence[Case], only: Sequence[str] = ()) -> list[dict[str, Any]]:
    """Return the effects (or those named) on each case, creep ratios known; the rows' columns are those of `Effect`."""
    rows: list[dict[str, Any]] = []
    for case in cases:
        for effect, before, after, change in _effects(case):
            if only and effect not in only:
                continue
            try:
                first, second = change()
            except InputError as error:  # an effect that such a block does not have: said in its row
                told = {
                    "case_id": case.case_id,
                    "effect": effect,
                    "before": before,
                    "after": f"{after}: {one_line(str(error))}",
                }
                rows.append({**dict.fromkeys(Effect.header()), **told, "assumed": "; ".join(case.assumed())})
                continue
            entries = (
                case.case_id, effect, before, after, 100.0 * (second.normal / first.normal - 1.0),
                100.0 * (second.impulse / first.impulse - 1.0), second.positive - first.positive,
                second.negative - first.negative, second.normal, "; ".join(case.assumed()),
            )  # fmt: skip
            rows.append(dict(zip(Effect.header(), entries, strict=True)))
    return rows


Change = Callable[[], tuple[Forces, Forces]]


def _effects(case: Case) -> list[tuple[str, str, str, Change]]:
    base = CondensedSettings()
    small = replace(base, finite_strain=False)
    coarse = COARSE
    raw = replace(base, mesh_correction=False)

    @cache
    def cached() -> Forces:
        return face_forces(case, base)

    @cache
    def small_strain() -> Forces:
        return face_forces(case, small)

    found: list[tuple[str, str, str, Change]] = [
        ("shape factor", "paper", "shape_factor (static solve)",
         lambda: (spring_forces(case, "paper"), spring_forces(case, "shape_factor"))),
        ("shape factor by theory", "shape_factor (static solve)", "shape_factor (pressure method)",
         lambda: (spring_forces(case, "shape_factor"), spring_forces(case, "shape_factor_theory"))),
        ("shape factor by Gent and Lindley", "shape_factor (static solve)", "shape_factor (E/K in series)",
         lambda: (spring_forces(case, "shape_factor"), _gent_lindley(case))),
        ("neighbour coupling", "shape_factor (static solve)", "condensed, small strain",
         lambda: (spring_forces(case, "shape_factor"), small_strain())),
        ("strain measure", "condensed, small strain", "condensed, logarithmic strain",
         lambda: (small_strain(), cached())),
        ("viscoelasticity", "condensed", "elastic with E(t) at half the contact time",
         lambda: (cached(), face_forces(case, base, series=elastic(case)))),
        ("friction law", "condensed, the study's law", "constant coefficient 0.9",
         lambda: (cached(), face_forces(case, base, friction=coulomb_law(0.9, 0.9)))),
        ("friction", "condensed, the study's law", "no friction",
         lambda: (cached(), face_forces(case, base, friction=coulomb_law(1e-6, 1e-6)))),
        ("inertia of the slipping mass", "paper", "paper without mass",
         lambda: (spring_forces(case, "paper"), spring_forces(case, "light"))),
        ("mounting", f"condensed, {case.block.mounting}", f"condensed, {_other(case)}",
         lambda: (cached(), face_forces(_mounted(case), base))),
        ("mesh of the face", "condensed, 8 elements a height", "condensed, 4 elements a height",
         lambda: (cached(), face_forces(case, coarse))),
        ("mesh correction", "condensed, corrected", "condensed, as meshed", lambda: (cached(), face_forces(case, raw))),
        ("poisson's ratio", "condensed, 0.47", "condensed, 0.49",
         lambda: (cached(), face_forces(_with_poisson(case, 0.49), base))),
    ]  # fmt: skip
    if case.path.varies("big_wheel_diameter_mm"):
        found.append(
            ("big wheel's diameter", "condensed, 0.6 m", "condensed, 1.6 m",
             lambda: (cached(), face_forces(_big_wheel(case, 1600.0), base)))
        )  # fmt: skip
        found.append(
            ("big wheel's diameter", "paper, 0.6 m", "paper, 1.6 m",
             lambda: (spring_forces(case, "paper"), spring_forces(_big_wheel(case, 1600.0), "paper")))
        )  # fmt: skip
    return found


def _gent_lindley(case: Case) -> Forces:
    found = ratios(case)
    normal = gent_lindley(case.block, case.compound.poissons_ratio)
    return _from_pass(stiffened(prepare(case), normal, found.shear), case)


def _other(case: Case) -> str:
    return "flat" if case.block.mounting == "conforming" else "conforming"


def _mounted(case: Case) -> Case:
    return replace(case, block=case.block.model_copy(update={"mounting": _other(case)}))


def _with_poisson(case: Case, ratio: float) -> Case:
    return replace(case, compound=case.compound.model_copy(update={"poissons_ratio": ratio}))


def _big_wheel(case: Case, diameter: float) -> Case:
    return replace(case, path=case.path.model_copy(update={"big_wheel_diameter_mm": diameter}))


def theory_rows(case: Case) -> list[dict[str, Any]]:
    """Return the static stiffness ratios of the case's block from the solve and from theory."""
    found = ratios(case)
    block, nu = case.block, case.compound.poissons_ratio
    rows = [
        ("normal, face stuck", found.normal, pressure_theory(block, nu), gent_lindley(block, nu)),
        ("normal, face sliding", found.normal_sliding, pressure_theory(block, nu, sliding=True),
         gent_lindley(block, nu, sliding=True)),
        ("rocking, face stuck", found.rocking, pressure_theory(block, nu, rocking=True), None),
    ]  # fmt: skip
    rows.append(("shear", found.shear, shear_theory(block, nu), None))
    return [
        dict(zip(StiffnessRow.header(), (case.case_id, *row, "; ".join(case.assumed())), strict=True)) for row in rows
    ]
