"""The study's grids and the cases made from them."""

from __future__ import annotations

import re
from collections import Counter

import pytest

from tread_validate.study import load_study


@pytest.fixture(scope="module")
def cases(paper_study):
    return load_study(paper_study).cases()


def test_paper_study_has_48_rig_runs_and_4_belt_runs(cases):
    """2 shapes x 2 temperatures x 3 interferences x 4 speeds, and 2 profiles x 2 creep ratios."""
    assert Counter(case.run for case in cases) == {"rig": 48, "belt": 4}
    assert len({case.case_id for case in cases}) == 52


def test_surface_speed_is_wheel_speed_times_radius(cases):
    """150 rpm on a 0.2 m wheel is 1.5707963 m/s (exact: 5 pi * 0.1)."""
    slow = next(case for case in cases if case.speed_rpm == pytest.approx(150.0))
    assert slow.speed == pytest.approx(1.5707963267948966, rel=1e-14)


def test_free_rolling_case_has_no_creep_until_it_is_resolved(cases):
    free = [case for case in cases if case.free_rolling]
    assert [case.creep_ratio for case in free] == [None, None]
    assert free[0].with_creep(0.0025).creep_ratio == 0.0025


def test_case_ids_are_safe_file_and_job_names(cases):
    for case in cases:
        assert re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)+", case.case_id)
        assert len(case.case_id) <= 64


def test_every_case_names_its_assumed_and_synthetic_inputs(cases):
    for case in cases:
        assert "compound surrogate (synthetic)" in case.assumed()
        assert ("path rig (assumed)" in case.assumed()) == (case.path.family == "rig")


def test_digest_changes_with_a_condition_and_not_with_a_label(altered_study):
    plain = load_study(altered_study({})).cases()[0]
    renamed = load_study(altered_study({"title": "Another title", "compounds.surrogate.source": "elsewhere"})).cases()[
        0
    ]
    stiffer = load_study(altered_study({"compounds.surrogate.long_term_modulus_MPa": 10.3})).cases()[0]
    assert renamed.digest() == plain.digest()
    assert stiffer.digest() != plain.digest()


def test_another_speed_is_a_change_to_the_study_alone(altered_study):
    cases = load_study(altered_study({"runs.1.speed_m_s": [10.0, 22.2]})).cases()
    belt = [case for case in cases if case.run == "belt"]
    assert len(belt) == 8
    assert {case.speed for case in belt} == {10.0, 22.2}
    assert any("22p2mps" in case.case_id for case in belt)


def test_sipes_and_another_wheel_are_a_change_to_the_study_alone(altered_study):
    study = load_study(
        altered_study(
            {
                "blocks.rectangle.sipes": [{"position_mm": 12.0, "width_mm": 0.6}],
                "paths.rig.big_wheel_diameter_mm": 1600.0,
            }
        )
    )
    case = study.cases()[0]
    assert case.block.sipes[0].width_mm == 0.6
    assert case.path.big_wheel_diameter_mm == 1600.0
