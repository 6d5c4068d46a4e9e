"""Sliding blocks: friction is mu N while all nodes slide, and no energy is lost on the way."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tread_validate.deck.vfric import properties, user_friction
from tread_validate.fe.energy import COLUMNS
from tread_validate.fe.explicit import Simulation
from tread_validate.fe.model import read_model
from tread_validate.fe.user_friction import compile_vfric
from tread_validate.friction import coulomb_law

TERMS = "*VISCOELASTIC, TIME=PRONY\n0.25, 0.25, 5e-6\n0.2, 0.2, 5e-5\n0.2, 0.2, 5e-4\n"


def dragged(fe: ModuleType, folder: Path, shape: tuple[int, int, int], mu: float, damping: float) -> Simulation:
    """A block of 6 x 3 x 3 mm pressed by 0.15 mm on a plane that runs away under it at 1 m/s, 2 mm in all."""
    block = fe.brick(*shape, 6.0, 3.0, 3.0)
    extra = TERMS + (f"*DAMPING, BETA={damping}\n" if damping else "")
    text = (
        block.text() + fe.elastic(30.0, 0.47, 1e-9, extra) + fe.plane() + fe.coulomb(mu)
        + "*AMPLITUDE, NAME=PRESS, DEFINITION=SMOOTH STEP\n0., 0., 3e-4, 1., 6e-4, 0.\n"
        + "*AMPLITUDE, NAME=GO, DEFINITION=SMOOTH STEP\n0., 0., 6e-4, 1.\n"
        + "*BOUNDARY\nROADREF, 2, 6\nTOP, 1, 2\n"
        + fe.step(2.4e-3, "*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=PRESS\nTOP, 3, 3, -500.\n"
                          "*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=GO\nROADREF, 1, 1, 1000.\n", fe.CONTACT)
    )  # fmt: skip
    return fe.run(folder, text)


def late_ratio(simulation: Simulation) -> float:
    """|T|/N over the last third of the run."""
    normal = np.array(simulation.samples.normal)[:, 2]
    tangential = np.array(simulation.samples.tangential)[:, 0]
    late = slice(2 * normal.size // 3, None)
    return float(tangential[late].sum() / normal[late].sum())


@pytest.mark.parametrize("mu", [0.2, 0.5])
@pytest.mark.parametrize("shape", [(1, 1, 1), (6, 1, 1), (12, 6, 6)], ids=["one element", "one row", "0.5 mm"])
def test_friction_of_a_sliding_block_is_mu_times_the_normal_force(
    tmp_path: Path, fe: ModuleType, shape: tuple[int, int, int], mu: float
) -> None:
    """T/N = mu to 0.5 % on every mesh, and all energy is accounted for to 0.1 % of the work done."""
    simulation = dragged(fe, tmp_path, shape, mu, 2e-7)
    assert late_ratio(simulation) == pytest.approx(mu, rel=5e-3)
    energy = np.array(simulation.samples.energy)
    column = {name: energy[:, k] for k, name in enumerate(COLUMNS)}
    assert np.abs(column["total"]).max() < 1e-3 * np.abs(column["external_work"]).max()
    assert column["frictional"][-1] > 0.5 * column["external_work"][-1]


def test_dissipation_of_the_material_never_turns_back(tmp_path: Path, fe: ModuleType) -> None:
    """Stress work less what the Prony states hold only grows, but for finite strain (J in J sigma:D): 0.1 % of it."""
    simulation = dragged(fe, tmp_path, (6, 3, 3), 0.3, 0.0)
    energy = np.array(simulation.samples.energy)
    lost = energy[:, COLUMNS.index("viscoelastic_dissipation")]
    assert lost[-1] > 0.0
    assert np.diff(lost).min() > -1e-3 * energy[:, COLUMNS.index("internal")].max()


def cycle(static: float, kinetic: float, stiffness: float, frequency: float, speed: float) -> tuple[float, float]:
    """Exact stick and slip of a mass on a spring over a moving road: period, and standard deviation of the friction.

    At rest on the road the friction is the spring's force, which climbs from 2 kinetic - static to static. Then the
    mass swings about the force `kinetic`, with the road's speed to begin with, until it has that speed again, and the
    friction is `kinetic`. So the mean friction is `kinetic`, and the scatter that of the ramp.
    """
    drop = static - kinetic
    rest = 2.0 * drop / (stiffness * speed)
    swing = 2.0 * (np.pi - np.arctan(drop * frequency / (stiffness * speed))) / frequency
    return rest + swing, drop * np.sqrt(rest / (3.0 * (rest + swing)))


def test_block_on_its_spring_sticks_and_slips_in_the_exact_cycle(tmp_path: Path, fe: ModuleType) -> None:
    """One flat element (nu = 0) is a mass on a shear spring; the decks' VFRIC, mu_s 0.9, mu_k 0.5; plane at 358 mm/s.

    Mean friction mu_k N and period 1 %, standard deviation 2 %: the couple of the shear presses leading and trailing
    nodes unlike, by a fifteenth of N, so that they do not let go at once.
    """
    modulus, density, speed, squeeze = 20.0, 1e-8, 358.0, 0.01
    block = fe.brick(1, 1, 1, 40.0, 2.0, 1.0)
    area = 80.0
    stiffness, mass = 0.5 * modulus * area, 0.5 * density * area
    normal = modulus * squeeze * area
    law = coulomb_law(0.5, 0.9)
    routine = tmp_path / "vfric.f"
    routine.write_text(user_friction(law).source, encoding="ascii")
    values = properties(law, 0.5 * density)
    friction = fe.user_friction(*values).replace("USER=FRIC", "USER=FRIC, DEPVAR=1")
    text = (
        block.text() + fe.elastic(modulus, 0.0, density) + fe.plane() + friction
        + "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., 4e-4, 1.\n"
        + "*AMPLITUDE, NAME=GO, DEFINITION=SMOOTH STEP\n0., 0., 4e-4, 0., 6e-4, 1.\n"
        + "*BOUNDARY\nROADREF, 2, 6\nTOP, 1, 2\n"
        + fe.step(4e-3, "*BULK VISCOSITY\n0., 0.\n", f"*BOUNDARY, AMPLITUDE=A\nTOP, 3, 3, {-squeeze}\n",
                  f"*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=GO\nROADREF, 1, 1, {speed}\n", fe.CONTACT, interval=1e-6)
    )  # fmt: skip
    path = tmp_path / "deck.inp"
    path.write_text(text.replace("*DYNAMIC, EXPLICIT", "*DYNAMIC, EXPLICIT, SCALE FACTOR=0.03"), encoding="utf-8")
    simulation = Simulation(read_model(path), compile_vfric(routine))
    simulation.run()
    time = np.array(simulation.samples.time)
    friction_force = np.array(simulation.samples.tangential)[:, 0]
    late = time > 1.5e-3
    force = friction_force[late]
    period, scatter = cycle(0.9 * normal, 0.5 * normal, stiffness, np.sqrt(stiffness / mass), speed)
    assert force.mean() == pytest.approx(0.5 * normal, rel=0.01)
    assert force.std() == pytest.approx(scatter, rel=0.02)
    up = np.flatnonzero(np.diff(np.signbit(force - force.mean() - 2.0)) == 1)
    starts = time[late][up][np.concatenate([[True], np.diff(time[late][up]) > 0.5 * period])]
    assert np.diff(starts).mean() == pytest.approx(period, rel=0.01)
