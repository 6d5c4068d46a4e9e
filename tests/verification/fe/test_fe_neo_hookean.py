"""The neo-Hookean law with Prony factors against closed forms, and the linear law as its limit."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from tread_validate.fe.energy import COLUMNS
from tread_validate.fe.explicit import Simulation
from tread_validate.fe.explicit_kernel import element_loop, gather_loop
from tread_validate.fe.model import read_model
from tread_validate.fe.stability import StableIncrement
from tread_validate.fe.stress import element_stress

Floats = NDArray[np.float64]
G, NU = 5.0, 0.47
K = 2.0 * G * (1.0 + NU) / (3.0 * (1.0 - 2.0 * NU))
PRONY = [(0.3, 2e-4), (0.3, 2e-3)]
BOTH = pytest.mark.parametrize("element", ["C3D8R", "C3D8"])
ORDER = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def neo_hookean(extra: str = "", density: float = 1e-9) -> str:
    return (
        f"*SOLID SECTION, ELSET=E, MATERIAL=M\n,\n*MATERIAL, NAME=M\n*DENSITY\n{density!r},\n"
        f"*HYPERELASTIC, NEO HOOKE, MODULI=INSTANTANEOUS\n{0.5 * G!r}, {2.0 / K!r}\n{extra}"
    )


def cauchy(f: Floats) -> Floats:
    """The closed form: J sigma = G dev B_bar + K J (J - 1) 1."""
    jacobian = np.linalg.det(f)
    b = f @ f.T * jacobian ** (-2.0 / 3.0)
    full = G * (b - np.trace(b) / 3.0 * np.eye(3)) / jacobian + K * (jacobian - 1.0) * np.eye(3)
    return np.array([full[i, j] for i, j in ORDER])


def moved(fe: ModuleType, element: str, f: Floats, material: str, period: float = 1e-3, hold: float = 0.0) -> str:
    """One element whose nodes are all taken to F X by a smooth step, then held."""
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    travel = block.points @ (f - np.eye(3)).T
    rows = "".join(f"{n + 1}, {d + 1}, {d + 1}, {float(travel[n, d])!r}\n" for n in range(8) for d in range(3))
    return (
        block.text(element) + material
        + f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {period}, 1.\n"
        + fe.step(period + hold, "*BULK VISCOSITY\n0., 0.\n", "*BOUNDARY, AMPLITUDE=A\n" + rows)
    )  # fmt: skip


@BOTH
@pytest.mark.parametrize(
    "f",
    [np.diag([1.4, 0.9, 0.85]), np.array([[1.0, 0.6, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])],
    ids=["stretch", "simple shear"],
)
def test_stress_and_energy_of_a_homogeneous_deformation_are_the_closed_form(
    tmp_path: Path, fe: ModuleType, element: str, f: Floats
) -> None:
    """Stress to rounding (the law is one of state); energy G/2 (I1_bar - 3) + K/2 (J - 1)^2 to 1e-5 (increments)."""
    simulation = fe.run(tmp_path, moved(fe, element, f, neo_hookean()))
    exact = cauchy(f)
    assert np.abs(element_stress(simulation)[0] - exact).max() < 1e-12 * np.abs(exact).max()
    energy = dict(zip(COLUMNS, simulation.samples.energy[-1], strict=True))
    jacobian = np.linalg.det(f)
    stored = 0.5 * G * (np.trace(f @ f.T) * jacobian ** (-2.0 / 3.0) - 3.0) + 0.5 * K * (jacobian - 1.0) ** 2
    assert energy["internal"] == pytest.approx(stored, rel=1e-5)
    assert energy["recoverable_strain"] == pytest.approx(stored, rel=1e-5)
    assert abs(energy["total"]) < 1e-5 * stored


def test_bar_under_tension_draws_in_as_the_closed_form_says(tmp_path: Path, fe: ModuleType) -> None:
    """Uniaxial stress at a stretch of 1.3: lateral stretch and force from the closed form with no lateral stress.

    Two planes of symmetry, two sides free; slow, so that what swings is below 0.1 % of the force.
    """
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    period, stretch = 2e-3, 1.3
    held = "".join(f"{n + 1}, {d + 1}\n" for n in range(8) for d in (0, 1) if block.points[n, d] == 0.0)
    pull = f"*BOUNDARY\nBOT, 3, 3\n{held}*BOUNDARY, AMPLITUDE=A\nTOP, 3, 3, {stretch - 1.0}\n"
    smooth = f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {period}, 1.\n"
    simulation = fe.run(tmp_path, block.text() + neo_hookean() + smooth + fe.step(1.5 * period, pull))
    side = brentq(lambda a: cauchy(np.diag([a, a, stretch]))[0], 0.7, 1.0)
    force = cauchy(np.diag([side, side, stretch]))[2] * side * side
    assert fe.held_force(simulation, block.top, 2) == pytest.approx(force, rel=1e-3)
    wide = np.ptp(block.points[:, 0] + simulation.displacement()[: len(block.points), 0])
    assert wide == pytest.approx(side, rel=1e-4)


@BOTH
def test_held_stretch_relaxes_deviator_and_mean_by_their_own_series(
    tmp_path: Path, fe: ModuleType, element: str
) -> None:
    """Kirchhoff stress = int R(t - s) d tau_0(s), deviator with g, mean with k: along fixed axes, 1e-5.

    The closed form's stress along the smooth step, convolved by quadrature.
    """
    period, hold = 4e-4, 3e-3
    f = np.diag([1.3, 0.9, 0.88])
    terms = "".join(f"{g}, {0.5 * g}, {tau}\n" for g, tau in PRONY)
    text = moved(fe, element, f, neo_hookean(f"*VISCOELASTIC, TIME=PRONY\n{terms}"), period, hold)
    simulation = fe.run(tmp_path, text)
    now = simulation.clock[1]

    def kirchhoff(time: float) -> Floats:
        q = min(time / period, 1.0)
        path = np.eye(3) + (f - np.eye(3)) * q**3 * (10.0 - 15.0 * q + 6.0 * q * q)
        return np.asarray(np.linalg.det(path) * cauchy(path)[:3])

    end = kirchhoff(now)
    shape, mean = end - end.mean(), end.mean()
    exact_shape = (1.0 - sum(g for g, _ in PRONY)) * shape
    exact_mean = (1.0 - sum(0.5 * g for g, _ in PRONY)) * mean
    for g, tau in PRONY:
        # by parts: int e^-(t-s)/tau d tau_0 = tau_0(t) - int tau_0(s) e^-(t-s)/tau ds/tau
        def faded(pick: object, tau: float = tau) -> float:
            ramp = quad(lambda s: pick(kirchhoff(s)) * np.exp(-(now - s) / tau) / tau, 0.0, period, epsabs=1e-13)[0]  # type: ignore[operator]
            held = pick(end) * (1.0 - np.exp(-(now - period) / tau))  # type: ignore[operator]
            return float(pick(end) - ramp - held)  # type: ignore[operator]

        exact_shape = exact_shape + g * np.array([faded(lambda t, i=i: t[i] - t.mean()) for i in range(3)])
        exact_mean += 0.5 * g * faded(lambda t: t.mean())
    found = element_stress(simulation)[0][:3] * np.linalg.det(f)
    assert np.abs(found - exact_shape - exact_mean).max() < 1e-5 * np.abs(found).max()


@BOTH
def test_small_strains_are_those_of_the_linear_law(tmp_path: Path, fe: ModuleType, element: str) -> None:
    """Same moduli and series, strains of 1e-5 along a path that turns: the stresses differ by terms of second order."""
    f = np.eye(3) + 1e-5 * np.array([[1.0, 2.0, -1.0], [0.0, -2.0, 1.0], [1.0, 0.5, 1.5]])
    series = "*VISCOELASTIC, TIME=PRONY\n" + "".join(f"{g}, {g}, {tau}\n" for g, tau in PRONY)
    stress = [
        element_stress(fe.run(tmp_path, moved(fe, element, f, material)))[0]
        for material in (neo_hookean(series), fe.elastic(2.0 * G * (1.0 + NU), NU, extra=series))
    ]
    assert np.abs(stress[0] - stress[1]).max() < 5e-5 * np.abs(stress[1]).max()


def simulation_of(folder: Path, text: str) -> Simulation:
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    simulation = Simulation(read_model(path))
    simulation._begin(0, simulation.model.steps[0])
    return simulation


def forces(simulation: Simulation, displacement: Floats) -> Floats:
    simulation.nodes.u[:-3] = displacement.ravel()
    element_loop(0, 1, 1.0, simulation.elements, simulation.nodes.u)
    gather_loop(0, 1, simulation.elements, simulation.nodes)
    return np.array(simulation.nodes.force[:-3])


@BOTH
def test_stress_turns_with_the_body(tmp_path: Path, fe: ModuleType, element: str) -> None:
    """F = R U gives R sigma(U) R^T, to rounding."""
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    simulation = simulation_of(tmp_path, block.text(element) + neo_hookean() + fe.step(1e-3))
    turn = Rotation.from_rotvec([0.8, -0.5, 1.7]).as_matrix()
    f = turn @ np.array([[1.2, 0.1, 0.0], [0.1, 0.9, -0.1], [0.0, -0.1, 0.95]])
    forces(simulation, block.points @ (f - np.eye(3)).T)
    exact = cauchy(f)
    assert np.abs(element_stress(simulation)[0] - exact).max() < 1e-12 * np.abs(exact).max()


@BOTH
@pytest.mark.parametrize("stretch", [0.7, 1.0, 1.5])
def test_highest_frequency_of_the_tangent_is_within_the_bound(
    tmp_path: Path, fe: ModuleType, element: str, stretch: float
) -> None:
    """The kernels' own tangent by central differences at a stretch: the bound is above it, by less than a third.

    Free nodes of a block held at its top, volume kept but for 2 %.
    """
    block = fe.brick(3, 3, 2, 3.0, 3.0, 2.0)
    text = (
        block.text(element) + neo_hookean() + "*BOUNDARY\nTOP, ENCASTRE\n" + fe.step(1e-3, "*BULK VISCOSITY\n0., 0.\n")
    )
    simulation = simulation_of(tmp_path, text)
    side = np.sqrt(1.02 / stretch)
    place = block.points * (np.array([side, stretch, side]) - 1.0)
    free = np.ones(len(block.points), dtype=bool)
    free[block.top] = False
    bound = StableIncrement(simulation.blocks, free).frequency_squared(place)
    mass = np.repeat(simulation.blocks.mass, 3)
    at = np.flatnonzero(np.repeat(free, 3))
    tangent = np.zeros((at.size, at.size))
    for column, dof in enumerate(at):
        step = np.zeros(place.size)
        step[dof] = 1e-6
        up, down = (forces(simulation, place + sign * step.reshape(-1, 3)) for sign in (1.0, -1.0))
        tangent[:, column] = (up - down)[at] / 2e-6
    root = 1.0 / np.sqrt(mass[at])
    matrix = root[:, None] * tangent * root
    highest = float(np.linalg.eigvalsh(0.5 * (matrix + matrix.T))[-1])
    assert highest < bound * (1.0 + 1e-6)
    assert bound < 1.34 * highest


def test_wide_vibration_just_below_the_limit_dies_away(tmp_path: Path, fe: ModuleType) -> None:
    """Free vibration at strains beyond 0.1, at 0.99 of the limit: balanced to 1 %, and half gone half way."""
    block = fe.brick(5, 4, 3, 6.0, 5.0, 4.0)
    text = (
        block.text() + neo_hookean("*VISCOELASTIC, TIME=PRONY\n0.5, 0.5, 1e-4\n")
        + "*BOUNDARY\nTOP, ENCASTRE\n*INITIAL CONDITIONS, TYPE=VELOCITY\nBOT, 1, 3e4\n"
        + fe.step(1e-3, "*BULK VISCOSITY\n0.06, 0.\n").replace("CIT", f"CIT, SCALE FACTOR={0.99 / 0.95}")
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    energy = np.array(simulation.samples.energy)
    kinetic, total = (energy[:, COLUMNS.index(name)] for name in ("kinetic", "total"))
    assert simulation.strain > 0.1
    assert kinetic[kinetic.size // 2 :].max() < 0.5 * simulation.start_energy
    assert np.abs(total).max() < 0.01 * simulation.start_energy
