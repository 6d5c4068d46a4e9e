"""Speed and memory of the FE engine.

Targets: a belt pass and a rig pass on the study's meshes in 2 s each on one quiet core; a half block in 0.6 of the time
of the whole; 0.5 mm in 500 MB. Also told: what one Prony recursion adds to the element loop. Times are of the
processor, after compilation, on one thread; what other work on the machine does to them shows in the ratios least.
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


def case_of(case_id: str, **changes: object) -> Case:
    case = load_study(ROOT / "config" / "study.yaml").case(case_id)
    return replace(case, deck=case.deck.model_copy(update=changes))


def simulation_of(case: Case, folder: Path, terms: int | None = None) -> Simulation:
    deck.write(case, folder)
    source = folder / f"{case.case_id}.inp"
    if terms is not None:
        # all within the run; what of them no merging can spare is told
        lines = "".join(
            f"{0.9 / terms!r}, {0.9 / terms!r}, {tau!r}\n" for tau in np.logspace(-5.3, -2.3, terms).tolist()
        )
        head, tail = source.read_text().split("*VISCOELASTIC, TIME=PRONY\n")
        source.write_text(head + "*VISCOELASTIC, TIME=PRONY\n" + lines + tail.split("*TRS\n")[1].split("\n", 1)[1])
    return Simulation(read_model(source), compile_vfric(folder / "vfric.f"))


def cost_of_a_step(folder: Path, terms: int) -> tuple[float, int]:
    """Return us per element and step with a series of `terms` terms, and the recursions that it takes."""
    simulation = simulation_of(case_of(BELT), folder, terms)
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
    print(f"{simulation.blocks.terms} recursions, {elements} elements: {cost:.3f} us per element and step")
    return cost, simulation.blocks.terms


def whole_pass(case_id: str, symmetry: str, folder: Path) -> float:
    simulation = simulation_of(case_of(case_id, symmetry=symmetry), folder)
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
    elements = simulation.model.mesh.element_labels.size
    print(
        f"{case_id}, {symmetry}: {elements} elements, {simulation.increments} increments, {simulation.blocks.terms} "
        f"recursions: {cpu:.2f} s of processor (target 2 s), {wall:.1f} s of wall, {quiet:.2f} s at the pace of the "
        f"tenth part that other work disturbed least, {1e-6 * elements * simulation.increments / cpu:.1f} million "
        "elements and steps a second"
    )
    return cpu


def fine_mesh(folder: Path) -> None:
    simulation = simulation_of(case_of(BELT, element_size_mm=0.5, layers=16), folder)
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
        (few, fewer), (many, more) = (cost_of_a_step(Path(folder), terms) for terms in (8, 24))
        adds = 1e3 * (many - few) / (more - fewer)
        print(f"one recursion adds {adds:.2f} ns, of {1e3 * few:.0f} ns with {fewer}")
    for case_id in (BELT, RIG):
        with tempfile.TemporaryDirectory() as folder:
            half, whole = (whole_pass(case_id, symmetry, Path(folder)) for symmetry in ("auto", "full"))
            print(f"{case_id}: half over whole {half / whole:.2f} (target 0.6)")
    subprocess.run([sys.executable, __file__, "fine"], check=True)


if __name__ == "__main__":
    main()
