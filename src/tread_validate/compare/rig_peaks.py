"""Measured passes of the rig, where a user has imported them, as references of the rig cases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..errors import InputError, one_line
from ..history import History
from ..reference.rig import load_rig
from ..study import Case
from .quantities import SCALAR, SCALARS, Scalars, Tolerances, scalars
from .runs import Runs, SourceRun
from .scores.comparison import compare, empty_row, scalar_row
from .scores.uncertainty import UNIFORM, Uncertainties
from .tables import MetricRow

MEASURED = "rig:measured"
NOTHING = "measured rig peaks are not published as numbers and none has been imported"
NOT_MEASURED = tuple(quantity.name for quantity in SCALARS if not quantity.measured)


@dataclass(frozen=True)
class RigPeak:
    """An imported record: smallest, mean and largest peak normal force of its passes, N, and the mean history."""

    source: str
    lowest: float
    mean: float
    highest: float
    history: History
    assumed: str = ""

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
        found[case_id] = RigPeak(f"rig:{reference.origin}", lowest, mean, highest, reference.history, mark)
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
            if not case.is_rig:
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
    """Compare histories; the peak is that of the passes, not of their mean, with their range as its uncertainty.

    The rig does not share the assumed inputs of the study: their spread counts in full, where it is known.
    """
    assert run.history is not None
    assert run.scalars is not None
    names = (case.case_id, peak.source, source)
    quantity = SCALAR["peak_normal_force"]
    known = Uncertainties({quantity.name: UNIFORM * peak.spread / peak.mean}, run.numerical, inputs)
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
    kept = [row for row in rows if row.quantity not in (*NOT_MEASURED, quantity.name)]
    return [own, *kept]


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
