"""All tables and figures of the hierarchy, from a study and its references."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..compare.quantities import tolerances
from ..compare.runs import fe_runs
from ..compare.tables import TableRow, write_rows
from ..errors import InputError
from ..spring import resolve_creep
from ..study import Case, LoadedStudy
from ..study.typical import path_and_block, path_kind, typical_cases
from . import compatibility, compounds, effects, fe_meshes, figures, pareto, published, sensitivity
from .own_models import own_rows
from .tables import (
    CombinationRow,
    Compatibility,
    CompoundDependence,
    CompoundError,
    Effect,
    FeMesh,
    Level,
    LevelError,
    PublishedFigure,
    SobolIndex,
    StiffnessRow,
)  # fmt: skip

Table = list[dict[str, Any]]
Say = Callable[[str], None]

PARTS = ("pareto", "effects", "published", "compounds", "compatibility", "sobol")


@dataclass(frozen=True)
class Folders:
    """Where references, decks and the runs of the study's own models lie, and where the tables go."""

    references: Path
    decks: Path
    output: Path
    models: Path | None = None


def build(
    study: LoadedStudy, folders: Folders, say: Say, samples: int = 256, parts: Sequence[str] = PARTS
) -> dict[str, Table]:
    """Make the tables and figures of the `parts` and return the tables by name; see docs/model_hierarchy.md.

    Raises `InputError` for a part that is none of `PARTS`.
    """
    for part in parts:
        if part not in PARTS:
            raise InputError("hierarchy: part", part, f"one of {', '.join(PARTS)}")
    cases = resolve_creep(study.cases())
    engine = study.model.engine
    references = fe_runs(cases, folders.references, engine, folders.decks)
    chosen = representative(cases)
    drawn = folders.output / "figures"
    tables: dict[str, Table] = {}

    def put(kind: type[TableRow], rows: Iterable[dict[str, Any]]) -> None:
        tables[kind.table] = list(rows)
        write_rows(folders.output, kind, [kind(**row) for row in tables[kind.table]])

    judged = tolerances(study.model.tolerances, study.source)
    if "pareto" in parts:
        say("error and cost of every level")
        held = pareto.case_rows(cases, references, engine, judged=judged)
        if folders.models is not None:
            held += own_rows(study, cases, references, folders.models, judged)
        put(LevelError, held)
        put(Level, pareto.pareto_rows(tables["errors"], cases))
        put(FeMesh, fe_meshes.mesh_rows(folders.references, engine))
        figures.pareto_figure(tables["pareto"], tables["fe_meshes"], drawn / "pareto")
    if "effects" in parts:
        say("what each effect is worth")
        put(Effect, effects.effect_rows(chosen))
        theory = []
        for case in chosen:
            try:
                theory += effects.theory_rows(case)
            except InputError as error:
                say(f"no stiffness by theory for {case.case_id}: {error}")
        put(StiffnessRow, theory)
    if "published" in parts:
        say("published figures")
        put(PublishedFigure, published.published_rows(cases, references, engine, pareto.LEVELS))
        belts = [case for case in chosen if case.path.varies(*published.VARIED)]
        levels = ("paper", "shape_factor", "condensed_coarse")
        put(CombinationRow,
            [row for case in belts for row in published.combination_rows(case, levels)])  # fmt: skip
    if "compounds" in parts:
        say("other compounds")
        by_compound, dependence = compounds.compound_tables(spread(cases), study.root, judged)
        put(CompoundError, by_compound)
        put(CompoundDependence, dependence)
        figures.compounds_figure(by_compound, drawn / "compounds")
    if "compatibility" in parts:
        say("rate and temperature")
        put(Compatibility, compatibility.compatibility_rows(cases))
        figures.compatibility_figure(tables["compatibility"], drawn / "compatibility")
    if "sobol" in parts:
        say("Sobol indices")
        put(SobolIndex, [row for case in chosen for row in sensitivity.sobol_rows(case, samples)])
        figures.sobol_figure(tables["sobol"], drawn / "sobol")
    return tables


def spread(cases: Sequence[Case]) -> list[Case]:
    """Return the slowest, the typical and the fastest case of every kind of path and block, at one interference."""
    found: dict[str, Case] = {}
    for typical in typical_cases(cases, path_and_block):
        like = [
            case
            for case in cases
            if path_and_block(case) == path_and_block(typical)
            and (case.interference, case.free_rolling) == (typical.interference, typical.free_rolling)
        ]
        for one in (min(like, key=_rate), typical, max(like, key=_rate)):
            found.setdefault(one.case_id, one)
    return list(found.values())


def _rate(case: Case) -> tuple[float, float]:
    return case.speed, -case.temperature


def representative(cases: Sequence[Case]) -> list[Case]:
    """Return one typical case of every kind of path, chosen from the study by one rule; see `typical_cases`."""
    return list(typical_cases(cases, path_kind))
