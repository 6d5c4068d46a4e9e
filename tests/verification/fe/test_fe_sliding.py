"""Sliding blocks: friction is mu N while all nodes slide, and no energy is lost on the way."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tread_validate.fe.energy import COLUMNS
from tread_validate.fe.explicit import Simulation

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
