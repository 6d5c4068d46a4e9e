"""Running cases: provenance, creep search, variants, details, and what is refused."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.spring import element_history, face_at, free_rolling_creep, resolve_creep, run, variants
from tread_validate.spring.block_pass import prepare
from tread_validate.study import Case, Coulomb

BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"
FREE = "belt-simplified-60c-0p2mm-16p7mps-free"
RIG = "rig-rectangle-22c-0p2mm-300rpm"


def with_friction(case: Case, static: float, kinetic: float) -> Case:
    law = Coulomb(
        kind="coulomb", origin="assumed", source="a test", static_coefficient=static, kinetic_coefficient=kinetic
    )
    return replace(case, friction=law)


def test_history_says_what_made_it(cases: dict[str, Case]) -> None:
    """Case, producer, digest, creep ratio and every assumed input stand in the provenance."""
    history = run(cases[BELT])
    assert history.provenance["case_id"] == BELT
    assert history.provenance["producer"] == "spring/paper"
    assert history.provenance["creep_ratio"] == "0.003"
    assert history.provenance["case_digest"] == cases[BELT].digest("spring")
    assert "compound surrogate (synthetic)" in history.provenance["assumed"]
    assert {"version", "commit"} <= set(history.provenance)


def test_clock_is_uniform_from_zero_and_fine(cases: dict[str, Case]) -> None:
    """t = 0 is the first contact; samples are 20 us apart or a 1500th of a slow pass; forces start and end at zero."""
    history = run(cases[BELT])
    steps = np.diff(history.time)
    assert history.time[0] == 0.0
    assert steps == pytest.approx(np.full(steps.size, steps[0]), rel=1e-9)
    assert steps[0] <= 20e-6
    slow = run(replace(cases[RIG], speed=0.05))
    assert slow.time[1] <= slow.time[-1] / 1400
    assert history.normal_force[0] == history.normal_force[-1] == 0.0


def test_free_rolling_case_runs_at_the_rounded_root(cases: dict[str, Case]) -> None:
    """The root to 1e-5 is in the provenance, and leaves a net tangential impulse below 0.2 % of the normal one."""
    root = free_rolling_creep(cases[FREE])
    history = run(cases[FREE])
    assert float(history.provenance["creep_ratio"]) == round(root, 5)
    impulse = np.trapezoid(history.tangential_force, history.time)
    assert abs(impulse) < 2e-3 * np.trapezoid(history.normal_force, history.time)


def test_root_leaves_no_impulse(cases: dict[str, Case]) -> None:
    """At the unrounded root the net impulse is below 1e-5 of the normal impulse: the search's tolerance."""
    block_pass = prepare(cases[FREE])
    impulse = block_pass.net_shear_impulse(free_rolling_creep(cases[FREE]))
    normal = np.sum(block_pass.forces(0.002)[:, 0]) * block_pass.step
    assert abs(impulse) < 1e-5 * normal


def test_resolving_leaves_given_creep_ratios_alone(cases: dict[str, Case]) -> None:
    """Only cases without a creep ratio are searched; order and number stay."""
    resolved = resolve_creep([cases[RIG], cases[FREE], cases[BELT]])
    assert [case.case_id for case in resolved] == [RIG, FREE, BELT]
    assert resolved[0].creep_ratio == 0.0
    assert resolved[2].creep_ratio == 0.003
    assert resolved[1].creep_ratio == pytest.approx(0.0022, abs=2e-4)


def test_search_without_a_root_says_so(cases: dict[str, Case]) -> None:
    """Between 1 % and 2 % creep the road drags the block all the way: one line with the bracket."""
    with pytest.raises(InputError, match=r"no creep ratio between 0\.01 and 0\.02"):
        free_rolling_creep(cases[FREE], bracket=(0.01, 0.02))


def test_unknown_variant_is_refused(cases: dict[str, Case]) -> None:
    """The message names the ones there are."""
    with pytest.raises(InputError, match="paper"):
        run(cases[BELT], "nonsense")
    assert "paper" in variants()


def test_element_longer_than_the_block_is_refused(cases: dict[str, Case]) -> None:
    """One line that names the key."""
    case = cases[BELT]
    case = replace(case, spring=case.spring.model_copy(update={"element_length_mm": 30.0}))
    with pytest.raises(InputError, match="element_length_mm"):
        run(case)


def test_lighter_mass_changes_nothing_but_the_slip(cases: dict[str, Case]) -> None:
    """Peaks come before any slip: the same to 1e-9; the lightened mass slips later at the exit."""
    heavy, light = run(cases[BELT]), run(cases[BELT], "light")
    assert light.normal_force.max() == pytest.approx(heavy.normal_force.max(), rel=1e-9)
    assert light.tangential_force.min() == pytest.approx(heavy.tangential_force.min(), rel=1e-6)
    assert not np.array_equal(light.tangential_force, heavy.tangential_force)


def test_elements_add_up_to_the_block(cases: dict[str, Case]) -> None:
    """The mean pressure over the face at one instant times the area is N, and so for T: 1e-3, fifty midpoints."""
    case = cases[BELT]
    history = run(case)
    for instant in (1.5e-3, 6e-3, 12e-3):
        face = face_at(case, instant)
        normal = np.interp(instant, history.time, history.normal_force)
        assert face.contact_pressure.mean() * 5e-4 == pytest.approx(normal, abs=1e-3 * history.normal_force.max())
        shear = np.interp(instant, history.time, history.tangential_force)
        assert face.shear_traction.mean() * 5e-4 == pytest.approx(shear, abs=1e-3 * history.normal_force.max())


@pytest.mark.parametrize("variant", ["shape_factor", "condensed"])
@pytest.mark.parametrize("case", [RIG, BELT])
def test_face_of_every_variant_adds_up_to_the_block(cases: dict[str, Case], case: str, variant: str) -> None:
    """Pressure times area at one instant is N, shear times area T: 1e-3 of the peak N."""
    history = run(cases[case], variant)
    peak = history.normal_force.max()
    instant = 0.45 * float(history.time[-1])
    face = face_at(cases[case], instant, variant=variant)
    normal = np.interp(instant, history.time, history.normal_force)
    assert face.contact_pressure @ face.area == pytest.approx(normal, abs=1e-3 * peak)
    shear = np.interp(instant, history.time, history.tangential_force)
    assert face.shear_traction @ face.area == pytest.approx(shear, abs=1e-3 * peak)


def test_element_further_back_has_the_same_history_later(cases: dict[str, Case]) -> None:
    """The element at s lives s/V later: same forces, shifted clock; exact."""
    first, later = element_history(cases[BELT]), element_history(cases[BELT], 0.01)
    assert np.array_equal(first.radial_force, later.radial_force)
    assert later.time[0] == pytest.approx(0.01 / 16.7, rel=1e-12)


def test_neutral_line_gives_back_the_height_at_touch(cases: dict[str, Case]) -> None:
    """At t = 0 delta = h and lambda = 0; round-off."""
    element = element_history(cases[RIG])
    assert element.radial_length[0] == pytest.approx(0.008, abs=1e-12)
    assert element.longitudinal_length[0] == pytest.approx(0.0, abs=1e-12)


def test_shear_starts_towards_the_leading_edge(cases: dict[str, Case]) -> None:
    """On a belt at free rolling T > 0 in the first half of the contact and T < 0 in the second, as in the paper."""
    history = run(cases[FREE])
    quarter = history.time.size // 4
    assert history.tangential_force[quarter] > 0.0 > history.tangential_force[3 * quarter]


def test_frictionless_kinetic_coefficient_keeps_the_block_moving(cases: dict[str, Case]) -> None:
    """With mu_k = 0 the mass swings freely on its spring: finite forces, |T| bounded by stick and one swing."""
    history = run(with_friction(cases[BELT], 0.05, 0.0))
    assert np.all(np.isfinite(history.tangential_force))
    assert np.abs(history.tangential_force).max() < 2.5 * 0.05 * history.normal_force.max()


def test_flat_faced_parallelogram_runs_element_by_element(cases: dict[str, Case]) -> None:
    """Columns of many heights, each with its own touch: N is zero at the ends, higher than the conforming block's."""
    case = cases["rig-parallelogram-22c-0p1mm-300rpm"]
    flat = replace(case, block=case.block.model_copy(update={"mounting": "flat"}))
    history = run(flat)
    assert history.normal_force[0] == pytest.approx(0.0, abs=1e-6)
    assert history.normal_force.max() > run(case).normal_force.max()
    assert math.isfinite(element_history(flat, 0.01).radial_force.max())
    assert face_at(flat, 5e-3).contact_pressure.max() > 0.0
