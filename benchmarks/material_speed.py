"""How long the laboratory routes take, once their modules are loaded: python benchmarks/material_speed.py.

Target: sweeps to Prony series, with 400 resamples for the bands, in under 1 s.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

from tread_validate.friction import fit_friction, read_friction_table
from tread_validate.geometry.trace import level
from tread_validate.geometry.trace_import import read_ridges
from tread_validate.material import RouteSettings, prony_series, read_route
from tread_validate.material.compound import fit_surrogate
from tread_validate.reference.rig_passes import cut_passes
from tread_validate.reference.rig_record import read_record
from tread_validate.study import load_study

ROOT = Path(__file__).resolve().parents[1]
DATA = ROOT / "reference_data"


def timed(name: str, work: Callable[[], object]) -> None:
    work()
    wall, cpu = time.perf_counter(), time.process_time()
    work()
    print(f"{name:62s} {time.perf_counter() - wall:7.3f} s wall, {time.process_time() - cpu:7.3f} s CPU")


def main() -> None:
    study = load_study(ROOT / "config" / "study.yaml")
    compound = study.model.compounds["surrogate"]
    sweeps = DATA / "material" / "synthetic_sweeps.csv"

    def route(**settings: object) -> Callable[[], object]:
        return lambda: read_route(sweeps, compound.wlf, 22.0, RouteSettings(band=(0.25, 2500.0), **settings))  # type: ignore[arg-type]

    timed("sweeps to 24 terms, 400 resamples", route())
    timed("the same with fitted WLF constants and vertical shifts", route(fit_wlf=True, vertical="fitted"))
    timed("the same, pruned to 2.5 %", route(fit_wlf=True, vertical="fitted", largest_error=0.025))
    timed("surrogate law to 24 terms", lambda: fit_surrogate.__wrapped__(compound))
    timed("series of the study's 52 cases", lambda: [prony_series(case.compound) for case in study.cases()])
    table = DATA / "friction" / "synthetic_tribometer.csv"
    timed("tribometer table, 120 rows, to Huemer's constants", lambda: fit_friction(read_friction_table(table)))
    ridges = DATA / "belt" / "synthetic_ridges.csv"
    timed("four ridges to levelled traces with uncertainty", lambda: level(read_ridges(ridges)))
    record = DATA / "rig" / "synthetic_record.csv"
    timed("rig record, 16,700 samples, to passes", lambda: cut_passes(read_record(record)))


if __name__ == "__main__":
    main()
