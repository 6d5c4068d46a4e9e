"""All tables and figures of the ladder, from a study and its references."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..compare.csv_table import write_table
from ..compare.runs import fe_runs
from ..spring import resolve_creep
from ..study import Case, LoadedStudy, SimplifiedBelt
from . import compatibility, effects, figures, pareto, published, sensitivity

Table = list[dict[str, Any]]
Say = Callable[[str], None]


@dataclass(frozen=True)
class Folders:
    """Where references, decks and the mesh study lie, and where the tables go."""

    references: Path
    decks: Path
    mesh: Path
    output: Path


def build(study: LoadedStudy, folders: Folders, say: Say, samples: int = 256) -> dict[str, Table]:
    """Make every table and figure and return the tables by name; see docs/model_ladder.md for what they hold."""
    cases = resolve_creep(study.cases())
    engine = study.model.engine
    references = fe_runs(cases, folders.references, engine, folders.decks)
    chosen = representative(cases)
    tables: dict[str, Table] = {}

    def put(name: str, columns: Sequence[str], rows: Iterable[dict[str, Any]]) -> None:
        tables[name] = list(rows)
        write_table(folders.output / f"{name}.csv", columns, tables[name])

    say("error and cost of every rung")
    put("errors", pareto.CASE_COLUMNS, pareto.case_rows(cases, references, engine))
    put("pareto", pareto.COLUMNS, pareto.pareto_rows(tables["errors"], cases))
    put("fe_meshes", pareto.MESH_COLUMNS, pareto.mesh_rows(folders.mesh))
    say("what each effect is worth")
    put("effects", effects.COLUMNS, effects.effect_rows(chosen))
    put("stiffness", effects.THEORY_COLUMNS, [row for case in chosen for row in effects.theory_rows(case)])
    say("published figures")
    put("published", published.COLUMNS, published.published_rows(cases, references, engine, pareto.RUNGS))
    belts = [case for case in chosen if isinstance(case.path, SimplifiedBelt)]
    rungs = ("paper", "bonded", "coupled_coarse")
    put("combinations", published.COMBINATION_COLUMNS,
        [row for case in belts for row in published.combination_rows(case, rungs)])  # fmt: skip
    say("rate and temperature")
    put("compatibility", compatibility.COLUMNS, compatibility.compatibility_rows(cases))
    say("Sobol indices")
    put("sobol", sensitivity.COLUMNS, [row for case in chosen for row in sensitivity.sobol_rows(case, samples)])
    drawn = folders.output / "figures"
    figures.pareto_figure(tables["pareto"], tables["fe_meshes"], drawn / "pareto")
    figures.sobol_figure(tables["sobol"], drawn / "sobol")
    figures.compatibility_figure(tables["compatibility"], drawn / "compatibility")
    return tables


def representative(cases: Sequence[Case]) -> list[Case]:
    """Return a belt case on the simplified profile at the published creep, and a rig case of middling conditions."""
    belts = [case for case in cases if isinstance(case.path, SimplifiedBelt) and not case.free_rolling]
    rigs = [case for case in cases if case.is_rig and case.block.shape == "rectangle"]
    rigs.sort(key=lambda case: (case.temperature, abs(case.interference - 0.2e-3), abs(case.speed - 3.2)))
    return [*belts[:1], *rigs[:1]]
