"""Time of a pass, of a step and of the set-up for every level of the model hierarchy, and how they grow; one core.

Run: python benchmarks/hierarchy_speed.py [figure.png]

Times are of the processor, compiled; the best of several. Targets: a pass of `condensed` 8 ms (rectangle), 20 ms
(parallelogram); its set-up 0.3 and 1 s, 30 ms from disk; its creep search 60 ms.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

import tread_validate as tv
from tread_validate.geometry import Sipe, path_of
from tread_validate.spring import free_rolling_creep, run
from tread_validate.spring.condensed.roll import CondensedSettings, roll, step_times
from tread_validate.spring.condensed.store import converged_stuck, ready

BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"
MEASURED = "belt-midtop-60c-0p2mm-16p7mps-creep0p3"
CASES = (BELT, MEASURED, "rig-rectangle-22c-0p2mm-300rpm", "rig-parallelogram-22c-0p2mm-300rpm")
SIPES = tuple({"position_mm": at, "width_mm": 0.6, "depth_mm": 6.0} for at in (7.9, 16.5))
LEVELS = ("paper", "shape_factor", "shape_factor_theory", "condensed_coarse", "condensed")
PITCHES, RIBS = 60, 5


def best_of(count, work):
    times = []
    for _ in range(count):
        begin = time.process_time()
        work()
        times.append(time.process_time() - begin)
    return min(times)


def forget():
    for store in (converged_stuck, ready):
        store.cache_clear()


def levels(study):
    print(f"{'case':44} {'level':15} {'set-up s':>9} {'from disk s':>11} {'pass ms':>8} {'creep search ms':>16}")
    for case in (*(study.case(case_id) for case_id in CASES), siped(study)):
        for level in LEVELS:
            if level == "shape_factor_theory" and case.block.sipes:  # it knows no sipes
                continue
            with tempfile.TemporaryDirectory() as folder:
                os.environ["TREAD_VALIDATE_CACHE"] = folder
                forget()
                first = best_of(1, lambda case=case, level=level: run(case, level))
                each = best_of(5, lambda case=case, level=level: run(case, level))
                forget()
                again = best_of(1, lambda case=case, level=level: run(case, level))
                search = ""
                if case.path.family != "rig":
                    search = f"{1e3 * best_of(2, lambda case=case, level=level: free_rolling_creep(case, level)):.1f}"
            del os.environ["TREAD_VALIDATE_CACHE"]
            said = (
                f"{case.case_id:44} {level:15} {first - each:9.3f} {again - each:11.4f} {1e3 * each:8.2f} {search:>16}"
            )
            print(said, flush=True)


def stepping(study):
    for case_id, model in ((case_id, model) for case_id in CASES for model in ("condensed", "paper")):
        case = study.case(case_id)
        path = path_of(case)
        time_ = step_times(path, case.height / 8.0, CondensedSettings())
        block = tv.TreadBlock(case, model)
        middle = 0.5 * path.columns.extent
        at, points = path.at(middle, time_), path.at(middle - block.mount_points, time_[:, None])
        mounts = [
            None if case.path.family == "rig" else np.column_stack(xy) for xy in zip(points.x, points.y, strict=True)
        ]

        def ride(block=block, at=at, time_=time_, path=path, mounts=mounts):
            block.start((at.x[0], at.y[0]), at.theta[0], mounts[0])
            for k in range(1, time_.size):
                block.step(time_[k] - time_[k - 1], (at.x[k], at.y[k]), at.theta[k], path.speed, mounts[k])

        ride()
        each = 1e6 * best_of(3, ride) / (time_.size - 1)
        print(f"{case_id} {model}: {each:.0f} us a step in a host's hands", flush=True)


def siped(study):
    """Return the rig's rectangle with two sipes of 6 mm."""
    case = study.case("rig-rectangle-22c-0p2mm-300rpm")
    sipes = tuple(Sipe(**sipe) for sipe in SIPES)
    return replace(case, case_id="rig, two sipes", block=case.block.model_copy(update={"sipes": sipes}))


def exponent(x, y):
    return float(np.polyfit(np.log(x), np.log(y), 1)[0])


def growth(study):
    """Return (what, x, seconds) of each series."""
    belt = study.case(BELT)
    found = []
    lengths = np.array([1.0, 0.5, 0.25, 0.125])
    cases = [replace(belt, spring=belt.spring.model_copy(update={"element_length_mm": float(e)})) for e in lengths]
    found.append(("paper: elements", 25 / lengths, [best_of(30, lambda c=c: run(c, "paper")) for c in cases]))
    nodes, passes, setups, sizes = [], [], [], []
    for density in (4.0, 6.0, 8.0, 12.0, 16.0):
        settings = CondensedSettings(density=density, long_step=0.1 * density, middle_step=0.25 * density)
        os.environ["TREAD_VALIDATE_CACHE"] = "off"
        forget()
        first = best_of(1, lambda s=settings: roll(belt, s))
        passes.append(best_of(3, lambda s=settings: roll(belt, s)))
        nodes.append(roll(belt, settings).body.nodes_per_layer)
        setups.append(first - passes[-1])
        sizes.append(nodes[-1])
    del os.environ["TREAD_VALIDATE_CACHE"]
    found.append(("condensed: face nodes, steps of 0.8 mm", np.array(nodes), passes))
    found.append(("condensed: set-up, face nodes", np.array(sizes), setups))
    steps, times = [], []
    for step in (0.8, 0.4, 0.2, 0.1):
        settings = CondensedSettings(long_step=step, middle_step=2.5 * step, longest_step=10 * step)
        times.append(best_of(3, lambda s=settings: roll(belt, s)))
        steps.append(roll(belt, settings).time.size)
    found.append(("condensed: steps", np.array(steps), times))
    counts, times = np.array([1, 2, 4, 8]), []
    os.environ["TREAD_VALIDATE_CACHE"] = "off"
    for count in counts:  # each of a length of its own: set-up and pass
        forget()
        times.append(best_of(1, lambda n=count: [roll(longer(belt, k)) for k in range(n)]))
    del os.environ["TREAD_VALIDATE_CACHE"]
    found.append(("condensed: blocks", counts, times))
    for level in ("paper", "condensed"):
        counts = np.array([2, 8, 32])
        found.append((f"{level}: cases", counts, [best_of(2, lambda n=n, r=level: many(belt, r, n)) for n in counts]))
    return found


def longer(belt, k):
    return replace(belt, block=belt.block.model_copy(update={"length_mm": belt.block.length_mm + 0.1 * k}))


def many(belt, level, count):
    for k in range(count):
        run(replace(belt, creep_ratio=round(0.002 + 1e-5 * k, 5)), level)


def draw(found, target):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(6.4, 4.6), layout="constrained")
    for what, x, y in found:
        axes.loglog(x, 1e3 * np.array(y), "o-", label=f"{what}: exponent {exponent(x, y):.2f}")
    axes.set(xlabel="number", ylabel="processor time, ms")
    axes.grid(color="#e6e9ec")
    axes.legend(fontsize=7.5, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)
    figure.savefig(target, dpi=130)


def main():
    study = tv.load_study(Path(__file__).resolve().parents[1] / "config" / "study.yaml")
    run(study.case(BELT), "condensed_coarse")  # compile
    levels(study)
    stepping(study)
    found = growth(study)
    for what, x, y in found:
        span = f"{x[0]:g} to {x[-1]:g}, {1e3 * y[0]:.3g} to {1e3 * y[-1]:.3g} ms"
        print(f"{what}: exponent {exponent(x, y):.2f} ({span})")
    case = study.case(BELT)
    for level in ("paper", "shape_factor", "condensed_coarse", "condensed"):
        each = best_of(5, lambda level=level: run(case, level))
        one, all_ = RIBS * each, PITCHES * RIBS * each
        said = f"{all_:.2f} s a revolution, {one:.3f} s if pitches are alike"
        print(f"a tyre of {PITCHES} pitches x {RIBS} ribs, {level}: {said}")
    if len(sys.argv) > 1:
        draw(found, sys.argv[1])


if __name__ == "__main__":
    main()
