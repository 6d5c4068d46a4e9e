"""Speed and memory of the FE engine.

Targets: at most 0.4 us per element and step on one core with 24 Prony terms at 1 mm; a 1 mm belt pass and a 1 mm rig
pass in 8 s each; 0.5 mm in 500 MB. Times are of the processor, after compilation, on one thread.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tread_validate import deck
from tread_validate.fe.explicit import Simulation
from tread_validate.fe.model import read_model
from tread_validate.fe.sampling import take_sample
from tread_validate.fe.user_friction import compile_vfric
from tread_validate.study import Case, load_study

ROOT = Path(__file__).resolve().parents[1]
BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"
RIG = "rig-rectangle-22c-0p2mm-300rpm"


def case_of(case_id: str, size: float = 1.0) -> Case:
    case = load_study(ROOT / "config" / "study.yaml").case(case_id)
    settings = case.deck.model_copy(update={"element_size_mm": size, "layers": round(8 / size)})
    return replace(case, deck=settings)


def simulation_of(case: Case, folder: Path, terms: int | None = None) -> Simulation:
    deck.write(case, folder)
    source = folder / f"{case.case_id}.inp"
    if terms is not None:
        # `terms` recursions that no merging can spare: all within the run
        lines = "".join(
            f"{0.9 / terms!r}, {0.9 / terms!r}, {tau!r}\n" for tau in np.logspace(-5.3, -2.3, terms).tolist()
        )
        head, tail = source.read_text().split("*VISCOELASTIC, TIME=PRONY\n")
        source.write_text(head + "*VISCOELASTIC, TIME=PRONY\n" + lines + tail.split("*TRS\n")[1].split("\n", 1)[1])
    return Simulation(read_model(source), compile_vfric(folder / "vfric.f"))


def terms_24(folder: Path) -> None:
    simulation = simulation_of(case_of(BELT), folder, 24)
    simulation._begin(0, simulation.model.steps[0])
    dt = simulation._increment(simulation.model.steps[0], simulation.model.steps[0].period)
    simulation._advance(100, dt)
    elements = simulation.model.mesh.element_labels.size
    best = np.inf
    for _ in range(5):
        begun = time.process_time()
        simulation._advance(200, dt)
        best = min(best, time.process_time() - begun)
    cost = best / 200 / elements * 1e6
    print(f"{simulation.blocks.terms} recursions, {elements} elements: {cost:.3f} us per element and step (target 0.4)")


def whole_pass(case_id: str, folder: Path) -> None:
    simulation = simulation_of(case_of(case_id), folder)
    windows: list[float] = []
    kernel = simulation._kernel

    def timed(count: int, dt: float, fault: NDArray[np.int64]) -> None:
        begun = time.perf_counter()
        kernel(count, dt, fault)
        if count:
            windows.append((time.perf_counter() - begun) / count)

    simulation._kernel = timed  # type: ignore[method-assign]
    wall, cpu = time.perf_counter(), time.process_time()
    simulation.run()
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    quiet = float(np.percentile(windows, 10)) * simulation.increments
    print(
        f"{case_id}: {simulation.increments} increments, {simulation.blocks.terms} recursions: "
        f"{cpu:.1f} s of processor, {wall:.1f} s of wall, {quiet:.1f} s at the pace of the tenth part that other work "
        "disturbed least (target 8 s)"
    )


def fine_mesh(folder: Path) -> None:
    simulation = simulation_of(case_of(BELT, 0.5), folder)
    simulation._begin(0, simulation.model.steps[0])
    dt = simulation._increment(simulation.model.steps[0], simulation.model.steps[0].period)
    simulation._advance(20, dt)
    take_sample(simulation, dt, energies=True)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    elements = simulation.model.mesh.element_labels.size
    print(f"0.5 mm, {elements} elements: peak memory {peak:.0f} MB (target 500 MB)")


def main() -> None:
    if sys.argv[1:] == ["fine"]:
        with tempfile.TemporaryDirectory() as folder:
            fine_mesh(Path(folder))
        return
    with tempfile.TemporaryDirectory() as folder:
        terms_24(Path(folder))
    for case_id in (BELT, RIG):
        with tempfile.TemporaryDirectory() as folder:
            whole_pass(case_id, Path(folder))
    subprocess.run([sys.executable, __file__, "fine"], check=True)


if __name__ == "__main__":
    main()
