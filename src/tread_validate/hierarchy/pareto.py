"""Error against cost: every level of the hierarchy compared with the finite element reference."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..compare import MetricRow, compare
from ..compare.quantities import Tolerances, tolerances
from ..compare.runs import Runs, SourceRun
from ..errors import InputError, one_line
from ..spring import run
from ..study import Case
from .tables import Level, LevelError

LEVELS = ("paper", "shape_factor_theory", "shape_factor", "condensed_coarse", "condensed")
GROUPS: tuple[tuple[str, Callable[[Case], bool]], ...] = (
    ("all", lambda case: True),
    ("rig", lambda case: case.path.gives_coefficients),
    ("belt", lambda case: case.path.on_tyre),
)
PEAKS = ("peak_positive_tangential_force", "peak_negative_tangential_force")


@dataclass(frozen=True)
class Target:
    """What a level was to reach against the finite element runs; fractions and scores, None where nothing was asked."""

    groups: tuple[str, ...]
    mean_normal: float
    worst_normal: float | None = None
    impulse: float | None = None
    tangential: str = ""
    iso_normal: float | None = None
    iso_tangential: float | None = None

    def text(self) -> str:
        """Say the target in words."""
        parts = [f"peak N mean {100 * self.mean_normal:g} %"]
        if self.worst_normal is not None:
            parts.append(f"worst {100 * self.worst_normal:g} %")
        if self.impulse is not None:
            parts.append(f"impulse {100 * self.impulse:g} %")
        if self.tangential:
            parts.append(f"peak longitudinal force {self.tangential}")
        if self.iso_normal is not None:
            parts.append(f"ISO/TS 18571 N {self.iso_normal:g}, T {self.iso_tangential:g}")
        return ", ".join(parts)


TARGETS: Mapping[str, Target] = {
    "shape_factor": Target(("belt",), 0.08),
    "shape_factor_theory": Target(("belt",), 0.08),
    "condensed": Target(("all", "rig", "belt"), 0.03, 0.06, 0.05, tolerances()[PEAKS[0]].criterion, 0.94, 0.85),
}


def case_rows(
    cases: Sequence[Case],
    references: Runs,
    engine: str,
    levels: Sequence[str] = LEVELS,
    track: Callable[[Sequence[Any]], Any] = iter,
    judged: Tolerances | None = None,
) -> list[dict[str, Any]]:
    """Run every level on every case (creep ratios known) and compare with the references of `engine`.

    Time is the processor's for one pass, the second one of its kind, so that compiling and the static solve are left
    out. The rows' columns are those of `LevelError`.
    """
    source = f"fe:{engine}"
    rows = []
    warm: set[tuple[str, str]] = set()
    for level, case in track([(level, case) for level in levels for case in cases]):
        kind = (level, f"{case.block_name} {case.path_name}")
        seconds = None
        try:
            if kind not in warm:
                run(case, level)
                warm.add(kind)
            begin = time.process_time()
            predicted = run(case, level)
        except InputError as error:  # a level that is not made for such a block: said in its row
            found = SourceRun(level, case.case_id, "not_applicable", one_line(str(error)))
        else:
            seconds = time.process_time() - begin
            found = SourceRun(level, case.case_id, "current", history=predicted)
        rows.append(case_row(level, case, references[source, case.case_id], found, seconds=seconds, judged=judged))
    return rows


def case_row(
    level: str,
    case: Case,
    reference: SourceRun,
    found: SourceRun,
    *,
    seconds: float | None,
    memory: float | None = None,
    judged: Tolerances | None = None,
) -> dict[str, Any]:
    """Compare a level's run of a case with the reference; `seconds` and `memory` (MB) are what the run cost."""
    values: tuple[Any, ...] = (None,) * 8
    bad = found if found.status == "not_applicable" or reference.history is not None else reference
    if reference.history is not None and found.history is not None:
        values = _errors(compare(reference.history, found.history, tolerances=judged))
        status, note = "current", ""
    else:
        status, note = bad.status, bad.note
    cells = (level, case.case_id, reference.source, status, seconds, memory, *values, note, "; ".join(case.assumed()))
    return dict(zip(LevelError.header(), cells, strict=True))


def _errors(rows: Sequence[MetricRow]) -> tuple[Any, ...]:
    """Return the errors of a `LevelError`; None of what a model does not give."""
    by_name = {(row.quantity, row.metric): row for row in rows}

    def difference(name: str) -> float | None:
        row = by_name[name, "scalar"]
        return None if row.reference is None or row.predicted is None else row.predicted - row.reference

    def relative(name: str) -> float | None:
        apart, reference = difference(name), by_name[name, "scalar"].reference
        return None if apart is None or not reference else apart / reference

    def score(name: str) -> float | None:
        return by_name[name, "iso18571_r"].predicted

    positive, negative = (difference(f"peak_{sign}_tangential_force") for sign in ("positive", "negative"))
    # over the tolerance by which the results judge the same peaks
    shares = [
        abs(row.error) / (row.tolerance or 1.0)
        for row in (by_name[name, "scalar"] for name in PEAKS)
        if row.error is not None
    ]
    return (
        relative("peak_normal_force"),
        relative("normal_impulse"),
        positive,
        negative,
        max(shares, default=None),
        score("normal_force"),
        score("tangential_force"),
        by_name["late_sign_change", "scalar"].predicted,
    )


def pareto_rows(rows: Sequence[Mapping[str, Any]], cases: Sequence[Case]) -> list[dict[str, Any]]:
    """Sum `case_rows` up by level and group; the rows' columns are those of `Level`.

    `tangential_within` is the share of runs whose tangential peaks are both within the tolerance of the results;
    `target_missed` names the parts of a target that a level misses, with what it reaches.
    """
    by_id = {case.case_id: case for case in cases}
    out = []
    for level in dict.fromkeys(row["level"] for row in rows):
        for group, belongs in GROUPS:
            own = [row for row in rows if row["level"] == level and belongs(by_id[row["case_id"]])]
            if own:
                out.append(_sum_up(level, group, own))
    return out


def _sum_up(level: str, group: str, own: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    kept = [row for row in own if row["status"] == "current"]
    target = TARGETS.get(level)
    asked = target is not None and group in target.groups
    entries: dict[str, Any] = dict.fromkeys(Level.header())
    entries.update(
        level=level, group=group, reference=own[0]["reference"], cases=len(own), compared=len(kept),
        seconds_per_pass=_of(np.median, _known(own, "seconds")), memory_MB=_of(np.max, _known(own, "memory_MB")),
        target=target.text() if target is not None and asked else "", note=_missing(own),
        assumed=own[0]["assumed"],
    )  # fmt: skip
    if not kept:
        return entries
    normal = np.array([row["peak_normal_force_error"] for row in kept])
    impulse = np.array([row["normal_impulse_error"] for row in kept])
    newtons = np.concatenate(
        [_known(kept, f"peak_{sign}_tangential_force_error_N") for sign in ("positive", "negative")]
    )
    iso_normal, iso_tangential = (_known(kept, f"iso18571_{force}") for force in ("normal", "tangential"))
    worst = int(np.argmax(np.abs(normal)))
    entries.update(
        mean_abs_peak_normal_force_error=float(np.mean(np.abs(normal))),
        worst_peak_normal_force_error=float(normal[worst]),
        worst_case_id=kept[worst]["case_id"],
        worst_normal_impulse_error=float(impulse[np.argmax(np.abs(impulse))]),
        tangential_within=_of(np.mean, _known(kept, "tangential_error") <= 1.0),
        worst_tangential_error_N=_of(np.max, np.abs(newtons)),
        least_iso18571_normal=_of(np.min, iso_normal),
        least_iso18571_tangential=_of(np.min, iso_tangential),
        mean_iso18571_normal=_of(np.mean, iso_normal),
        mean_iso18571_tangential=_of(np.mean, iso_tangential),
    )
    if target is not None and asked:
        missed = _missed(target, entries)
        entries.update(target_met=not missed, target_missed="; ".join(missed))
    return entries


def _known(rows: Sequence[Mapping[str, Any]], name: str) -> NDArray[np.float64]:
    """Return the values of a column that are known."""
    return np.array([row[name] for row in rows if row.get(name) is not None], dtype=float)


def _of(measure: Callable[[Any], Any], values: NDArray[Any]) -> float | None:
    """Return a measure of the values, None where there are none."""
    return float(measure(values)) if values.size else None


def _missed(target: Target, entries: Mapping[str, Any]) -> list[str]:
    """Return the parts of a target that are not reached."""

    def percent(name: str) -> str:
        return f"{100 * abs(entries[name]):.3g} %"

    checks = [
        ("peak N mean", "mean_abs_peak_normal_force_error", target.mean_normal),
        ("peak N worst", "worst_peak_normal_force_error", target.worst_normal),
        ("impulse worst", "worst_normal_impulse_error", target.impulse),
    ]
    missed = [
        f"{what} {percent(name)}, asked {100 * most:g} %"
        for what, name, most in checks
        if most is not None and abs(entries[name]) > most
    ]
    if target.tangential and entries["tangential_within"] < 1.0:
        missed.append(
            f"peak longitudinal force within its tolerance in {100 * entries['tangential_within']:.0f} % of the runs"
        )
    scores = (
        ("N", "least_iso18571_normal", target.iso_normal),
        ("T", "least_iso18571_tangential", target.iso_tangential),
    )
    missed += [
        f"ISO/TS 18571 {what} {entries[name]:.3g}, asked more than {least:g}"
        for what, name, least in scores
        if least is not None and not entries[name] > least
    ]
    return missed


def _missing(own: Sequence[Mapping[str, Any]]) -> str:
    """Say which cases of a level give no error, and why."""
    refused = [row["note"] for row in own if row["status"] == "not_applicable"]
    lacking = sum(row["status"] not in ("current", "not_applicable") for row in own)
    parts = [f"{lacking} runs without a current reference"] if lacking else []
    parts += [f"{len(refused)} cases that it is not made for ({refused[0]})"] if refused else []
    return "; ".join(parts)
