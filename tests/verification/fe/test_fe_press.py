"""The static press of a tread block against CalculiX on the same nodes and elements, and the energies of a press."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tread_validate.fe.energy import COLUMNS

MODULUS, RATIO, DEPTH = 16.0, 0.47, 0.2
SMALL = 0.002  # mm: the engine has logarithmic strain, CalculiX runs linear
PERIOD = 3e-3
# Force of a 25 x 20 x 8 mm block at 0.2 mm, N: mesh, frictionless, bonded; CalculiX C3D8R of an earlier run
TABLE = [((10, 8, 4), 261.8, 374.5), ((20, 16, 8), 261.7, 369.7), ((40, 32, 13), 261.6, 368.8)]


def engine_force(fe: ModuleType, folder: Path, block: object, bonded: bool) -> float:
    """Force at DEPTH from a press by SMALL, slow enough to be static."""
    text = (
        block.text() + fe.elastic(MODULUS, RATIO)  # type: ignore[attr-defined]
        + f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {PERIOD}, 1.\n"
        + f"*BOUNDARY\nBOT, {'1' if bonded else '3'}, 3\nTOP, 1, 2\n"
        + fe.step(1.1 * PERIOD, f"*BOUNDARY, AMPLITUDE=A\nTOP, 3, 3, {-SMALL}\n")
    )  # fmt: skip
    simulation = fe.run(folder, text)
    energy = simulation.samples.energy[-1]
    assert energy[6] < 0.01 * energy[1], "kinetic energy under 1 % of internal on the plateau"
    assert energy[4] < 0.02 * energy[1], "artificial energy under 2 % of internal"
    return -fe.held_force(simulation, block.top, 2) * DEPTH / SMALL  # type: ignore[attr-defined]


def calculix_force(fe: ModuleType, folder: Path, block: object, bonded: bool) -> float:
    """The same press by CalculiX, linear."""
    text = (
        block.text()  # type: ignore[attr-defined]
        + f"*MATERIAL, NAME=M\n*ELASTIC\n{MODULUS}, {RATIO}\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
        + f"*STEP\n*STATIC\n*BOUNDARY\nBOT, {'1' if bonded else '3'}, 3\nTOP, 1, 2\nTOP, 3, 3, {-DEPTH}\n"
        + "*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF\n*END STEP\n"
    )
    return -float(fe.calculix(folder, text)["TOP"][2])


@pytest.mark.parametrize("row", [0, 1, pytest.param(2, marks=pytest.mark.heavy)], ids=["10x8x4", "20x16x8", "40x32x13"])
@pytest.mark.parametrize("bonded", [False, True], ids=["sliding", "bonded"])
def test_pressed_block_carries_the_force_that_calculix_gives(
    tmp_path: Path, fe: ModuleType, row: int, bonded: bool
) -> None:
    """Small displacement, same mesh, one-point elements on both sides; 1 %, the room for two hourglass controls.

    The table of the earlier CalculiX run is reproduced within 0.1 % by CalculiX here and 1 % by the engine.
    """
    mesh, sliding_table, bonded_table = TABLE[row]
    block = fe.brick(*mesh, 25.0, 20.0, 8.0)
    other = calculix_force(fe, tmp_path, block, bonded)
    force = engine_force(fe, tmp_path, block, bonded)
    expected = bonded_table if bonded else sliding_table
    assert other == pytest.approx(expected, rel=1e-3)
    assert force == pytest.approx(other, rel=0.01)


def test_energy_of_a_press_and_shear_is_the_work_done_on_it(tmp_path: Path, fe: ModuleType) -> None:
    """Viscoelastic block, pressed and rubbed on a plane: internal + friction + kinetic = work, within 0.01 %.

    Every term is summed on its own: internal energy by element from stress and strain, work from reactions and contact.
    """
    block = fe.brick(10, 8, 4, 25.0, 20.0, 8.0)
    prony = "*VISCOELASTIC, TIME=PRONY\n0.3, 0.3, 2e-4\n0.3, 0.3, 3e-3\n"
    text = (
        block.text() + fe.elastic(30.0, 0.47, extra=prony) + fe.plane() + fe.coulomb(0.5)
        + "*AMPLITUDE, NAME=DOWN, DEFINITION=SMOOTH STEP\n0., 0., 1e-3, 1.\n"
        + "*AMPLITUDE, NAME=ALONG, DEFINITION=SMOOTH STEP\n0., 0., 1e-3, 0., 3e-3, 1.\n"
        + "*BOUNDARY\nROADREF, 1, 6\nTOP, 2, 2\n"
        + fe.step(3.2e-3, "*BOUNDARY, AMPLITUDE=DOWN\nTOP, 3, 3, -0.3\n*BOUNDARY, AMPLITUDE=ALONG\nTOP, 1, 1, 3.\n",
                  fe.CONTACT, interval=1e-5)
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    energy = dict(zip(COLUMNS, np.array(simulation.samples.energy).T, strict=True))
    internal, artificial, frictional = energy["internal"], energy["artificial"], energy["frictional"]
    work, total = energy["external_work"], energy["total"]
    assert frictional[-1] > 0.2 * work[-1]
    assert np.abs(total).max() < 1e-4 * work.max()
    assert artificial[-1] < 0.02 * internal[-1]
