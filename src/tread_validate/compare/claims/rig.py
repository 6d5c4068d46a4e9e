"""Claims about the rig: temperature, free rolling, the measured peaks and Table 1. One value per source."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ...study import Case
from ...units import IN_MM, IN_MPA
from ..quantities import contact_window
from ..regression.line import EXCLUDED_INTERFERENCES
from ..runs import SourceRun
from ..tables import ClaimAssessment
from .claim import AGREES, CANNOT_TELL, DISAGREES, Compute, Computed, Evidence, nothing

SHAPES = ("rectangle", "parallelogram")


def _all_runs(evidence: Evidence, source: str) -> list[tuple[Case, SourceRun]] | Computed:
    """Return the rig cases with their runs, or why not: a claim about all of them needs all of them."""
    cases = evidence.rig_cases()
    if not cases:
        return nothing("the study has no rig case")
    pairs = [(case, evidence.run(source, case)) for case in cases]
    lost = [(case, run) for case, run in pairs if run.scalars is None]
    if lost:
        case, run = lost[0]
        return nothing(
            f"{len(lost)} of {len(cases)} runs cannot be used, first {case.case_id}: {run.note}",
            run.status,
            [case.case_id for case, _ in lost],
        )
    return pairs


def _assumed(cases: list[Case]) -> tuple[str, ...]:
    return tuple(sorted({item for case in cases for item in case.assumed()}))


def _extreme(value: Callable[[SourceRun], float], target: float) -> Compute:
    """Return the value furthest from the target over all rig cases."""

    def compute(evidence: Evidence, source: str) -> Computed:
        pairs = _all_runs(evidence, source)
        if isinstance(pairs, Computed):
            return pairs
        values = [value(run) for _, run in pairs]
        worst = int(np.argmax([abs(item - target) for item in values]))
        case = pairs[worst][0]
        return Computed(
            values[worst], (case.case_id,), note=f"of {len(pairs)} cases the furthest", assumed=case.assumed()
        )

    return compute


def _net_ratio(run: SourceRun) -> float:
    return net_impulse_ratio(run)


def net_impulse_ratio(run: SourceRun) -> float:
    """Return net over absolute tangential impulse; 0 where there is no tangential force."""
    assert run.history is not None
    absolute = float(np.trapezoid(np.abs(run.history.tangential_force), run.history.time))
    net = float(np.trapezoid(run.history.tangential_force, run.history.time))
    return net / absolute if absolute > 0.0 else 0.0


def _peak_place(run: SourceRun) -> float:
    assert run.history is not None
    assert run.scalars is not None
    start, end = contact_window(run.history)
    return (run.scalars.time_of_peak_normal_force - start) / (end - start)


def _halves(evidence: Evidence, source: str) -> Computed:
    pairs = _all_runs(evidence, source)
    if isinstance(pairs, Computed):
        return pairs
    right = [case for case, run in pairs if _positive_then_negative(run)]
    share = len(right) / len(pairs)
    cases = [case for case, _ in pairs]
    return Computed(share, tuple(case.case_id for case in right), assumed=_assumed(cases))


def _positive_then_negative(run: SourceRun) -> bool:
    assert run.history is not None
    time, force = run.history.time, run.history.tangential_force
    start, end = contact_window(run.history)
    middle = 0.5 * (start + end)
    first = (time >= start) & (time <= middle)
    second = (time >= middle) & (time <= end)
    return bool(np.trapezoid(force[first], time[first]) > 0.0 > np.trapezoid(force[second], time[second]))


def _warm_over_cold(value: Callable[[SourceRun], float], only: Callable[[Case], bool] | None = None) -> Compute:
    """Return the largest ratio of a value at the highest to that at the lowest temperature, other things equal."""

    def compute(evidence: Evidence, source: str) -> Computed:
        pairs = _all_runs(evidence, source)
        if isinstance(pairs, Computed):
            return pairs
        groups: dict[tuple[str, float, float], list[tuple[Case, SourceRun]]] = {}
        for case, run in pairs:
            if only is None or only(case):
                key = (case.block_name, round(case.interference, 9), round(case.speed, 6))
                groups.setdefault(key, []).append((case, run))
        ratios: list[tuple[float, Case, Case]] = []
        for members in groups.values():
            members.sort(key=lambda pair: pair[0].temperature)
            (cold, cold_run), (warm, warm_run) = members[0], members[-1]
            if warm.temperature > cold.temperature and value(cold_run) > 0.0:
                ratios.append((value(warm_run) / value(cold_run), cold, warm))
        if not ratios:
            return nothing("the study has no such pair of rig cases at two temperatures")
        worst, cold, warm = max(ratios, key=lambda item: item[0])
        note = f"largest of {len(ratios)} pairs"
        return Computed(worst, (cold.case_id, warm.case_id), note=note, assumed=_assumed([cold, warm]))

    return compute


def _is_fig5(case: Case) -> bool:
    rpm = case.speed_rpm or 0.0
    shape = case.block.shape == "parallelogram"
    return shape and abs(case.interference - 2e-4) < 1e-9 and abs(rpm - 300.0) < 1e-6


def _peak(run: SourceRun) -> float:
    return 0.0 if run.scalars is None else run.scalars.peak_normal_force


def _tangential(run: SourceRun) -> float:
    if run.scalars is None:
        return 0.0
    return max(run.scalars.peak_positive_tangential_force, -run.scalars.peak_negative_tangential_force)


def _mean_error(shape: str) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        cases = [
            case
            for case in evidence.rig_cases()
            if case.block.shape == shape
            and not any(abs(IN_MM * case.interference - left) < 1e-9 for left in EXCLUDED_INTERFERENCES)
        ]
        if not evidence.rig_peaks:
            return nothing("measured rig peaks are not published as numbers and none has been imported")
        pairs = [(case, evidence.run(source, case), evidence.rig_peaks.get(case.case_id)) for case in cases]
        lost = [case.case_id for case, run, measured in pairs if run.scalars is None or measured is None]
        if lost or not pairs:
            return nothing(f"{len(lost)} of {len(pairs)} runs without a peak on both sides", cases=lost)
        errors = [abs(_peak(run) - measured) / measured for _, run, measured in pairs if measured]
        return Computed(100.0 * float(np.mean(errors)), tuple(case.case_id for case in cases), assumed=_assumed(cases))

    return compute


def _pressure_limit(evidence: Evidence, source: str) -> Computed:
    pairs = [(case, evidence.run(source, case)) for case in evidence.cases]
    known = [(_peak(run) / (case.length * case.width), case) for case, run in pairs if run.scalars is not None]
    if not known or len(known) < len(pairs):
        return nothing(f"{len(pairs) - len(known)} of {len(pairs)} runs cannot be used")
    highest, case = max(known, key=lambda item: item[0])
    return Computed(IN_MPA * highest, (case.case_id,), note=f"highest of {len(known)}", assumed=case.assumed())


def _table1(name: str, shape: str, origin: str) -> Compute:
    """Compare a mean coefficient with a printed one by Welch's test, as in the table of differences.

    A difference that is significant among all of the family's tests disagrees. One that would be so taken alone cannot
    be told. Without either, the two agree if the difference is known to better than the printed value itself.
    """

    def compute(evidence: Evidence, source: str) -> Computed:
        row, printed = evidence.mean(source, shape, name), evidence.mean(f"{origin}:published", shape, name)
        if row is None or row.value is None:
            return nothing(row.note if row is not None else f"no {shape} on the rig in the study")
        assumed = tuple(row.assumed.split("; ")) if row.assumed else ()
        if printed is None or printed.value is None:
            return nothing("Table 1 is not there")
        found = evidence.difference(shape, name, f"{origin}:published", source)
        if found is None or found.ci_low is None or found.ci_high is None or found.p_value is None:
            note = "no test of the difference" if found is None else found.note
            return Computed(100.0 * row.value, note=note, assumed=assumed, assessment=CANNOT_TELL)
        assessment: ClaimAssessment = CANNOT_TELL
        if found.significant:
            assessment = DISAGREES
        elif found.ci_low <= 0.0 <= found.ci_high and 0.5 * (found.ci_high - found.ci_low) <= abs(printed.value):
            assessment = AGREES
        note = f"Welch test of the difference: p = {found.p_value:.2g} taken alone, {found.p_holm:.2g} as one of "
        note += f"{found.tests} (Holm); 95 % interval {100 * found.ci_low:.2g} to {100 * found.ci_high:.2g}"
        return Computed(100.0 * row.value, note=note, assumed=assumed, assessment=assessment)

    return compute


def _mean_of_shapes(evidence: Evidence, source: str, name: str) -> tuple[float, tuple[str, ...]] | Computed:
    rows = [evidence.mean(source, shape, name) for shape in SHAPES]
    values = [row.value for row in rows if row is not None and row.value is not None]
    if len(values) < len(SHAPES):
        return nothing(f"no {name} for both shapes")
    assumed = sorted({part for row in rows if row is not None for part in row.assumed.split("; ") if part})
    return float(np.mean(values)), tuple(assumed)


def _for_ten_percent(name: str) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        mean = _mean_of_shapes(evidence, source, name)
        if isinstance(mean, Computed):
            return mean
        if mean[0] == 0.0:
            return nothing("no effect at all", "undefined")
        return Computed(0.1 / abs(mean[0]), assumed=mean[1])

    return compute


def _between_shapes(name: str, ratio: bool) -> Compute:
    def compute(evidence: Evidence, source: str) -> Computed:
        rows = [evidence.mean(source, shape, name) for shape in SHAPES]
        if any(row is None or row.value is None for row in rows):
            return nothing(f"no {name} for both shapes")
        rectangle, parallelogram = (row.value for row in rows if row is not None and row.value is not None)
        if ratio and rectangle == 0.0:
            return nothing("no effect of the rectangle at all", "undefined")
        assumed = sorted({part for row in rows if row is not None for part in row.assumed.split("; ") if part})
        value = parallelogram / rectangle if ratio else 100.0 * (parallelogram - rectangle)
        return Computed(value, assumed=tuple(assumed))

    return compute


def _overestimate(evidence: Evidence, source: str) -> Computed:
    ratios, assumed = [], set()
    for shape in SHAPES:
        row, rig = evidence.mean(source, shape, "a_theta"), evidence.mean("rig:published", shape, "a_theta")
        if row is None or row.value is None or rig is None or not rig.value:
            return nothing("no a_theta for both shapes")
        ratios.append(row.value / rig.value)
        assumed |= {part for part in row.assumed.split("; ") if part}
    return Computed(float(np.mean(ratios)), assumed=tuple(sorted(assumed)))


# from runs: one value for every source with histories
RUNS: dict[str, Compute] = {
    "linear_model_stress_limit": _pressure_limit,
    "force_falls_with_temperature": _warm_over_cold(_peak),
    "tangential_force_falls_with_temperature": _warm_over_cold(_tangential, _is_fig5),
    "rig_tangential_first_half_positive": _halves,
    "rig_net_tangential_impulse": _extreme(_net_ratio, 0.0),
    "rig_peak_at_centre": _extreme(_peak_place, 0.5),
    "fe_error_rectangle": _mean_error("rectangle"),
    "fe_error_parallelogram": _mean_error("parallelogram"),
}

# from regressions: one value for every source with coefficients
TABLE_1: dict[str, Compute] = {
    f"table1_{name}_{shape}_{origin}": _table1(name, shape, origin)
    for name in ("a_v", "a_theta")
    for shape in SHAPES
    for origin in ("rig", "fe")
}
REGRESSIONS: dict[str, Compute] = {
    "speed_for_ten_percent": _for_ten_percent("a_v"),
    "temperature_for_ten_percent": _for_ten_percent("a_theta"),
    "temperature_overestimate": _overestimate,
    "speed_effect_smaller_for_parallelogram": _between_shapes("a_v", ratio=True),
    "shape_effect_on_a_theta": _between_shapes("a_theta", ratio=False),
}
