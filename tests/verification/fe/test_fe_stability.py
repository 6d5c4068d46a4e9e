"""The stable increment: the mesh's highest frequency, and what happens on either side of the limit."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate.errors import EngineError
from tread_validate.fe.explicit import Simulation
from tread_validate.fe.model import read_model
from tread_validate.fe.stability import StableIncrement, multiply

TERMS = "*VISCOELASTIC, TIME=PRONY\n0.5, 0.5, 1e-3\n"


def text_of(fe: ModuleType, extra: str = "", keyword: str = "", element: str = "C3D8R") -> str:
    """A block of 6 x 5 x 4 mm with graded layers, held at the top, in free vibration."""
    block = fe.brick(6, 5, 4, 6.0, 5.0, 4.0)
    points = block.points.copy()
    points[:, 2] = 4.0 * (points[:, 2] / 4.0) ** 1.2
    graded = fe.Brick(points, block.elements)
    return (
        graded.text(element) + fe.elastic(20.0, 0.47, 1e-9, TERMS + extra) + "*BOUNDARY\nTOP, ENCASTRE\n"
        + "*INITIAL CONDITIONS, TYPE=VELOCITY\nBOT, 1, 100.\nBOT, 3, 100.\n"
        + fe.step(1e-3, "*BULK VISCOSITY\n0.06, 0.\n").replace("*DYNAMIC, EXPLICIT", "*DYNAMIC, EXPLICIT" + keyword)
    )  # fmt: skip


def started(fe: ModuleType, folder: Path, text: str) -> Simulation:
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    simulation = Simulation(read_model(path))
    simulation._begin(0, simulation.model.steps[0])
    return simulation


def highest(simulation: Simulation, displacement: NDArray[np.float64]) -> tuple[float, float]:
    """Highest frequency squared by the dense stiffness, and by Lanczos' method."""
    mass = simulation.blocks.mass
    free = np.ones(mass.size, dtype=bool)
    free[simulation.prescribed.dof // 3] = False
    own = StableIncrement(simulation.blocks, free)
    found = own.frequency_squared(displacement)
    size = 3 * mass.size
    dense = np.zeros((size, size))
    for k in range(size):
        unit = np.zeros(size)
        unit[k] = 1.0
        column = np.zeros((mass.size, 3))
        multiply(own.stiffness, unit.reshape(-1, 3), column)
        dense[:, k] = column.ravel()
    assert np.abs(dense - dense.T).max() < 1e-12 * np.abs(dense).max()
    root = own.root.ravel()
    return float(np.linalg.eigvalsh(root[:, None] * dense * root)[-1]), found


@pytest.mark.parametrize("element", ["C3D8R", "C3D8"])
@pytest.mark.parametrize("strain", [0.0, 0.1], ids=["as meshed", "squeezed by a tenth"])
def test_highest_frequency_is_that_of_the_whole_stiffness(
    tmp_path: Path, fe: ModuleType, strain: float, element: str
) -> None:
    """Lanczos' largest eigenvalue against the dense one: 0.5 %, which is 0.25 % of the increment; safety takes 5 %.

    Hourglass stiffness, which the dense matrix leaves out, adds less than a thousandth.
    """
    simulation = started(fe, tmp_path, text_of(fe, element=element))
    displacement = np.zeros((simulation.blocks.mass.size, 3))
    displacement[:, 2] = -strain * simulation.model.mesh.coordinates[:, 2]
    exact, found = highest(simulation, displacement)
    assert exact * (1.0 - 1e-9) <= found <= 1.005 * exact


@pytest.mark.parametrize("extra", ["", "*DAMPING, BETA=2e-7\n"], ids=["bulk viscosity", "and damping"])
def test_increment_just_below_the_limit_is_stable_and_just_above_is_not(
    tmp_path: Path, fe: ModuleType, extra: str
) -> None:
    """At 0.99 of the limit the vibration dies away: half way it has lost half its kinetic energy. At 1.03 it blows up.

    Just below the limit central differences swing the highest mode up before the viscosity takes it away.
    The automatic increment is 0.95 of the limit, and half as long again as the element by element one or more.
    """
    calm = fe.run(tmp_path, text_of(fe, extra, f", SCALE FACTOR={0.99 / 0.95}"))
    kinetic = np.array([row[6] for row in calm.samples.energy])
    assert kinetic[kinetic.size // 2 :].max() < 0.5 * calm.start_energy
    with pytest.raises(EngineError):
        fe.run(tmp_path, text_of(fe, extra, f", SCALE FACTOR={1.03 / 0.95}"))
    whole, single = (
        started(fe, tmp_path, text_of(fe, extra, word))
        for word in ("", ", ELEMENT BY ELEMENT")
    )  # fmt: skip
    ratio = whole.stable_increment(whole.model.steps[0]) / single.stable_increment(single.model.steps[0])
    assert 1.3 < ratio < 1.8


def test_increment_follows_the_highest_mode_to_another_place(tmp_path: Path, fe: ModuleType) -> None:
    """A squeeze that leaves one end of a long block while another grows at the far end, in forty looks.

    The increment stays within 2 % of that of a fresh search at every look; safety takes 5 %.
    """
    text = fe.brick(40, 2, 3, 40.0, 2.0, 3.0).text() + fe.elastic(20.0, 0.47, 1e-9, TERMS)
    simulation = started(fe, tmp_path, text + "*BOUNDARY\nTOP, ENCASTRE\n" + fe.step(1e-3))
    x, _, z = simulation.model.mesh.coordinates.T
    free = np.ones(x.size, dtype=bool)
    free[simulation.prescribed.dof // 3] = False
    followed = StableIncrement(simulation.blocks, free)
    worst = 0.0
    for share in np.linspace(0.0, 1.0, 41):
        local = (1.0 - share) * np.exp(-((x / 1.5) ** 2)) + share * np.exp(-(((x - x.max()) / 1.5) ** 2))
        displacement = np.zeros((x.size, 3))
        displacement[:, 2] = 0.3 * local * (z.max() - z)
        fresh = StableIncrement(simulation.blocks, free).increment(displacement)
        worst = max(worst, followed.increment(displacement) / fresh)
    assert worst < 1.02
