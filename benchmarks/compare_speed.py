"""How long the comparison takes: metrics of all cases of the study, and the whole of the tables.

Target: the metrics of all cases in 3 s after compilation. References are made up (the spring runs, 30 % higher and 2 %
slower), because the speed does not depend on what is in them.
"""

from __future__ import annotations

import tempfile
import time
from dataclasses import replace
from pathlib import Path

from tread_validate.compare import compare, compare_study, write_tables
from tread_validate.history import History
from tread_validate.spring import resolve_creep, run
from tread_validate.study import load_study

ROOT = Path(__file__).resolve().parents[1]


def stretched(history: History) -> History:
    return replace(history, time=1.02 * history.time, normal_force=1.3 * history.normal_force)


def main() -> None:
    study = load_study(ROOT / "config" / "study.yaml")
    histories = {case.case_id: run(case) for case in resolve_creep(study.cases())}
    first = next(iter(histories.values()))
    started = time.perf_counter()
    compare(stretched(first), first)
    print(f"first comparison, with imports and compilation: {time.perf_counter() - started:.2f} s")
    started = time.perf_counter()
    rows = sum(len(compare(stretched(history), history)) for history in histories.values())
    print(f"metrics of {len(histories)} cases, {rows} rows: {time.perf_counter() - started:.2f} s (target 3 s)")
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        for case_id, history in histories.items():
            history.write_csv(place / "spring" / "paper" / f"{case_id}.csv")
        started = time.perf_counter()
        found = compare_study(study, place / "spring", ROOT / "reference_data", ROOT / "fe_inputs" / "liu2010")
        write_tables(found, ROOT / "reference_data", place / "tables")
        print(f"all tables of the study: {time.perf_counter() - started:.2f} s")


if __name__ == "__main__":
    main()
