"""A tread block under a belt that gives way: one mode of the belt, coupled to the condensed block step by step.

The belt's stretch above the block is a mass on a spring and a damper, m u'' + c u' + k u = N, u its lift. It runs along
the simplified profile of the study; the block's model is asked for N at the end of each step. The step is the
trapezoidal rule, and N at its end is found by trying the step a few times on a copy of the block. For that rule energy
balances exactly, step by step: the work of N on the belt is what the mass gains, the spring stores and the damper
takes.

Run: python examples/belt_on_springs/belt_on_springs.py [figure.png]
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import tread_validate as tv
from tread_validate.geometry import path_of
from tread_validate.spring.condensed.roll import CondensedSettings, step_times

STUDY = Path(__file__).resolve().parents[2] / "config" / "study.yaml"
CASE = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"


@dataclass(frozen=True)
class Belt:
    """One mode of a belt: modal mass in kg, natural frequency in Hz, damping ratio."""

    mass: float = 0.1
    frequency: float = 500.0
    damping: float = 0.1

    @property
    def stiffness(self):
        """k, N/m."""
        return self.mass * (2.0 * math.pi * self.frequency) ** 2

    @property
    def resistance(self):
        """c, N s/m."""
        return 2.0 * self.damping * self.mass * 2.0 * math.pi * self.frequency


def ride(case, belt, model="condensed", tries=6):
    """Let the block pass under the belt (None: a rigid one).

    Returns a dictionary of arrays over time (s): normal, tangential (N), lift (m), speed (m/s), work of N on the belt
    (J), and what the mass, the spring and the damper hold of it (J).
    """
    path, creep = path_of(case), case.creep_ratio
    time = step_times(path, case.height / 8.0, CondensedSettings(middle_step=0.5, longest_step=0.5))
    block = tv.TreadBlock(case, model)
    middle = 0.5 * path.columns.extent
    at = path.at(middle, time)
    knots = path.at(middle - block.mount_points, time[:, None])

    def pose(step, lift):
        mount = np.column_stack([knots.x[step], knots.y[step] + lift])
        return (at.x[step], at.y[step] + lift), at.theta[step], mount

    block.start(*pose(0, 0.0))
    rows = [(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)]
    lift = speed = force = work = lost = 0.0
    for step in range(1, time.size):
        dt = time[step] - time[step - 1]
        new = force
        for last in [False] * (tries if belt else 0) + [True]:
            ahead, faster = swing(belt, lift, speed, 0.5 * (force + new), dt) if belt else (0.0, 0.0)
            trial = block if last else block.copy()
            position, angle, mount = pose(step, ahead)
            new, tangential = trial.step(dt, position, angle, path.speed * (1.0 + creep), mount)
        if belt:
            work += 0.5 * (force + new) * (ahead - lift)
            lost += belt.resistance * (0.5 * (speed + faster)) ** 2 * dt
        lift, speed, force = ahead, faster, new
        rows.append((new, tangential, lift, speed, work, lost))
    names = ("normal", "tangential", "lift", "speed", "work", "damper")
    found = dict(zip(names, np.array(rows).T, strict=True))
    if belt:
        found["mass"] = 0.5 * belt.mass * found["speed"] ** 2
        found["spring"] = 0.5 * belt.stiffness * found["lift"] ** 2
    return {"time": time, **found}


def swing(belt, lift, speed, force, dt):
    """Return lift and speed after a step of the trapezoidal rule under the mean force."""
    half = 0.5 * dt
    pull = force - belt.resistance * speed - belt.stiffness * (lift + half * speed)
    change = dt * pull / (belt.mass + half * belt.resistance + half * half * belt.stiffness)
    return lift + dt * (speed + 0.5 * change), speed + change


def draw(rigid, soft, target):
    """Draw both passes."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (top, middle, below) = pyplot.subplots(3, 1, sharex=True, figsize=(7, 7), layout="constrained")
    for axes, name, label in ((top, "normal", "normal force, N"), (middle, "tangential", "longitudinal force, N")):
        for found, text in ((rigid, "rigid belt"), (soft, "belt on springs")):
            axes.plot(1e3 * found["time"], found[name], label=text)
        axes.set_ylabel(label)
    top.legend()
    below.plot(1e3 * soft["time"], 1e3 * soft["lift"], color="C1")
    below.set(xlabel="time, ms", ylabel="lift of the belt, mm")
    figure.savefig(target, dpi=120)


def main():
    """Compare the block under a rigid belt and under one that gives way."""
    case = tv.load_study(STUDY).case(CASE)
    belt = Belt()
    rigid, soft = ride(case, None), ride(case, belt)
    error = soft["work"] - soft["mass"] - soft["spring"] - soft["damper"]
    print(f"peak N: rigid {rigid['normal'].max():.1f} N, belt on springs {soft['normal'].max():.1f} N")
    print(f"largest lift {1e3 * soft['lift'].max():.3f} mm")
    print(f"energy: work on the belt up to {1e3 * soft['work'].max():.2f} mJ, balance {1e3 * abs(error).max():.1e} mJ")
    stiffer = ride(case, replace(belt, frequency=50 * belt.frequency))
    print(f"a belt of {50 * belt.frequency:g} Hz: {stiffer['normal'].max():.1f} N")
    if len(sys.argv) > 1:
        draw(rigid, soft, sys.argv[1])


if __name__ == "__main__":
    main()
