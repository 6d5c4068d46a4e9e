"""Claims about the tyre belt: forces, creep, the reversal at the exit, the profiles, spring against FE."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...study import Case
from ...units import IN_MPA, MPA
from ..quantities import contact_window
from ..runs import SourceRun
from ..scores.align import align
from ..scores.iso18571 import SAMPLES, iso18571
from ..scores.metrics import relative_rms
from .claim import Compute, Computed, Evidence, nothing
from .rig import net_impulse_ratio
from .study import mean_modulus

PUBLISHED_CREEP = 0.003
EXIT_SHARE = 0.2  # last part of the contact in which slip is looked for


def _at_published_creep(value: Callable[[Case, SourceRun], float]) -> Compute:
    """Compute from the run on the measured profile at 0.3 % creep, which is the one that the paper shows."""

    def compute(evidence: Evidence, source: str) -> Computed:
        case = evidence.belt_case(measured=True, creep_ratio=PUBLISHED_CREEP)
        if case is None:
            return nothing("the study has no case on a measured profile at 0.3 % creep")
        run = evidence.run(source, case)
        if run.scalars is None:
            return nothing(run.note, run.status, [case.case_id])
        return Computed(value(case, run), (case.case_id,), assumed=case.assumed())

    return compute


def _of_all_belt_runs(value: Callable[[Case, SourceRun], float], choose: Callable[[list[float]], float]) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        cases = evidence.belt_cases()
        if not cases:
            return nothing("the study has no tyre case")
        runs = [evidence.run(source, case) for case in cases]
        lost = [run for run in runs if run.scalars is None]
        if lost:
            note = f"{len(lost)} of {len(runs)} runs cannot be used, first {lost[0].case_id}: {lost[0].note}"
            return nothing(note, lost[0].status, [run.case_id for run in lost])
        values = [value(case, run) for case, run in zip(cases, runs, strict=True)]
        chosen = choose(values)
        ids = tuple(case.case_id for case, item in zip(cases, values, strict=True) if item == chosen)
        return Computed(chosen, ids, assumed=tuple(sorted({a for case in cases for a in case.assumed()})))

    return compute


def _normal(case: Case, run: SourceRun) -> float:
    assert run.scalars is not None
    return run.scalars.peak_normal_force


def _pressure(case: Case, run: SourceRun) -> float:
    return IN_MPA * _normal(case, run) / (case.length * case.width)


def _tangential(case: Case, run: SourceRun) -> float:
    assert run.scalars is not None
    return max(run.scalars.peak_positive_tangential_force, -run.scalars.peak_negative_tangential_force)


def _ratio(case: Case, run: SourceRun) -> float:
    assert run.scalars is not None
    return run.scalars.tangential_to_normal_ratio


def _late_change(case: Case, run: SourceRun) -> float:
    assert run.scalars is not None
    return run.scalars.late_sign_change


def _exit_slip(case: Case, run: SourceRun) -> float:
    assert run.history is not None
    start, end = contact_window(run.history)
    late = (run.history.time >= end - EXIT_SHARE * (end - start)) & (run.history.time <= end)
    return float(np.max(run.history.slipping_fraction[late], initial=0.0))


def _strain(evidence: Evidence, source: str) -> Computed:
    case = evidence.belt_case(measured=True, creep_ratio=PUBLISHED_CREEP)
    modulus = None if case is None else mean_modulus(case)
    pressure = _at_published_creep(_pressure)(evidence, source)
    if pressure.value is None or modulus is None:
        return pressure if pressure.value is None else nothing("the compound was not fitted over a band")
    return Computed(100.0 * MPA * pressure.value / modulus, pressure.case_ids, assumed=pressure.assumed)


def _creep(evidence: Evidence, source: str) -> Computed:
    case = evidence.belt_case(measured=True)
    if case is None:
        return nothing("the study has no free-rolling case on a measured profile")
    own = evidence.free_rolling_creep.get((source, case.case_id))
    if own is not None:
        return Computed(100.0 * own, (case.case_id,), assumed=case.assumed())
    other = evidence.belt_case(measured=True, creep_ratio=PUBLISHED_CREEP)
    if other is None or case.creep_ratio is None or case.creep_ratio == PUBLISHED_CREEP:
        return nothing("needs two runs at different creep ratios", cases=[case.case_id])
    runs = [evidence.run(source, item) for item in (case, other)]
    for run in runs:
        if run.scalars is None:
            return nothing(run.note, run.status, [run.case_id])
    a, b = (run.scalars.net_tangential_impulse for run in runs if run.scalars is not None)
    if a == b:
        return nothing("net impulse does not depend on the creep ratio", "undefined")
    root = case.creep_ratio - a * (PUBLISHED_CREEP - case.creep_ratio) / (b - a)
    note = "line through the net impulses of two runs"
    return Computed(100.0 * root, (case.case_id, other.case_id), note=note, assumed=case.assumed())


def _profiles(quantity: str) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        measured = evidence.belt_case(measured=True, creep_ratio=PUBLISHED_CREEP)
        simple = evidence.belt_case(measured=False, creep_ratio=PUBLISHED_CREEP)
        if measured is None or simple is None:
            return nothing("the study has no pair of measured and simplified profile at 0.3 % creep")
        a, b = evidence.run(source, measured), evidence.run(source, simple)
        if a.history is None or b.history is None:
            lost = a if a.history is None else b
            return nothing(lost.note, lost.status, [lost.case_id])
        value = relative_rms(*align(a.history, b.history).forces(quantity))
        assumed = tuple(sorted({*measured.assumed(), *simple.assumed()}))
        return Computed(value, (measured.case_id, simple.case_id), assumed=assumed)

    return compute


def _against_fe(quantity: str) -> Compute:
    """Score the spring model against the study's engine; for other sources there is nothing to say."""

    def compute(evidence: Evidence, source: str) -> Computed:
        case = evidence.belt_case(measured=True, creep_ratio=PUBLISHED_CREEP)
        if case is None:
            return nothing("the study has no case on a measured profile at 0.3 % creep")
        engine = f"fe:{evidence.study.model.engine}"
        reference, predicted = evidence.run(engine, case), evidence.run(source, case)
        for run in (reference, predicted):
            if run.history is None:
                return nothing(f"{run.source}: {run.note}", run.status, [case.case_id])
        assert reference.history is not None
        assert predicted.history is not None
        pair = align(reference.history, predicted.history, SAMPLES)
        score = iso18571(*pair.forces(quantity))
        note = f"{score.grade}, against {engine}"
        return Computed(score.overall, (case.case_id,), note=note, assumed=case.assumed())

    return compute


# one value for every source with histories
RUNS: dict[str, Compute] = {
    "free_rolling_contact_stress": _at_published_creep(_pressure),
    "contact_strain": _strain,
    "stress_ratio_literature": _at_published_creep(_ratio),
    "tangential_reversal_at_exit": _of_all_belt_runs(_late_change, min),
    "belt_normal_force": _at_published_creep(_normal),
    "belt_contact_pressure": _at_published_creep(_pressure),
    "belt_creep": _creep,
    "belt_tangential_force": _at_published_creep(_tangential),
    "belt_force_ratio": _at_published_creep(_ratio),
    "belt_net_tangential_impulse": _at_published_creep(lambda case, run: net_impulse_ratio(run)),
    "belt_slip_at_exit": _of_all_belt_runs(_exit_slip, min),
    "simplified_profile_normal": _profiles("normal_force"),
    "simplified_profile_tangential": _profiles("tangential_force"),
}

# one value for every spring variant
SPRING: dict[str, Compute] = {
    "spring_against_fe_normal": _against_fe("normal_force"),
    "spring_against_fe_tangential": _against_fe("tangential_force"),
}
