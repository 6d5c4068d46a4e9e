"""C3D8, the fully integrated element: CalculiX on the same mesh, no locking, and meshes of both elements."""

from __future__ import annotations

import re
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.typing import NDArray

from tread_validate.errors import EngineError
from tread_validate.fe.energy import COLUMNS
from tread_validate.fe.explicit import Simulation
from tread_validate.fe.model import read_model
from tread_validate.fe.stability import StableIncrement, multiply
from tread_validate.fe.stress import element_stress

Floats = NDArray[np.float64]
SHEAR = 5.0


def crooked(fe: ModuleType, *sizes: float) -> object:
    """A brick whose inner nodes and inner nodes of its faces are off their places."""
    block = fe.brick(*sizes)
    points = block.points.copy()
    rng = np.random.default_rng(5)
    extent = np.array(sizes[3:])
    shift = rng.uniform(-0.15, 0.15, points.shape) * extent / np.array(sizes[:3])
    points += np.where((points > 0) & (points < extent), shift, 0.0)
    return fe.Brick(points, block.elements)


def simulation_of(folder: Path, text: str) -> Simulation:
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    simulation = Simulation(read_model(path))
    simulation._begin(0, simulation.model.steps[0])
    return simulation


def stiffness(simulation: Simulation) -> Floats:
    """The stiffness from which the stable increment is taken, (3 n, 3 n)."""
    size = 3 * simulation.blocks.mass.size
    own = StableIncrement(simulation.blocks, np.ones(size // 3, dtype=bool))
    own._deform(np.zeros((size // 3, 3)))
    dense = np.zeros((size, size))
    for k in range(size):
        unit = np.zeros(size)
        unit[k] = 1.0
        column = np.zeros((size // 3, 3))
        multiply(own.stiffness, unit.reshape(-1, 3), column)
        dense[:, k] = column.ravel()
    return dense


def forces(simulation: Simulation, displacement: Floats) -> Floats:
    """Internal forces of the element kernels after one increment to a displacement (n, 3)."""
    from tread_validate.fe.explicit_kernel import element_loop, gather_loop

    simulation.nodes.u[:-3] = displacement.ravel()
    element_loop(0, 1, 1.0, simulation.elements, simulation.nodes.u)
    gather_loop(0, 1, simulation.elements, simulation.nodes)
    return np.array(simulation.nodes.force[:-3])


@pytest.mark.parametrize("element", ["C3D8R", "C3D8"])
def test_forces_of_small_displacements_are_the_stiffness_of_the_stable_increment(
    tmp_path: Path, fe: ModuleType, element: str
) -> None:
    """Displacements of 1e-7: the kernels' forces are K u, but for terms of second order; both elements, crooked mesh.

    Without hourglass stiffness, which K leaves out; tolerance 1e-5.
    """
    block = crooked(fe, 3, 2, 2, 3.0, 2.0, 2.0)
    text = (
        block.text(element)  # type: ignore[attr-defined]
        + fe.elastic(20.0, 0.49).replace("MATERIAL=M", "MATERIAL=M, CONTROLS=C")
        + "*SECTION CONTROLS, NAME=C\n0.,\n"
        + fe.step(1e-3, "*BULK VISCOSITY\n0., 0.\n")
    )
    simulation = simulation_of(tmp_path, text)
    displacement = 1e-7 * np.random.default_rng(2).standard_normal(block.points.shape)  # type: ignore[attr-defined]
    exact = stiffness(simulation) @ displacement.ravel()
    assert np.abs(forces(simulation, displacement) - exact).max() < 1e-5 * np.abs(exact).max()


def tip(fe: ModuleType, folder: Path, block: object, ratio: float, load: float = 1e-3) -> tuple[float, float]:
    """Mean deflection along z of the free end of a cantilever along x under an end load: engine and CalculiX."""
    points = block.points  # type: ignore[attr-defined]
    length = points[:, 0].max()
    held, end = np.flatnonzero(points[:, 0] == 0.0), np.flatnonzero(points[:, 0] == length)
    modulus = 2.0 * SHEAR * (1.0 + ratio)
    simulation = simulation_of(
        folder,
        block.text("C3D8") + fe.elastic(modulus, ratio) + fe.step(1e-3),  # type: ignore[attr-defined]
    )
    dense = stiffness(simulation)
    free = np.setdiff1d(np.arange(3 * len(points)), (3 * held[:, None] + np.arange(3)).ravel())
    push = np.zeros(3 * len(points))
    push[3 * end + 2] = load / end.size
    found = np.zeros(3 * len(points))
    found[free] = np.linalg.solve(dense[np.ix_(free, free)], push[free])
    sets = "*NSET, NSET=HELD\n" + "".join(f"{n + 1},\n" for n in held)
    sets += "*NSET, NSET=TIP\n" + "".join(f"{n + 1},\n" for n in end)
    text = (
        block.text("C3D8") + sets  # type: ignore[attr-defined]
        + f"*MATERIAL, NAME=M\n*ELASTIC\n{modulus}, {ratio}\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
        + "*BOUNDARY\nHELD, 1, 3\n*STEP\n*STATIC\n*CLOAD\n" + f"TIP, 3, {load / end.size:.12g}\n"
        + "*NODE PRINT, NSET=TIP\nU\n*END STEP\n"
    )  # fmt: skip
    fe.calculix(folder, text)
    rows = re.findall(r"^\s+(\d+)((?:\s+[-+0-9.E]+){3})\s*$", (folder / "ccx.dat").read_text(), re.M)
    other = float(np.mean([float(values.split()[2]) for _, values in rows]))
    return float(found[3 * end + 2].mean()), other


def test_distortion_of_crooked_elements_is_resisted_as_in_calculix(tmp_path: Path, fe: ModuleType) -> None:
    """A bent bar, C3D8 on both sides, nu = -0.999: hardly any stiffness of volume, where CalculiX integrates fully.

    Then both are one element; 3e-4 is what is left of the volume (K/G = 7e-4).
    """
    own, other = tip(fe, tmp_path, crooked(fe, 6, 2, 2, 12.0, 2.0, 2.0), -0.999)
    assert own == pytest.approx(other, rel=3e-4)


def test_bent_bar_does_not_lock_as_it_becomes_incompressible(tmp_path: Path, fe: ModuleType) -> None:
    """Same shear modulus, nu from 0.49 to 0.4999: deflection is as 1/E, within 0.5 %; without the mean dilatation of
    the element it falls to a seventh, which CalculiX's C3D8 shows.
    """
    block = crooked(fe, 6, 2, 2, 12.0, 2.0, 2.0)
    soft, _ = tip(fe, tmp_path, block, 0.49)
    hard, locked = tip(fe, tmp_path, block, 0.4999)
    assert hard == pytest.approx(soft * 1.49 / 1.4999, rel=5e-3)
    assert locked < 0.1 * hard


def press(fe: ModuleType, block: object, ratio: float, element: str) -> tuple[str, str]:
    """A bonded block pressed by 0.002 mm: for the engine, slowly, and for CalculiX, linear."""
    period = 3e-3
    own = (
        block.text(element) + fe.elastic(16.0, ratio)  # type: ignore[attr-defined]
        + f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {period}, 1.\n*BOUNDARY\nBOT, 1, 3\nTOP, 1, 2\n"
        + fe.step(1.1 * period, "*BOUNDARY, AMPLITUDE=A\nTOP, 3, 3, -0.002\n")
    )  # fmt: skip
    other = (
        block.text("C3D8I")  # type: ignore[attr-defined]
        + f"*MATERIAL, NAME=M\n*ELASTIC\n16., {ratio}\n*SOLID SECTION, ELSET=E, MATERIAL=M\n"
        + "*STEP\n*STATIC\n*BOUNDARY\nBOT, 1, 3\nTOP, 1, 2\nTOP, 3, 3, -0.002\n"
        + "*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF\n*END STEP\n"
    )
    return own, other


def test_pressed_block_comes_to_what_incompatible_modes_carry(tmp_path: Path, fe: ModuleType) -> None:
    """A bonded block of 25 x 20 x 8 mm, nu = 0.499: C3D8 of the engine against C3D8I of CalculiX, both free of locking,
    in their own ways. 8.6 % apart on 5 x 4 x 2 elements, 2.8 % on 10 x 8 x 4 (1.0 % on 20 x 16 x 8).
    """
    apart = []
    for mesh in ((5, 4, 2), (10, 8, 4)):
        block = fe.brick(*mesh, 25.0, 20.0, 8.0)
        own, other = press(fe, block, 0.499, "C3D8")
        simulation = fe.run(tmp_path, own)
        energy = dict(zip(COLUMNS, simulation.samples.energy[-1], strict=True))
        assert energy["artificial"] == 0.0
        assert energy["kinetic"] < 0.01 * energy["internal"]
        force = fe.held_force(simulation, block.top, 2)
        apart.append(abs(force / float(fe.calculix(tmp_path, other)["TOP"][2]) - 1.0))
    assert apart[1] < 0.03
    assert apart[1] < 0.4 * apart[0]


def rubbed(fe: ModuleType, text: str) -> str:
    """A viscoelastic block, pressed on a plane and rubbed along it."""
    prony = "*VISCOELASTIC, TIME=PRONY\n0.3, 0.3, 2e-4\n0.3, 0.3, 3e-3\n"
    return (
        text + fe.elastic(30.0, 0.47, extra=prony) + fe.plane() + fe.coulomb(0.5)
        + "*AMPLITUDE, NAME=DOWN, DEFINITION=SMOOTH STEP\n0., 0., 1e-3, 1.\n"
        + "*AMPLITUDE, NAME=ALONG, DEFINITION=SMOOTH STEP\n0., 0., 1e-3, 0., 3e-3, 1.\n"
        + "*BOUNDARY\nROADREF, 1, 6\nTOP, 2, 2\n"
        + fe.step(3.2e-3, "*BOUNDARY, AMPLITUDE=DOWN\nTOP, 3, 3, -0.3\n*BOUNDARY, AMPLITUDE=ALONG\nTOP, 1, 1, 3.\n",
                  fe.CONTACT, interval=1e-5)
    )  # fmt: skip


def mixed(block: object) -> str:
    """Elements of even numbers as C3D8, of odd ones as C3D8R."""
    lines = block.text("C3D8R").split("*ELEMENT, TYPE=C3D8R, ELSET=E\n")  # type: ignore[attr-defined]
    rows, rest = lines[1].split("*NSET", 1)
    elements = rows.splitlines()
    odd, even = ("\n".join(elements[first::2]) for first in (0, 1))
    return f"{lines[0]}*ELEMENT, TYPE=C3D8R, ELSET=E\n{odd}\n*ELEMENT, TYPE=C3D8, ELSET=E\n{even}\n*NSET{rest}"


@pytest.mark.parametrize("mesh", ["C3D8", "C3D8 and C3D8R"])
def test_energy_of_a_pressed_and_rubbed_block_is_the_work_done_on_it(tmp_path: Path, fe: ModuleType, mesh: str) -> None:
    """Internal + friction + kinetic = work, within 0.01 % of it; full integration alone, both elements mixed."""
    block = fe.brick(10, 8, 4, 25.0, 20.0, 8.0)
    simulation = fe.run(tmp_path, rubbed(fe, block.text("C3D8") if mesh == "C3D8" else mixed(block)))
    energy = dict(zip(COLUMNS, np.array(simulation.samples.energy).T, strict=True))
    assert energy["frictional"][-1] > 0.2 * energy["external_work"][-1]
    assert np.abs(energy["total"]).max() < 1e-4 * energy["external_work"].max()
    assert (energy["artificial"][-1] == 0.0) == (mesh == "C3D8")
    assert energy["viscoelastic_dissipation"][-1] > 0.0


def test_crooked_patch_of_both_elements_has_one_stress(tmp_path: Path, fe: ModuleType) -> None:
    """Linear motion of a patch in which C3D8R and C3D8 are neighbours: one stress in all of them, to rounding."""
    block = crooked(fe, 3, 3, 3, 3.0, 3.0, 3.0)
    text = mixed(block) + fe.elastic(20.0, 0.45) + fe.step(1e-3)
    simulation = simulation_of(tmp_path, text)
    gradient = np.array([[0.02, 0.01, -0.015], [0.005, -0.03, 0.02], [0.01, 0.0, 0.025]])
    forces(simulation, block.points @ gradient.T)  # type: ignore[attr-defined]
    stress = element_stress(simulation)
    assert np.ptp(stress, axis=0).max() < 1e-12 * np.abs(stress).max()


def test_increment_just_below_the_limit_is_stable_and_just_above_is_not(tmp_path: Path, fe: ModuleType) -> None:
    """C3D8 in free vibration at 0.99 of the limit dies away, at 1.03 of it it blows up."""
    block = crooked(fe, 5, 4, 3, 6.0, 5.0, 4.0)

    def text(scale: float) -> str:
        return (
            block.text("C3D8")  # type: ignore[attr-defined]
            + fe.elastic(20.0, 0.47, 1e-9, "*VISCOELASTIC, TIME=PRONY\n0.5, 0.5, 1e-3\n")
            + "*BOUNDARY\nTOP, ENCASTRE\n*INITIAL CONDITIONS, TYPE=VELOCITY\nBOT, 1, 100.\nBOT, 3, 100.\n"
            + fe.step(1e-3, "*BULK VISCOSITY\n0.06, 0.\n").replace("CIT", f"CIT, SCALE FACTOR={scale / 0.95}")
        )

    calm = fe.run(tmp_path, text(0.99))
    kinetic = np.array([row[6] for row in calm.samples.energy])
    assert kinetic[kinetic.size // 2 :].max() < 0.5 * calm.start_energy
    with pytest.raises(EngineError):
        fe.run(tmp_path, text(1.03))
