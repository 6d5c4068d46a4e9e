"""Time of a pass and of the set-up for every rung of the model ladder, on one core after compilation.

Run: python benchmarks/ladder_speed.py
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import time
from pathlib import Path

from tread_validate.ladder.sensitivity import sobol_rows
from tread_validate.spring import free_rolling_creep, run
from tread_validate.spring.coupled.store import converged_ratios, ready
from tread_validate.study import load_study

CASES = (
    "belt-simplified-60c-0p2mm-16p7mps-creep0p3",
    "rig-rectangle-22c-0p2mm-300rpm",
    "rig-parallelogram-22c-0p2mm-300rpm",
)
RUNGS = ("paper", "bonded", "bonded_theory", "coupled_coarse", "coupled")


def best_of(count, work):
    times = []
    for _ in range(count):
        begin = time.perf_counter()
        work()
        times.append(time.perf_counter() - begin)
    return min(times)


def main():
    study = load_study(Path(__file__).resolve().parents[1] / "config" / "study.yaml")
    print(f"{'case':44} {'rung':15} {'set-up s':>9} {'pass s':>9} {'creep search s':>15}")
    run(study.case(CASES[0]), "coupled_coarse")  # compile
    for case_id in CASES:
        case = study.case(case_id)
        for rung in RUNGS:
            for store in (converged_ratios, ready):
                store.cache_clear()
            begin = time.perf_counter()
            run(case, rung)
            first = time.perf_counter() - begin
            each = best_of(3, lambda case=case, rung=rung: run(case, rung))
            search = ""
            if not case.is_rig:
                search = f"{best_of(1, lambda case=case, rung=rung: free_rolling_creep(case, rung)):.3f}"
            print(f"{case_id:44} {rung:15} {first - each:9.3f} {each:9.4f} {search:>15}", flush=True)
    for case_id in CASES[:2]:
        begin = time.perf_counter()
        rows = sobol_rows(study.case(case_id), samples=64)
        print(f"Sobol indices of {case_id}: {rows[0]['samples']} samples in {time.perf_counter() - begin:.1f} s")


if __name__ == "__main__":
    main()
