"""Measured passes of the rig, where a user has imported them, as references of the rig cases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError, one_line
from ..history import History
from ..reference.rig import load_rig
from ..study import Case
from .quantities import SCALAR, SCALARS, scalars
from .runs import Runs, SourceRun
from .scores.comparison import compare, scalar_row
from .scores.verdict import CANNOT_TELL
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
    cases: Sequence[Case], runs: Runs, sources: Sequence[str], peaks: Mapping[str, RigPeak]
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
                rows.append(_without(case, source, MEASURED, None, run, "missing", NOTHING).marked(assumed))
            elif run.history is None:
                note = f"{source}: {run.note}"
                rows.append(_without(case, source, peak.source, peak.mean, run, run.status, note).marked(assumed))
            else:
                rows += [row.marked(assumed) for row in _rows(case, source, peak, run)]
    return rows


def measured_means(peaks: Mapping[str, RigPeak]) -> dict[str, float]:
    """Return the mean peaks by case, measured ones only: synthetic ones prove nothing about a model."""
    return {case_id: peak.mean for case_id, peak in peaks.items() if peak.source == MEASURED}


def _rows(case: Case, source: str, peak: RigPeak, run: SourceRun) -> list[MetricRow]:
    """Compare histories; the peak is that of the passes, not of their mean, with their range as its uncertainty."""
    assert run.history is not None
    assert run.scalars is not None
    names = (case.case_id, peak.source, source)
    own = scalar_row(SCALAR["peak_normal_force"], peak.mean, run.scalars.peak_normal_force, {}, names, peak.spread)
    try:
        rows = compare(
            peak.history,
            run.history,
            case_id=case.case_id,
            reference_source=peak.source,
            predicted_source=source,
            uncertainty={"peak_normal_force": peak.spread / peak.mean},
        )
    except InputError as error:
        note = one_line(str(error))
        return [own, _without(case, source, peak.source, None, run, "undefined", note, "normal_force", "relative_rms")]
    kept = [row for row in rows if row.quantity not in (*NOT_MEASURED, "peak_normal_force")]
    return [own, *kept]


def _without(
    case: Case,
    source: str,
    reference_source: str,
    reference: float | None,
    run: SourceRun,
    status: str,
    note: str,
    quantity: str = "peak_normal_force",
    metric: str = "scalar",
) -> MetricRow:
    predicted = run.scalars.peak_normal_force if run.scalars is not None and metric == "scalar" else None
    return MetricRow(
        case.case_id, quantity, metric, reference_source, source, reference, predicted, "N", None, "relative", None,
        SCALAR["peak_normal_force"].tolerance, None, CANNOT_TELL, status, note,
    )  # fmt: skip
