"""The loop of a model's developer: run one model, compare it, hold it against what was accepted of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from . import deck
from .compare.baseline.delta import Check, check_tables
from .compare.baseline.movement import Movement, movements
from .compare.baseline.store import Acceptance, Baseline, load_baseline, same_study
from .compare.build import write_tables
from .compare.model_runs import model_runs, model_source
from .compare.part import StudyPart, part_of
from .compare.runs import spring_runs
from .compare.study_comparison import StudyComparison, compare_study
from .compare.summary import write_summary
from .files import read_text, write_text
from .models.run import run_model
from .source_code import code_digest
from .spring import resolve_creep
from .spring import run as run_spring
from .spring.summary import summary_csv, summary_row
from .study import Case, LoadedStudy

WRITTEN_FOR = "written_for.txt"


@dataclass(frozen=True)
class ModelCheck:
    """What became of some models.

    Attributes
    ----------
    found : Comparison
        Of these models and cases alone.
    accepted : tuple of str
        The models that the baseline has rows of; the others are compared with nothing.
    check : Check or None
        None where the baseline has no row of any of them.
    """

    part: StudyPart
    found: StudyComparison
    accepted: tuple[str, ...]
    check: Check | None
    moved: tuple[Movement, ...]
    acceptance: Acceptance | None

    @property
    def compared(self) -> bool:
        """Whether any run had a reference to be compared with."""
        return any(row.error is not None for row in self.found.rows)

    def states(self) -> Mapping[str, Mapping[str, int]]:
        """Return how many runs of each model and each reference have which status."""
        sources = dict.fromkeys(source for source, _ in self.found.runs)
        return {
            source: Counter(run.status for (name, _), run in self.found.runs.items() if name == source)
            for source in sources
        }


@dataclass(frozen=True)
class LoopPlaces:
    """Where the loop reads and writes: ``decks``, ``spring``, ``models`` and ``tables`` below `folder` are its own."""

    folder: Path
    references: Path
    baseline: Path


def check_models(
    study: LoadedStudy,
    names: Sequence[str],
    case_ids: Sequence[str],
    places: LoopPlaces,
    *,
    trusted: bool = False,
    jobs: int = 1,
) -> ModelCheck:
    """Run models on cases of a study as far as they have changed, compare them and check them against the baseline.

    Decks are written for these cases alone, and only to know which references are theirs; runs that are those of
    today's case and code are kept.

    Raises
    ------
    InputError
        For a model or case that is not there, and a model that nobody has trusted.
    """
    accepted = load_baseline(places.baseline) if (places.baseline / "baseline.yaml").is_file() else None
    part = part_of(study, names, case_ids, accepted)
    cases = part.chosen(tuple(resolve_creep(study.cases())))
    _write_decks(cases, places.folder / "decks")
    for variant in part.variants:
        _run_variant(cases, places.folder / "spring", variant)
    for name in part.models:
        _run_own(study, cases, places.folder / "models", name, trusted=trusted, jobs=jobs)
    tables = places.folder / "tables"
    found = compare_study(study, places.folder / "spring", places.references, places.folder / "decks", part=part)
    write_tables(found, places.references, tables)
    if accepted is not None:
        same_study(accepted, tables)
    known = _known(part, accepted)
    if accepted is None or not known:
        return ModelCheck(part, found, (), None, (), None)
    narrowed = StudyPart(
        tuple(name for name in part.variants if f"spring:{name}" in known),
        tuple(name for name in part.models if model_source(name) in known),
        part.case_ids,
    )
    check, moved = check_tables(accepted, tables, narrowed.holds), movements(accepted, tables)
    write_summary(tables, study.model.name, check, moved)
    return ModelCheck(part, found, known, check, moved, accepted.acceptance)


def _known(part: StudyPart, accepted: Baseline | None) -> tuple[str, ...]:
    rows = () if accepted is None else accepted.tables["peaks"]
    inside = {row.get("source") for row in rows}
    return tuple(source for source in part.sources if source in inside)


def _write_decks(cases: Sequence[Case], folder: Path) -> None:
    """Write the decks that are not there as today's code writes them."""
    code = code_digest("deck")
    for case in cases:
        place = folder / case.case_id
        mark, written = f"{code} {case.digest('deck')}\n", place / WRITTEN_FOR
        if written.is_file() and read_text(written) == mark and (place / f"{case.case_id}.inp").is_file():
            continue
        written.unlink(missing_ok=True)
        deck.write(case, place)
        write_text(written, mark)


def _run_variant(cases: Sequence[Case], folder: Path, variant: str) -> None:
    """Run a spring variant where a case has no history of today's inputs and code."""
    place = folder / variant
    runs = spring_runs(cases, folder, (variant,))
    rows = []
    for case in cases:
        run = runs[f"spring:{variant}", case.case_id]
        # one without contact is as current as any: its history is there and empty of force
        history = run.history
        if history is None:
            history = run_spring(case, variant).with_checksum()
            history.write_csv(place / f"{case.case_id}.csv")
        rows.append(summary_row(case, history, variant))
    write_text(place / "summary.csv", summary_csv(rows))


def _run_own(study: LoadedStudy, cases: Sequence[Case], folder: Path, name: str, *, trusted: bool, jobs: int) -> None:
    """Run a model of the user's own where a case has no history of today's inputs and model."""
    runs = model_runs(study, cases, folder, (name,))
    wanting = [case for case in cases if runs[model_source(name), case.case_id].history is None]
    if wanting:
        run_model(study, name, wanting, folder / name, trusted=trusted, jobs=jobs)
