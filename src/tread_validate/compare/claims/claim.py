"""A published statement, its computed counterpart, and whether they agree."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from ...reference import PublishedValue
from ...study import Case, LoadedStudy
from ..regression.coefficients import interval
from ..runs import Runs, SourceRun
from ..tables import ClaimAssessment, Coefficient, Difference

AGREES: ClaimAssessment = "agrees"
DISAGREES: ClaimAssessment = "disagrees"
CANNOT_TELL: ClaimAssessment = "cannot tell"


@dataclass(frozen=True)
class Computed:
    """What was computed for a claim, in the published unit.

    Attributes
    ----------
    value : float or None
        None where it cannot be computed; `note` then says why and `status` how it came about.
    case_ids : tuple of str
        The runs behind it.
    assessment : str or None
        Where a test of its own has judged it (Table 1); else the published interval decides.
    """

    value: float | None
    case_ids: tuple[str, ...] = ()
    status: str = "current"
    note: str = ""
    assumed: tuple[str, ...] = ()
    assessment: ClaimAssessment | None = None


@dataclass(frozen=True)
class Claim:
    """One published number next to one computed number.

    `kind` says what agreement would be worth: ``input``, the study uses the number; ``study``, it follows from the
    study's inputs without a run; ``tuned``, a surrogate was made to meet it; ``model``, a run or a regression of runs
    gives it; ``published``, arithmetic on printed numbers; ``context``, not compared.
    """

    published: PublishedValue
    kind: str
    source: str
    computed: Computed
    low: float | None
    high: float | None
    error: float | None
    error_type: str
    assessment: ClaimAssessment
    note: str


@dataclass(frozen=True)
class Evidence:
    """All that a claim may be computed from.

    Attributes
    ----------
    cases : tuple of Case
        With their creep ratios resolved.
    runs : mapping
        By (source, case id).
    coefficients : tuple of Coefficient
        Of every source, published ones included.
    free_rolling_creep : mapping
        Own free-rolling creep ratio by (source, case id), where a source has searched one.
    rig_peaks : mapping
        Measured mean peak normal force in N by case id; empty until measured ones are imported.
    differences : tuple of Difference
        Of every pair of sources.
    """

    study: LoadedStudy
    cases: tuple[Case, ...]
    runs: Runs
    published: Mapping[str, PublishedValue]
    coefficients: tuple[Coefficient, ...]
    free_rolling_creep: Mapping[tuple[str, str], float]
    rig_peaks: Mapping[str, float]
    differences: tuple[Difference, ...] = ()

    def belt_case(self, *, measured: bool, creep_ratio: float | None = None) -> Case | None:
        """Return the first belt case on the measured or simplified profile; free rolling where no creep is given."""
        for case in self.cases:
            if not case.path.on_tyre or case.path.is_measured != measured:
                continue
            if creep_ratio is None:
                fits = case.free_rolling
            else:
                given = None if case.free_rolling else case.creep_ratio
                fits = given is not None and abs(given - creep_ratio) < 1e-9
            if fits:
                return case
        return None

    def belt_cases(self) -> tuple[Case, ...]:
        """Return every tyre case."""
        return tuple(case for case in self.cases if case.path.on_tyre)

    def rig_cases(self) -> tuple[Case, ...]:
        """Return every rig case."""
        return tuple(case for case in self.cases if case.path.gives_coefficients)

    def run(self, source: str, case: Case) -> SourceRun:
        """Return a source's run of a case, missing where there is none."""
        return self.runs.get(
            (source, case.case_id), SourceRun(source, case.case_id, "missing", "no run of this source")
        )

    def difference(self, shape: str, name: str, a: str, b: str) -> Difference | None:
        """Return the test of two sources' mean coefficients, None where there is none."""
        for row in self.differences:
            if (row.shape, row.coefficient) == (shape, name) and {row.source_a, row.source_b} == {a, b}:
                return row
        return None

    def mean(self, source: str, shape: str, name: str) -> Coefficient | None:
        """Return a source's mean regression coefficient for a block shape."""
        for row in self.coefficients:
            if (row.source, row.shape, row.coefficient, row.set) == (source, shape, name, "mean"):
                return row
        return None


Compute = Callable[[Evidence, str], Computed]


def nothing(note: str, status: str = "missing", cases: Sequence[str] = ()) -> Computed:
    """Return a claim without a computed value, and why."""
    return Computed(None, tuple(cases), status, note)


def judge(published: PublishedValue, kind: str, source: str, computed: Computed) -> Claim:
    """Compare a computed value with what the published one stands for.

    The published interval decides, unless the value brings an assessment. ``exists`` asks for more than the lower
    bound. A value without an interval has to be met to four digits.
    """
    low, high, note = interval(published)
    value, target = computed.value, published.value
    error, error_type = _error(value, target)
    note = "; ".join(part for part in (computed.note, note) if part)
    if value is None:
        return Claim(published, kind, source, computed, low, high, error, error_type, CANNOT_TELL, note)
    if computed.assessment is not None:
        return Claim(published, kind, source, computed, low, high, error, error_type, computed.assessment, note)
    if low is None or high is None:
        if target is None:
            return Claim(published, kind, source, computed, low, high, error, error_type, CANNOT_TELL, note)
        met = abs(value - target) <= 5e-4 * abs(target)
    elif published.spread_kind == "exists":
        met = low < value <= high
    else:
        slack = 1e-9 * max(abs(low), abs(high))
        met = low - slack <= value <= high + slack
    return Claim(published, kind, source, computed, low, high, error, error_type, AGREES if met else DISAGREES, note)


def _error(value: float | None, target: float | None) -> tuple[float | None, str]:
    if value is None or target is None:
        return None, "absolute"
    if target == 0.0 or target == 1.0:
        return value - target, "absolute"
    return (value - target) / target, "relative"
