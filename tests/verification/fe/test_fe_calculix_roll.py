"""An elastic block rocked and dragged on a Coulomb plane, against CalculiX on the same mesh."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import pytest

MODULUS, RATIO, MU = 16.0, 0.47, 0.4
PRESS, DRAG, ROCK = 0.05, 0.04, 0.006  # mm, mm, rad


def top_motion(block: object) -> list[tuple[int, float, float]]:
    """Displacement (x, z) of the mount's nodes at the end: pressed, rocked about the middle, dragged along x."""
    points = block.points  # type: ignore[attr-defined]
    return [(int(n) + 1, DRAG, -PRESS - ROCK * (float(points[n, 0]) - 12.5)) for n in block.top]  # type: ignore[attr-defined]


def test_elastic_block_rocked_with_coulomb_friction_carries_the_forces_that_calculix_gives(
    tmp_path: Path, fe: ModuleType
) -> None:
    """Same nodes, elements and proportional path; normal and tangential force within 5 %.

    CalculiX is static, small strain, with contact and friction by stiff springs; the engine is explicit, logarithmic,
    kinematic. Part of the face lifts off and part of the rest slips in both.
    """
    block = fe.brick(10, 8, 4, 25.0, 20.0, 8.0)
    motion = top_motion(block)
    plate = [
        (-20, -20, -5),
        (45, -20, -5),
        (45, 40, -5),
        (-20, 40, -5),
        (-20, -20, 0),
        (45, -20, 0),
        (45, 40, 0),
        (-20, 40, 0),
    ]
    static = (
        block.text() + f"*MATERIAL, NAME=M\n*ELASTIC\n{MODULUS}, {RATIO}\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
        + "*NODE, NSET=PLATE\n" + "".join(f"{9001 + i}, {x}., {y}., {z}.\n" for i, (x, y, z) in enumerate(plate))
        + "*ELEMENT, TYPE=C3D8, ELSET=P\n9001, " + ", ".join(str(9001 + i) for i in range(8))
        + "\n*MATERIAL, NAME=S\n*ELASTIC\n2e5, 0.3\n*SOLID SECTION, ELSET=P, MATERIAL=S\n"
        + "*SURFACE, TYPE=ELEMENT, NAME=ROAD\nP, S2\n*SURFACE INTERACTION, NAME=TOUCH\n"
        + f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1000., 1e-3\n*FRICTION\n{MU}, 100.\n"
        + "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nFACE, ROAD\n"
        + "*BOUNDARY\nPLATE, 1, 3\n*STEP, INC=1000\n*STATIC\n0.1, 1., 1e-6, 0.2\n*BOUNDARY\nTOP, 2, 2\n"
        + "".join(f"{n}, 1, 1, {x!r}\n{n}, 3, 3, {z!r}\n" for n, x, z in motion)
        + "*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF\n*END STEP\n"
    )  # fmt: skip
    other = fe.calculix(tmp_path, static)["TOP"]
    period = 4e-3
    explicit = (
        block.text() + fe.elastic(MODULUS, RATIO) + fe.plane() + fe.coulomb(MU)
        + f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {period}, 1.\n*BOUNDARY\nROADREF, 1, 6\nTOP, 2, 2\n"
        + fe.step(1.1 * period, "*BOUNDARY, AMPLITUDE=A\n"
                  + "".join(f"{n}, 1, 1, {x!r}\n{n}, 3, 3, {z!r}\n" for n, x, z in motion), fe.CONTACT)
    )  # fmt: skip
    simulation = fe.run(tmp_path, explicit)
    pair = simulation.pairs[0].pair
    assert (pair.slipping == 0).any()
    assert (pair.slipping == 2).any() or max(simulation.samples.slipping) > 0.02
    normal = pair.force.sum(axis=(0, 1))[2]
    along = pair.force.sum(axis=(0, 1))[0]
    assert normal == pytest.approx(-other[2], rel=0.05)
    assert along == pytest.approx(-other[0], rel=0.05)
