"""How claims are computed from histories whose answers are known."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from tread_validate.compare.claims.belt import RUNS as BELT
from tread_validate.compare.claims.belt import SPRING
from tread_validate.compare.claims.claim import Evidence
from tread_validate.compare.claims.rig import RUNS as RIG
from tread_validate.compare.claims.rig import net_impulse_ratio
from tread_validate.compare.quantities import scalars
from tread_validate.compare.runs import SourceRun
from tread_validate.history import History
from tread_validate.reference import load_published
from tread_validate.spring import resolve_creep
from tread_validate.study import Case, load_study

WAVE = np.linspace(0.0, 1.0, 2001)


def made_up(case: Case, source: str, **changes: Any) -> SourceRun:
    """Return a run with N = peak sin(pi t/d), T = shear sin(2 pi t/d) + offset, slip in the last `slip` of the pass."""
    kinds = {"peak": 200.0, "shear": 60.0, "offset": 0.0, "slip": 0.1, "late": 0.0, **changes}
    tangential = kinds["shear"] * np.sin(2 * np.pi * WAVE) + kinds["offset"] * np.sin(np.pi * WAVE)
    if kinds["late"]:
        tangential = np.where(WAVE > 0.95, kinds["late"] * np.sin(np.pi * WAVE), tangential)
    history = History(
        0.012 * WAVE, kinds["peak"] * np.sin(np.pi * WAVE), tangential, np.where(1.0 - kinds["slip"] < WAVE, 0.5, 0.0)
    )
    return SourceRun(source, case.case_id, "current", "", history, scalars(history))


@pytest.fixture(scope="module")
def evidence(workspace: Any) -> Evidence:
    """Every case with the same made-up history for one source and one engine."""
    study = load_study(workspace.study)
    cases = resolve_creep(study.cases())
    runs = {(s, c.case_id): made_up(c, s) for s in ("spring:paper", "fe:embedded") for c in cases}
    published = {item.id: item for item in load_published(workspace.references)}
    return Evidence(study, cases, runs, published, (), {}, {})


def changed(evidence: Evidence, which: Any, **changes: Any) -> Evidence:
    """Return the evidence with other histories for the cases that `which` picks."""
    runs = dict(evidence.runs)
    for case in evidence.cases:
        if which(case):
            runs["spring:paper", case.case_id] = made_up(case, "spring:paper", **changes)
    return replace(evidence, runs=runs)


def value(evidence: Evidence, claim: str) -> float | None:
    compute = {**BELT, **RIG, **SPRING}[claim]
    return compute(evidence, "spring:paper").value


def test_belt_forces_and_pressures(evidence: Evidence) -> None:
    """200 N and 60 N on 25 x 20 mm: 0.4 MPa and a ratio of 0.3; sin(2 pi t) has no net impulse."""
    assert value(evidence, "belt_normal_force") == pytest.approx(200.0, rel=1e-6)
    assert value(evidence, "belt_contact_pressure") == pytest.approx(0.4, rel=1e-6)
    assert value(evidence, "belt_tangential_force") == pytest.approx(60.0, rel=1e-5)
    assert value(evidence, "belt_force_ratio") == pytest.approx(0.3, rel=1e-5)
    assert value(evidence, "belt_net_tangential_impulse") == pytest.approx(0.0, abs=1e-9)
    assert value(evidence, "linear_model_stress_limit") == pytest.approx(0.4, rel=1e-6)


def test_the_reversal_at_the_exit_has_to_be_in_every_belt_run(evidence: Evidence) -> None:
    """T < 0 in the second half and > 0 in the last twentieth: 1; one run without it: 0."""
    assert value(evidence, "tangential_reversal_at_exit") == 0.0
    everywhere = changed(evidence, lambda case: case.path.family != "rig", late=8.0)
    assert value(everywhere, "tangential_reversal_at_exit") == 1.0
    first = next(case for case in evidence.cases if case.path.family != "rig")
    but_one = changed(everywhere, lambda case: case is first)
    assert value(but_one, "tangential_reversal_at_exit") == 0.0


def test_slip_at_the_exit_is_looked_for_in_the_last_fifth(evidence: Evidence) -> None:
    """Half of the area slips at the end; a run without slip there makes it 0."""
    assert value(evidence, "belt_slip_at_exit") == pytest.approx(0.5)
    assert value(changed(evidence, lambda case: case.path.family != "rig", slip=0.0), "belt_slip_at_exit") == 0.0


def test_equal_profiles_differ_by_nothing_and_a_tenth_by_its_share(evidence: Evidence) -> None:
    """N 10 % higher on the simplified profile: RMS of 0.1 sin over a half period, 0.1/sqrt 2, to the 1 % window."""
    assert value(evidence, "simplified_profile_normal") == pytest.approx(0.0, abs=1e-12)
    higher = changed(evidence, lambda case: case.path.kind == "simplified_belt", peak=220.0)
    assert value(higher, "simplified_profile_normal") == pytest.approx(0.1 / np.sqrt(2.0), rel=6e-3)


def test_the_free_rolling_creep_lies_where_the_net_impulse_vanishes(evidence: Evidence) -> None:
    """Impulses proportional to offsets +1 (at the common creep ratio) and -2 (at 0.3 %): root a third of the way."""
    free = next(case for case in evidence.cases if case.path.kind == "measured_belt" and case.free_rolling)
    other = changed(evidence, lambda case: case.case_id == free.case_id, offset=1.0)
    other = changed(other, lambda case: case.path.kind == "measured_belt" and not case.free_rolling, offset=-2.0)
    assert free.creep_ratio is not None
    exact = free.creep_ratio + (0.003 - free.creep_ratio) / 3.0
    assert value(other, "belt_creep") == pytest.approx(100.0 * exact, rel=1e-9)


def test_a_searched_creep_ratio_is_preferred(evidence: Evidence) -> None:
    """Where the source has found its own root, that is the answer."""
    free = next(case for case in evidence.cases if case.path.kind == "measured_belt" and case.free_rolling)
    own = replace(evidence, free_rolling_creep={("spring:paper", free.case_id): 0.0025})
    assert value(own, "belt_creep") == pytest.approx(0.25)


def test_a_model_that_is_the_reference_scores_one(evidence: Evidence) -> None:
    """Spring and engine have the same made-up history: ISO score 1."""
    assert value(evidence, "spring_against_fe_normal") == pytest.approx(1.0, abs=1e-12)
    assert value(evidence, "spring_against_fe_tangential") == pytest.approx(1.0, abs=1e-12)


def test_rig_claims_take_the_worst_case(evidence: Evidence) -> None:
    """Peak at mid-contact everywhere; net over absolute impulse 0, but 1 for one case with T > 0 throughout."""
    assert value(evidence, "rig_peak_at_centre") == pytest.approx(0.5, abs=1e-3)
    assert value(evidence, "rig_net_tangential_impulse") == pytest.approx(0.0, abs=1e-9)
    assert value(evidence, "rig_tangential_first_half_positive") == 1.0
    rig = [case for case in evidence.cases if case.path.family == "rig"]
    other = changed(evidence, lambda case: case is rig[3], shear=0.0, offset=5.0)
    assert value(other, "rig_net_tangential_impulse") == pytest.approx(1.0, abs=1e-9)
    assert value(other, "rig_tangential_first_half_positive") == pytest.approx((len(rig) - 1) / len(rig))


def test_warm_over_cold_takes_the_largest_ratio(evidence: Evidence) -> None:
    """Warm runs at 150 N, one at 190 N, cold ones at 200 N: 0.95."""
    other = changed(evidence, lambda case: case.path.family == "rig" and case.temperature == 45.0, peak=150.0)
    one = next(case for case in evidence.cases if case.path.family == "rig" and case.temperature == 45.0)
    other = changed(other, lambda case: case is one, peak=190.0)
    assert value(other, "force_falls_with_temperature") == pytest.approx(0.95, rel=1e-6)


def test_measured_rig_peaks_give_the_mean_error(evidence: Evidence) -> None:
    """Measured 160 N, predicted 200 N in every case: 25 %; one case without a measurement: no value."""
    measured = {case.case_id: 160.0 for case in evidence.cases if case.path.family == "rig"}
    assert value(replace(evidence, rig_peaks=measured), "fe_error_rectangle") == pytest.approx(25.0, rel=1e-6)
    gone = next(case.case_id for case in evidence.cases if case.path.family == "rig")
    fewer = {case_id: peak for case_id, peak in measured.items() if case_id != gone}
    assert value(replace(evidence, rig_peaks=fewer), "fe_error_rectangle") is None


@pytest.mark.parametrize("claim", sorted({*BELT, *RIG}))
def test_a_missing_run_leaves_no_value_and_says_why(claim: str, evidence: Evidence) -> None:
    """Without any run no claim has a value, and each says why."""
    nothing = {
        key: SourceRun(run.source, run.case_id, "stale", "made from another deck") for key, run in evidence.runs.items()
    }
    found = {**BELT, **RIG}[claim](replace(evidence, runs=nothing), "spring:paper")
    assert found.value is None
    assert found.note
    assert found.status != "current"


def test_net_impulse_ratio_of_no_tangential_force_is_zero(evidence: Evidence) -> None:
    """0/0 is no net impulse."""
    case = evidence.cases[0]
    assert net_impulse_ratio(made_up(case, "x", shear=0.0)) == 0.0
