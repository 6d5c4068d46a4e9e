"""Waves and vibrations with exact speeds."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest


def test_pulse_runs_along_a_bar_at_the_bar_speed(tmp_path: Path, fe: ModuleType) -> None:
    """nu = 0: c = sqrt(E/rho) = 1e5 mm/s. Half the end's velocity passes stations 20 mm apart 20 mm/c apart.

    Tolerance 1 %: 1 mm elements under a front that is 10 mm long.
    """
    modulus, density = 10.0, 1e-9
    speed = np.sqrt(modulus / density)
    block = fe.brick(1, 1, 60, 1.0, 1.0, 60.0)
    stations = {name: int(np.flatnonzero(block.points[:, 2] == z)[0]) for name, z in (("P", 40.0), ("Q", 20.0))}
    rise = 1e-4
    text = (
        block.text() + fe.elastic(modulus, 0.0, density)
        + "".join(f"*NSET, NSET={name}\n{node + 1},\n" for name, node in stations.items())
        + f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {rise}, 1.\n"
        + f"*STEP\n*DYNAMIC, EXPLICIT\n, {float(60.0 / speed)!r}\n"
        + "*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=A\nTOP, 3, 3, -10.\n"
        + "*OUTPUT, HISTORY, TIME INTERVAL=1e-6\n*NODE OUTPUT, NSET=P\nV\n*NODE OUTPUT, NSET=Q\nV\n*END STEP\n"
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    time = np.array(simulation.samples.time)
    passing = {}
    for name in stations:
        velocity = np.array([state[1, 0, 2] for state in simulation.samples.nodes[name]])
        row = int(np.argmax(velocity < -5.0))
        share = (-5.0 - velocity[row - 1]) / (velocity[row] - velocity[row - 1])
        passing[name] = time[row - 1] + share * (time[row] - time[row - 1])
    assert 20.0 / (passing["Q"] - passing["P"]) == pytest.approx(speed, rel=0.01)


def test_free_block_swings_at_its_first_axial_frequency(tmp_path: Path, fe: ModuleType) -> None:
    """nu = 0, free at all faces, started as v = cos(pi z/L): f = c/(2 L). Tolerance 1 %: 16 elements a half wave."""
    modulus, density, length = 10.0, 1e-9, 16.0
    block = fe.brick(4, 4, 16, 4.0, 4.0, length)
    start = "".join(f"{n + 1}, 3, {float(np.cos(np.pi * z / length))!r}\n" for n, z in enumerate(block.points[:, 2]))
    frequency = float(np.sqrt(modulus / density) / (2.0 * length))
    text = (
        block.text() + fe.elastic(modulus, 0.0, density) + "*INITIAL CONDITIONS, TYPE=VELOCITY\n" + start
        + f"*STEP\n*DYNAMIC, EXPLICIT\n, {4.2 / frequency!r}\n*BULK VISCOSITY\n0., 0.\n"
        + f"*OUTPUT, HISTORY, TIME INTERVAL={0.01 / frequency!r}\n*NODE OUTPUT, NSET=TOP\nU\n*END STEP\n"
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    time = np.array(simulation.samples.time)
    end = np.array([state[0, 0, 2] for state in simulation.samples.nodes["TOP"]])
    rows = np.flatnonzero((end[:-1] < 0) != (end[1:] < 0))
    zeros = time[rows] - end[rows] * (time[rows + 1] - time[rows]) / (end[rows + 1] - end[rows])
    zeros = zeros[zeros > 0.1 / frequency]
    measured = 0.5 * (zeros.size - 1) / (zeros[-1] - zeros[0])
    assert measured == pytest.approx(frequency, rel=0.01)
