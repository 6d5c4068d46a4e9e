"""Every run of a study against its reference, and the study against the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..beside import beside
from ..errors import InputError, one_line
from ..reference import load_published
from ..study import Case, LoadedStudy
from ..study.typical import by_family
from ..text_table import read_text_table
from ..units import IN_MM
from .claims.claim import Claim, Evidence
from .claims.published import published_claims
from .input_spread import input_spreads
from .model_runs import model_runs
from .numerical import numerical_uncertainties
from .part import StudyPart
from .quantities import Tolerances, tolerances
from .regression.coefficients import computed_regression, published_coefficients
from .regression.differences import differences
from .regression.line import EXCLUDED_INTERFERENCES
from .rig_peaks import MEASURED, measured_means, rig_peaks, rig_rows, rig_runs
from .runs import Runs, SourceRun, engines, fe_runs, spring_runs
from .scores.comparison import compare, empty_rows
from .scores.ensemble import summarise
from .scores.sensitivity import sensitivity
from .tables import Coefficient, Difference, Ensemble, MetricRow, Residual, Sensitivity

HIERARCHY = "hierarchy"


@dataclass(frozen=True)
class StudyComparison:
    """All that the tables say, before it is text."""

    study: LoadedStudy
    cases: tuple[Case, ...]
    sources: tuple[str, ...]
    runs: Runs
    rows: tuple[MetricRow, ...]
    ensembles: tuple[Ensemble, ...]
    coefficients: tuple[Coefficient, ...]
    residuals: tuple[Residual, ...]
    differences: tuple[Difference, ...]
    claims: tuple[Claim, ...]
    sensitivity: tuple[Sensitivity, ...]
    tolerances: Tolerances


def compare_study(
    loaded: LoadedStudy,
    spring_dir: Path,
    reference_dir: Path,
    decks_dir: Path,
    exclude: Sequence[float] = EXCLUDED_INTERFERENCES,
    models_dir: Path | None = None,
    part: StudyPart | None = None,
    jobs: int = 1,
) -> StudyComparison:
    """Compare every run of a study with its reference, and the study with the paper; or a part of that.

    The histories of the user's own models lie in `models_dir`, beside `spring_dir` where it is None. What a part leaves
    out is not read; numerical uncertainties, those of a path and a block, are of the whole study all the same.
    """
    whole = StudyPart(tuple(loaded.model.spring.variants), tuple(loaded.model.models))
    variants, models, sources = (part or whole).variants, (part or whole).models, (part or whole).sources
    every = _resolved(loaded.cases())
    cases = every if part is None else part.chosen(every)
    springs = beside(lambda: spring_runs(cases, spring_dir, variants), jobs)
    runs = model_runs(loaded, cases, models_dir or spring_dir.parent / "models", models)
    references = []
    for engine in engines(reference_dir, loaded.model.engine):
        runs |= fe_runs(cases, reference_dir, engine, decks_dir)
        references.append(f"fe:{engine}")
    rig = rig_peaks(reference_dir, cases)
    runs |= rig_runs(rig)
    runs = springs() | runs
    judged = tolerances(loaded.model.tolerances, loaded.source)
    runs = _with_numerical(every, runs, variants)
    rows = _metric_rows(cases, runs, sources, references, judged, jobs)
    rows += rig_rows(
        cases,
        runs,
        [*sources, *references],
        rig,
        input_spreads(reference_dir / HIERARCHY / loaded.model.name, cases),
        judged,
    )
    published = {item.id: item for item in load_published(reference_dir)}
    coefficients = list(published_coefficients(published))
    residuals: list[Residual] = []
    measured = [MEASURED] if measured_means(rig) else []
    # coefficients and statements are of all cases or of none
    complete = part is None or part.case_ids is None
    for source in (*measured, *references, *sources) if complete else ():
        regression = computed_regression(cases, runs, source, exclude)
        coefficients += regression.coefficients
        residuals += regression.residuals
    if part is not None:
        coefficients = part.coefficients(coefficients, (*measured, *references, *whole.sources, *sources))
    tests = differences(coefficients)
    evidence = Evidence(
        study=loaded,
        cases=cases,
        runs=runs,
        published=published,
        coefficients=tuple(coefficients),
        free_rolling_creep=_free_rolling_creep(spring_dir, variants),
        rig_peaks=measured_means(rig),
        differences=tests,
    )
    return StudyComparison(
        study=loaded,
        cases=cases,
        sources=(*sources, *references),
        runs=runs,
        rows=tuple(rows),
        ensembles=_ensembles(cases, rows, exclude),
        coefficients=tuple(coefficients),
        residuals=tuple(residuals),
        differences=tests,
        claims=published_claims(evidence, [*sources, *references] if part is None else sources) if complete else (),
        sensitivity=_sensitivity(cases, runs, sources, references) if part is None else (),
        tolerances=judged,
    )


def _resolved(cases: tuple[Case, ...]) -> tuple[Case, ...]:
    """Give free-rolling cases the common creep ratio, which the spring model finds."""
    if all(case.creep_ratio is not None for case in cases):
        return cases
    from ..spring import resolve_creep

    return tuple(resolve_creep(cases))


def _with_numerical(cases: Sequence[Case], runs: Runs, variants: Sequence[str]) -> dict[tuple[str, str], SourceRun]:
    """Give the spring runs what mesh and step are worth, where there is anything to compare them with."""
    made = dict(runs)
    for variant in variants:
        known: dict[tuple[str, str], Mapping[str, float]] | None = None
        for case in cases:
            run = runs.get((f"spring:{variant}", case.case_id))
            if run is None or run.history is None:
                continue
            if known is None:
                known = numerical_uncertainties(cases, variant)
            made[run.source, case.case_id] = replace(run, numerical=known[case.path_name, case.block_name])
    return made


def _metric_rows(
    cases: Sequence[Case], runs: Runs, sources: Sequence[str], references: Sequence[str], judged: Tolerances, jobs: int
) -> list[MetricRow]:
    # a second engine (ABAQUS, say) is a reference of the study's own engine too
    pairs = [
        (reference, predicted)
        for reference in references
        for predicted in (*sources, *([references[0]] if reference != references[0] else []))
    ]
    every = [(*pair, case) for pair in pairs for case in cases]

    def rows_of(some: Sequence[tuple[str, str, Case]]) -> list[MetricRow]:
        return [
            row for a, b, case in some for row in _pair_rows(case, runs[a, case.case_id], runs[b, case.case_id], judged)
        ]

    half = len(every) // 2
    second = beside(lambda: rows_of(every[half:]), jobs)
    return [*rows_of(every[:half]), *second()]


def _pair_rows(case: Case, reference: SourceRun, predicted: SourceRun, judged: Tolerances) -> Sequence[MetricRow]:
    """Compare one run with its reference; a row without an error for each quantity where the two cannot be."""
    assumed = "; ".join(case.assumed())
    bad, status, note = reference if reference.history is None else predicted, "", ""
    if reference.history is not None and predicted.history is not None:
        try:
            own = compare(
                reference.history,
                predicted.history,
                case_id=case.case_id,
                reference_source=reference.source,
                predicted_source=predicted.source,
                uncertainty=reference.uncertainty,
                numerical=predicted.numerical,
                inputs=0.0,  # both sides take the study's inputs: what is wrong with these is so with both
                tolerances=judged,
                assumed=assumed,
            )
        except InputError as error:  # two clocks: no score of the pair means anything
            status, note = "undefined", one_line(str(error))
        else:
            return [row.of_run(reference.status, reference.note) for row in own]
    return empty_rows(
        case.case_id,
        reference.source,
        predicted.source,
        status or bad.status,
        note or f"{bad.source}: {bad.note}",
        reference=reference.scalars,
        predicted=predicted.scalars,
        tolerances=judged,
        assumed=assumed,
    )


def _ensembles(cases: Sequence[Case], rows: Sequence[MetricRow], exclude: Sequence[float]) -> tuple[Ensemble, ...]:
    groups = _groups(cases, exclude)
    kinds: dict[tuple[str, str, str, str], list[MetricRow]] = {}
    for row in rows:
        kinds.setdefault((row.reference_source, row.predicted_source, row.quantity, row.metric), []).append(row)
    found = []
    for group, members in groups.items():
        for of_kind in kinds.values():
            inside = [row for row in of_kind if row.case_id in members]
            if inside:
                found.append(summarise(group, inside))
    return tuple(found)


def _groups(cases: Sequence[Case], exclude: Sequence[float]) -> dict[str, set[str]]:
    """Return the groups of cases that are summed up; `published` is the paper's: the rig without 0.3 mm."""
    families = by_family(cases)
    rig = [case for case in cases if case.path.gives_coefficients]
    groups = {
        "all": {case.case_id for case in cases},
        **{family: {case.case_id for case in members} for family, members in families.items()},
        "published": {
            case.case_id for case in rig if not any(abs(IN_MM * case.interference - left) < 1e-9 for left in exclude)
        },
    }
    for shape in sorted({case.block.shape for case in rig}):
        groups[shape] = {case.case_id for case in rig if case.block.shape == shape}
    return {name: members for name, members in groups.items() if members}


def _free_rolling_creep(spring_dir: Path, variants: Sequence[str]) -> dict[tuple[str, str], float]:
    """Return each variant's own free-rolling creep ratios from its summary."""
    found: dict[tuple[str, str], float] = {}
    for variant in variants:
        path = spring_dir / variant / "summary.csv"
        if not path.is_file():
            continue
        table = read_text_table(path)
        table.check(("case_id", "free_rolling_creep_ratio"))
        for _, row in table.records():
            if row["free_rolling_creep_ratio"]:
                found[f"spring:{variant}", row["case_id"]] = float(row["free_rolling_creep_ratio"])
    return found


def _sensitivity(
    cases: Sequence[Case], runs: Runs, sources: Sequence[str], references: Sequence[str]
) -> tuple[Sensitivity, ...]:
    """Measure the scores' sensitivity on the last case that has both a reference and a prediction, per kind of path."""
    rows: list[Sensitivity] = []
    for _, members in sorted(by_family(cases).items()):
        for case in reversed(members):
            reference = runs[references[0], case.case_id].history
            predicted = runs[sources[0], case.case_id].history
            if reference is not None and predicted is not None:
                rows += sensitivity(reference, predicted, case.case_id)
                break
    return tuple(rows)
