"""A part of a study's comparison: some models, on all of its cases or on some."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from ..errors import InputError
from ..model_names import current_name
from ..spring.variants import variants
from ..study import Case, LoadedStudy
from .baseline.store import Baseline
from .model_runs import model_source
from .tables import Coefficient

BY_CASE = {"peaks": "source", "errors": "predicted_source", "expected": "predicted_source", "statistics": "source"}
BY_SOURCE = {
    "regression": "source",
    "regression_residuals": "source",
    "ensemble": "predicted_source",
    "claims": "source",
}
"""Tables of models and the column that names them; with some of the cases only the first can be compared with all."""

TESTS = "regression_differences"


@dataclass(frozen=True)
class StudyPart:
    """What of a study's comparison is asked for.

    Attributes
    ----------
    variants, models : tuple of str
        Spring variants, and models of the user's own, by name.
    case_ids : frozenset of str or None
        None where all cases are asked for.
    others : tuple of Coefficient
        Accepted coefficients of the study's other models: significance is told among the tests of all of them.
    """

    variants: tuple[str, ...]
    models: tuple[str, ...]
    case_ids: frozenset[str] | None = None
    others: tuple[Coefficient, ...] = ()

    @property
    def sources(self) -> tuple[str, ...]:
        """The models as they stand in the tables."""
        return (*(f"spring:{name}" for name in self.variants), *map(model_source, self.models))

    def chosen(self, cases: Sequence[Case]) -> tuple[Case, ...]:
        """Return the cases asked for, in the study's order."""
        return tuple(case for case in cases if self.case_ids is None or case.case_id in self.case_ids)

    def coefficients(self, found: Iterable[Coefficient], order: Sequence[str]) -> list[Coefficient]:
        """Return coefficients that were found and the accepted ones of other models, by their sources' order."""
        place = {source: number for number, source in enumerate(dict.fromkeys(order))}
        return sorted([*found, *self.others], key=lambda row: place.get(row.source, -1))

    def holds(self, table: str, cells: Mapping[str, str]) -> bool:
        """Whether a row of the results belongs to the part."""
        if table == "tolerances":
            return True
        if table != "cases" and table not in (*BY_CASE, *BY_SOURCE, TESTS):
            return False
        if self.case_ids is not None:
            if table != "cases" and table not in BY_CASE:
                return False
            if cells.get("case_id") not in self.case_ids:
                return False
        if table == TESTS:
            return any(cells.get(name) in self.sources for name in ("source_a", "source_b"))
        return table == "cases" or cells.get((BY_CASE | BY_SOURCE)[table]) in self.sources


def part_of(study: LoadedStudy, names: Sequence[str], case_ids: Sequence[str], accepted: Baseline | None) -> StudyPart:
    """Return the part of a study that some models and cases make; without a model all of the study's, likewise cases.

    `names` are those of spring variants, also of ones that the study does not run, and of the study's own models, with
    or without ``spring:`` and ``model:``.

    Raises
    ------
    InputError
        For a model or a case that is not there.
    """
    own, built_in = study.model.models, variants()
    chosen: dict[str, list[str]] = {"spring": [], "model": []}
    for name in dict.fromkeys(names):
        prefix, _, bare = name.rpartition(":")
        bare = bare if bare in own else current_name(bare)
        kind = prefix or ("model" if name in own else "spring")
        if kind not in chosen or bare not in (own if kind == "model" else built_in):
            raise InputError("--model", name, f"one of {', '.join((*own, *built_in))}")
        chosen[kind].append(bare)
    if not names:
        chosen = {"spring": list(study.model.spring.variants), "model": list(own)}
    ids = frozenset(study.case(name).case_id for name in case_ids) or None
    part = StudyPart(tuple(chosen["spring"]), tuple(chosen["model"]), ids)
    others = _others(part, accepted) if ids is None and accepted is not None else ()
    return StudyPart(part.variants, part.models, ids, others)


def _others(part: StudyPart, accepted: Baseline) -> tuple[Coefficient, ...]:
    """Return the accepted coefficients of models that the part leaves out."""
    rows = []
    for line, cells in enumerate(accepted.tables.get("regression", ()), start=2):
        source = cells.get("source", "")
        other = source.startswith(("spring:", "model:")) and source not in part.sources
        if other and cells.keys() >= set(Coefficient.header()):
            rows.append(Coefficient.read(cells, f"baseline, regression.csv:{line}"))
    return tuple(rows)
