"""Measured passes of the rig, where a user has imported them, as references of the rig cases."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import InputError, one_line
from ..history import History
from ..reference.rig import load_rig
from ..study import Case
from .quantities import SCALAR, SCALARS, Scalars, Tolerances, scalars
from .runs import Runs, SourceRun
from .scores.assessment import COVERAGE
from .scores.comparison import compare, empty_row, scalar_row
from .scores.uncertainty import Uncertainties
from .tables import MetricRow

MEASURED = "rig:measured"
NOTHING = "measured rig peaks are not published as numbers and none has been imported"
UNSTATED = "the record states no uncertainty of measurement (import it anew): u_data is not known"
HALF_WIDTHS = {
    "peak_normal_force": "peak_normal_force",
    "peak_positive_tangential_force": "largest_tangential_force",
    "peak_negative_tangential_force": "least_tangential_force",
}
"""Scalars, and what a record calls their means and 95 % half-widths."""
NOT_MEASURED = tuple(quantity.name for quantity in SCALARS if not quantity.measured)


@dataclass(frozen=True)
class RigPeak:
    """An imported record: smallest, mean and largest peak normal force of its passes, N, and the mean history.

    `uncertainty` are relative standard uncertainties of the means, by quantity: passes, noise and load cell. None where
    the record does not state them.
    """

    source: str
    lowest: float
    mean: float
    highest: float
    history: History
    assumed: str = ""
    uncertainty: Mapping[str, float] | None = None

    @property
    def spread(self) -> float:
        """Distance of the mean from the further end of the range, N."""
        return max(self.mean - self.lowest, self.highest - self.mean)


def rig_peaks(reference_dir: Path, cases: Sequence[Case]) -> dict[str, RigPeak]:
    """Return the imported records below ``rig/`` that name a case of the study; a synthetic one says so.

    Raises `InputError` for a damaged record, and for two of one case.
    """
    folder = reference_dir / "rig"
    wanted = {case.case_id for case in cases}
    found: dict[str, RigPeak] = {}
    for reference in load_rig(folder) if folder.is_dir() else ():
        case_id = str(reference.record.get("case_id") or "")
        if case_id not in wanted:
            continue
        where = f"{folder / reference.name}.yaml: peaks"
        if case_id in found:
            raise InputError(where, f"case {case_id} again", "one record for each case")
        peaks = reference.record.get("peaks")
        names = ("peak_normal_force_min_N", "peak_normal_force_N", "peak_normal_force_max_N")
        if not isinstance(peaks, dict) or not all(isinstance(peaks.get(name), int | float) for name in names):
            raise InputError(where, "no peak normal force", "its mean, least and largest value")
        lowest, mean, highest = (float(peaks[name]) for name in names)
        mark = "" if reference.origin == "measured" else f"rig record {reference.name} ({reference.origin})"
        known = _uncertainty(peaks, where)
        found[case_id] = RigPeak(f"rig:{reference.origin}", lowest, mean, highest, reference.history, mark, known)
    return found


def _uncertainty(peaks: Mapping[str, object], where: str) -> Mapping[str, float] | None:
    """Turn a record's half-widths of 95 % into relative standard uncertainties, of its histories' amplitudes as well.

    None where it states none for the normal force.
    """
    standard, means = {}, {}
    for name, own in HALF_WIDTHS.items():
        mean, half = (peaks.get(f"{own}{ending}") for ending in ("_N", "_half_width_95_N"))
        if isinstance(mean, int | float) and isinstance(half, int | float):
            if not 0.0 <= half < math.inf:
                raise InputError(f"{where}.{own}_half_width_95_N", half, "a number of 0 or more")
            standard[name], means[name] = half / COVERAGE, abs(float(mean))
    if "peak_normal_force" not in standard:
        return None
    found = {name: standard[name] / means[name] for name in standard if means[name] > 0.0}
    found["normal_force"] = found["peak_normal_force"]
    both = [name for name in standard if name != "peak_normal_force"]
    if both and max(means[name] for name in both) > 0.0:
        found["tangential_force"] = max(standard[name] for name in both) / max(means[name] for name in both)
    return found


def rig_runs(peaks: Mapping[str, RigPeak]) -> dict[tuple[str, str], SourceRun]:
    """Return the mean histories of the imported records as runs."""
    return {
        (peak.source, case_id): SourceRun(peak.source, case_id, "current", "", peak.history, scalars(peak.history))
        for case_id, peak in peaks.items()
    }


def rig_rows(
    cases: Sequence[Case],
    runs: Runs,
    sources: Sequence[str],
    peaks: Mapping[str, RigPeak],
    spreads: Mapping[str, Mapping[str, float]],
    judged: Tolerances,
) -> list[MetricRow]:
    """Compare every source with the imported records; a case without one has a row that says so."""
    rows: list[MetricRow] = []
    for source in sources:
        for case in cases:
            if not case.path.gives_coefficients:
                continue
            peak, run = peaks.get(case.case_id), runs[source, case.case_id]
            assumed = "; ".join([*case.assumed(), *([peak.assumed] if peak is not None and peak.assumed else [])])
            if peak is None:
                rows.append(_without(case, source, MEASURED, None, run, judged, "missing", NOTHING).marked(assumed))
            elif run.history is None:
                note = f"{source}: {run.note}"
                rows.append(
                    _without(case, source, peak.source, peak.mean, run, judged, run.status, note).marked(assumed)
                )
            else:
                rows += [row.marked(assumed) for row in _rows(case, source, peak, run, spreads.get("rig"), judged)]
    return rows


def measured_means(peaks: Mapping[str, RigPeak]) -> dict[str, float]:
    """Return the mean peaks by case, measured ones only: synthetic ones prove nothing about a model."""
    return {case_id: peak.mean for case_id, peak in peaks.items() if peak.source == MEASURED}


def _rows(
    case: Case,
    source: str,
    peak: RigPeak,
    run: SourceRun,
    inputs: Mapping[str, float] | None,
    judged: Tolerances,
) -> list[MetricRow]:
    """Compare histories; the peak is that of the passes, not of their mean, with the uncertainty of its record.

    The rig does not share the assumed inputs of the study: their spread counts in full, where it is known.
    """
    assert run.history is not None
    assert run.scalars is not None
    names = (case.case_id, peak.source, source)
    quantity = SCALAR["peak_normal_force"]
    known = Uncertainties(peak.uncertainty, run.numerical, inputs)
    parts = known.of_scalar(quantity, Scalars({quantity.name: peak.mean}), run.scalars)
    own = scalar_row(quantity, peak.mean, run.scalars.peak_normal_force, {}, names, parts, judged)
    try:
        rows = compare(
            peak.history,
            run.history,
            case_id=case.case_id,
            reference_source=peak.source,
            predicted_source=source,
            uncertainty=known.data,
            numerical=run.numerical,
            inputs=inputs,
            tolerances=judged,
        )
    except InputError as error:
        note = one_line(str(error))
        return [own, replace(empty_row(quantity, None, None, names, judged, "undefined", note), quantity="normal_force",
                             metric="relative_rms")]  # fmt: skip
    kept = [own, *(row for row in rows if row.quantity not in (*NOT_MEASURED, quantity.name))]
    return kept if peak.uncertainty is not None else [row.hinted(UNSTATED) for row in kept]


def _without(
    case: Case,
    source: str,
    reference_source: str,
    reference: float | None,
    run: SourceRun,
    judged: Tolerances,
    status: str,
    note: str,
) -> MetricRow:
    predicted = run.scalars.peak_normal_force if run.scalars is not None else None
    names = (case.case_id, reference_source, source)
    return empty_row(SCALAR["peak_normal_force"], reference, predicted, names, judged, status, note)
