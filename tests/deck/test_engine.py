"""The embedded engine runs the decks: both friction variants, rig and belt, from lead-in to release."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate import deck
from tread_validate.fe import run_deck
from tread_validate.study import Case, Coulomb, DeckSettings


@pytest.mark.parametrize("kind", ["rig_case", "belt_case"])
def test_vfric_with_a_constant_coefficient_gives_the_history_of_built_in_friction(
    kind: str, request: pytest.FixtureRequest, coarse: Callable[[Case], Case], tmp_path: Path
) -> None:
    """mu_s = mu_k = 0.4 through the compiled routine and through *FRICTION: same arithmetic, 1e-9 of the peak.

    At 0.4 a good part of the face slides, so that the slip branch counts.
    """
    law = Coulomb(origin="assumed", source="test", kind="coulomb", static_coefficient=0.4, kinetic_coefficient=0.4)
    case = coarse(replace(request.getfixturevalue(kind), friction=law))
    deck.write(case, tmp_path)
    user = run_deck(tmp_path / f"{case.case_id}.inp", tmp_path / "vfric.f").history
    built_in = run_deck(tmp_path / f"{case.case_id}-constant-friction.inp", None).history
    peak = user.normal_force.max()
    assert user.slipping_fraction.max() > 0.2
    np.testing.assert_array_equal(user.time, built_in.time)
    np.testing.assert_allclose(user.normal_force, built_in.normal_force, atol=1e-9 * peak)
    np.testing.assert_allclose(user.tangential_force, built_in.tangential_force, atol=1e-9 * peak)


@pytest.mark.parametrize(
    ("kind", "mounting"),
    [("rig_case", "conforming"), ("rig_case", "flat"), ("belt_case", "flat"), ("trace_case", "flat")],
)
def test_pass_begins_at_the_first_contact_and_ends_clear_of_the_road(
    kind: str, mounting: str, request: pytest.FixtureRequest, tmp_path: Path
) -> None:
    """Next to no force at t = 0, none at the end, and the peak in between; T > 0 first, T < 0 later (free rolling).

    At t = 0 a bent block may already touch by the micrometres that its leading edge bulges: 3 % of the peak. A road
    that faces the wrong way, a mount on another path or a step that starts elsewhere would all show here.
    """
    case = request.getfixturevalue(kind)
    block = case.block.model_copy(update={"mounting": mounting})
    case = replace(case, block=block, deck=DeckSettings(element_size_mm=2.5, layers=3))
    deck.write(case, tmp_path)
    history = run_deck(tmp_path / f"{case.case_id}.inp", tmp_path / "vfric.f").history
    peak = history.normal_force.max()
    assert peak > 50.0
    assert history.normal_force[0] < 0.03 * peak
    assert history.normal_force[-1] == 0.0
    assert history.tangential_force[-1] == 0.0
    assert history.tangential_force.max() > 0.05 * peak
    assert history.tangential_force.min() < -0.05 * peak
    assert np.argmax(history.tangential_force) < np.argmin(history.tangential_force)


def test_mirrored_parallelogram_gives_the_same_forces(
    cases: tuple[Case, ...], coarse: Callable[[Case], Case], tmp_path: Path
) -> None:
    """Skew of +30 and -30 deg are mirror images across z = 0: equal but for rounding, 1e-6 of the peak."""
    case = coarse(next(one for one in cases if one.case_id == "rig-parallelogram-22c-0p2mm-300rpm"))
    histories = []
    for skew in (30.0, -30.0):
        one = replace(case, block=case.block.model_copy(update={"skew_deg": skew}))
        deck.write(one, tmp_path / str(skew))
        folder = tmp_path / str(skew)
        histories.append(run_deck(folder / f"{one.case_id}.inp", folder / "vfric.f").history)
    left, right = histories
    peak = left.normal_force.max()
    np.testing.assert_allclose(left.normal_force, right.normal_force, atol=1e-6 * peak)
    np.testing.assert_allclose(left.tangential_force, right.tangential_force, atol=1e-6 * peak)


def test_flat_faced_block_on_the_ring_carries_more_than_twice_the_conforming_one(
    rig_case: Case, tmp_path: Path
) -> None:
    """Its ends stand 0.78 mm proud over an interference of 0.2 mm: about three times the force, 2.7 at 2 mm."""
    peaks = {}
    for mounting in ("conforming", "flat"):
        block = rig_case.block.model_copy(update={"mounting": mounting})
        case = replace(rig_case, block=block, deck=DeckSettings(element_size_mm=2.5, layers=3))
        deck.write(case, tmp_path / mounting)
        inp = tmp_path / mounting / f"{case.case_id}.inp"
        peaks[mounting] = run_deck(inp, tmp_path / mounting / "vfric.f").history.normal_force.max()
    assert 2.2 < peaks["flat"] / peaks["conforming"] < 3.5
