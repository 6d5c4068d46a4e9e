"""What the validity map expects of every spring run of a study, beside the error that it has."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..study import Case
from ..validity import Expectation, expected_error
from .runs import Runs, SourceRun
from .tables.expected import Expected, ExpectedRow

QUANTITIES: tuple[Expected, ...] = ("normal", "impulse", "tangential")
SMALL_SHARE = 0.02
"""Peaks of T below this share of the peak of N do not serve as a measure, as in the map."""


def expected_rows(cases: Sequence[Case], runs: Runs, sources: Sequence[str]) -> Iterator[ExpectedRow]:
    """Yield a row for each spring run and quantity, against each FE engine of the study.

    `sources` are those of the comparison; creep ratios of the cases are known.
    """
    engines = [source for source in sources if source.startswith("fe:")]
    for source in (source for source in sources if source.startswith("spring:")):
        for case in cases:
            found = expected_error(case, source.partition(":")[2])
            for engine in engines:
                yield from _rows(case, found, runs[source, case.case_id], runs[engine, case.case_id])


def _rows(case: Case, found: Expectation, run: SourceRun, reference: SourceRun) -> Iterator[ExpectedRow]:
    errors = actual_errors(run, reference)
    bad = next((each for each in (run, reference) if each.scalars is None), None)
    for quantity in QUANTITIES:
        limit, actual = found.likely.get(quantity), errors.get(quantity)
        yield ExpectedRow(
            case_id=case.case_id,
            predicted_source=run.source,
            reference_source=reference.source,
            quantity=quantity,
            expected=getattr(found, quantity),
            limit=limit,
            actual=actual,
            inside=None if limit is None or actual is None else abs(actual) <= limit,
            outside_map="; ".join(found.outside),
            map_made_by=found.stale,
            status=reference.status if bad is None else bad.status,
            assumed="; ".join(case.assumed()),
        )


def actual_errors(run: SourceRun, reference: SourceRun) -> Mapping[str, float]:
    """Return the errors of a run as the map measures them; none where either has no forces."""
    if run.scalars is None or reference.scalars is None:
        return {}
    own, other = run.scalars.as_dict(), reference.scalars.as_dict()
    found = {
        "normal": own["peak_normal_force"] / other["peak_normal_force"] - 1.0,
        "impulse": own["normal_impulse"] / other["normal_impulse"] - 1.0,
    }
    peaks = [f"peak_{sign}_tangential_force" for sign in ("positive", "negative")]
    if all(name in own and name in other for name in peaks):
        largest = max(*(abs(other[name]) for name in peaks), SMALL_SHARE * other["peak_normal_force"])
        found["tangential"] = max(abs(own[name] - other[name]) for name in peaks) / largest
    return found
