"""Measured peak normal forces of the rig, where a user has imported them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ..study import Case
from .comparison import scalar_row
from .quantities import SCALAR
from .rows import CANNOT_TELL, MetricRow
from .runs import Runs

SOURCE = "rig:measured"
NOTHING = "measured rig peaks are not published as numbers and none has been imported"


@dataclass(frozen=True)
class RigPeak:
    """Smallest, mean and largest peak normal force of the repeated passes of one rig case, N."""

    lowest: float
    mean: float
    highest: float
    assumed: str = ""

    @property
    def spread(self) -> float:
        """Distance of the mean from the further end of the range, N."""
        return max(self.mean - self.lowest, self.highest - self.mean)


def rig_rows(
    cases: Sequence[Case], runs: Runs, sources: Sequence[str], peaks: Mapping[str, RigPeak]
) -> list[MetricRow]:
    """Compare every source's peaks with the measured ones; without a measurement the row says so."""
    quantity = SCALAR["peak_normal_force"]
    rows = []
    for source in sources:
        for case in cases:
            if not case.is_rig:
                continue
            run = runs[source, case.case_id]
            predicted = None if run.scalars is None else run.scalars.peak_normal_force
            peak = peaks.get(case.case_id)
            names = (case.case_id, SOURCE, source)
            assumed = "; ".join([*case.assumed(), *([peak.assumed] if peak is not None and peak.assumed else [])])
            if peak is None or predicted is None:
                status, note = ("missing", NOTHING) if peak is None else (run.status, f"{source}: {run.note}")
                rows.append(
                    MetricRow(
                        case.case_id, quantity.name, "scalar", SOURCE, source, None if peak is None else peak.mean,
                        predicted, quantity.unit, None, "relative", None, quantity.tolerance, None, CANNOT_TELL,
                        status, note, assumed,
                    )
                )  # fmt: skip
                continue
            rows.append(scalar_row(quantity, peak.mean, predicted, {}, names, peak.spread).marked(assumed))
    return rows


def means(peaks: Mapping[str, RigPeak]) -> dict[str, float]:
    """Return the mean peaks by case, as `Evidence` takes them."""
    return {case_id: peak.mean for case_id, peak in peaks.items()}
