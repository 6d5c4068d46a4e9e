"""Speed and memory of the spring model, one core, after compilation; and the time that compilation takes.

Targets: a converged belt pass in 0.4 ms, a free-rolling search in 6 ms, all cases of the study in 0.15 s, 300 MB.
Times are of the processor, so that other work on a shared machine does not count; the best of many repeats is printed
beside the median.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

STUDY = Path(__file__).resolve().parents[1] / "config" / "study.yaml"
BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"
COLD = """
import time
from tread_validate.spring import run
from tread_validate.study import load_study
case = load_study({study!r}).case({case!r})
start = time.process_time()
run(case)
print(time.process_time() - start)
"""


def measure(work: Callable[[], object], repeats: int) -> tuple[float, float]:
    """Return best and median processor time of one call, s."""
    work()
    times = []
    for _ in range(repeats):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times), statistics.median(times)


def line(what: str, best: float, median: float, target: float, unit: str = "ms", factor: float = 1e3) -> None:
    print(f"{what}: {best * factor:.3g} {unit} best, {median * factor:.3g} {unit} median (target {target:g} {unit})")


def main() -> None:
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    from tread_validate.spring import resolve_creep, run
    from tread_validate.spring.block_pass import prepare
    from tread_validate.spring.creep import root_of
    from tread_validate.study import load_study

    study = load_study(STUDY)
    case = study.case(BELT)
    block_pass = prepare(case)
    line("belt pass", *measure(lambda: block_pass.forces(0.003), 300), 0.4)
    line("free-rolling search", *measure(lambda: root_of(block_pass, case.case_id), 50), 6)
    cases = study.cases()
    line(
        f"all {len(cases)} cases, creep resolved",
        *measure(lambda: [run(one) for one in resolve_creep(cases)], 10),
        0.15,
        "s",
        1.0,
    )
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"largest resident memory: {peak:.0f} MB (target 300 MB)")
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, "-c", COLD.format(study=str(STUDY), case=BELT)],
            env={**os.environ, "NUMBA_CACHE_DIR": folder},
            check=True,
            capture_output=True,
            text=True,
        )
    print(f"first run ever, kernels compiled: {float(done.stdout):.1f} s of processor time (target 15 s)")


if __name__ == "__main__":
    main()
