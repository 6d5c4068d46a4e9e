"""Exact answers of the element: constant stress, rigid rotation, relaxation."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tread_validate.fe.stress import element_stress

PRONY = [(0.25, 2e-4), (0.2, 2e-3), (0.15, 2e-2), (0.1, 2e-1)]
THETA0, C1, C2 = 22.0, 7.9241, 113.6
BOTH = pytest.mark.parametrize("element", ["C3D8R", "C3D8"])


@BOTH
def test_distorted_patch_under_linear_motion_has_one_stress_and_no_inner_force(
    tmp_path: Path, fe: ModuleType, element: str
) -> None:
    """Boundary nodes move as u = A X t/T and all nodes start with that velocity: the exact motion stays linear.

    Exact: inner nodes stay on A X (no net force) and every element has the same stress. Without bulk viscosity, whose
    pressure depends on the size of the element. Tolerance 1e-10: rounding of a few hundred increments, relative to the
    displacement and to the stress.
    """
    block = fe.brick(3, 3, 3, 3.0, 3.0, 3.0)
    rng = np.random.default_rng(1)
    inner = np.flatnonzero(np.all((block.points > 0) & (block.points < 3), axis=1))
    points = block.points.copy()
    points[inner] += rng.uniform(-0.25, 0.25, (inner.size, 3))
    block = fe.Brick(points, block.elements)
    gradient = np.array([[0.02, 0.01, -0.015], [0.005, -0.03, 0.02], [0.01, 0.0, 0.025]])
    period = 2e-4
    velocity = points @ gradient.T / period
    outer = np.setdiff1d(np.arange(len(points)), inner)
    rows = [f"{n + 1}, {d + 1}, {d + 1}, {float(velocity[n, d])!r}\n" for n in outer for d in range(3)]
    start = [f"{n + 1}, {d + 1}, {float(velocity[n, d])!r}\n" for n in range(len(points)) for d in range(3)]
    text = (
        block.text(element) + fe.elastic(20.0, 0.45)
        + "*INITIAL CONDITIONS, TYPE=VELOCITY\n" + "".join(start)
        + fe.step(period, "*BULK VISCOSITY\n0., 0.\n", "*BOUNDARY, TYPE=VELOCITY\n" + "".join(rows))
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    exact = points @ gradient.T
    assert np.abs(simulation.displacement() - exact).max() < 1e-10 * np.abs(exact).max()
    stress = element_stress(simulation)
    assert np.abs(stress).max() > 0.5
    assert np.ptp(stress, axis=0).max() < 1e-10 * np.abs(stress).max()


@BOTH
def test_block_turned_rigidly_through_two_radians_keeps_no_stress(tmp_path: Path, fe: ModuleType, element: str) -> None:
    """Exact: zero stress in a rigid rotation. Tolerance 1e-10 of E: rounding summed over the increments."""
    block = fe.brick(2, 2, 2, 2.0, 2.0, 2.0)
    period = 1e-3
    text = (
        block.text(element) + fe.elastic(20.0, 0.47)
        + "*NODE, NSET=REF\n900, 5., 3., -2.\n*RIGID BODY, REF NODE=900, TIE NSET=ALL\n"
        + fe.step(period, f"*BOUNDARY, TYPE=VELOCITY\nREF, 1, 3\nREF, 4, 4, {800.0!r}\nREF, 5, 5, {-500.0!r}\n"
                          f"REF, 6, 6, {1760.0!r}\n")
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    axis = np.array([800.0, -500.0, 1760.0]) * period
    assert np.linalg.norm(axis) > 1.9
    assert np.abs(element_stress(simulation)).max() < 1e-10 * 20.0
    moved = block.points + simulation.displacement()[: len(block.points)]
    diagonal = np.linalg.norm(block.points[0] - block.points[-1])
    assert np.linalg.norm(moved[0] - moved[-1]) == pytest.approx(diagonal, rel=1e-12)


@BOTH
@pytest.mark.parametrize("temperature", [22.0, 45.0])
def test_one_element_relaxes_as_the_relaxation_modulus(
    tmp_path: Path, fe: ModuleType, temperature: float, element: str
) -> None:
    """Strain e rises linearly over t1, then holds: force = A e/t1 int_{t-t1}^t E(s) ds, E shifted by the WLF law.

    Tolerance 0.1 %: the strain of 1e-4 makes finite-strain terms of that order, inertia is below 1e-5.
    """
    terms = "".join(f"{g}, {g}, {tau}\n" for g, tau in PRONY)
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    modulus, strain, rise, period = 30.0, 1e-4, 4e-4, 8e-3
    text = (
        block.text(element)
        + fe.elastic(modulus, 0.47, extra=f"*VISCOELASTIC, TIME=PRONY\n{terms}*TRS\n{THETA0}, {C1}, {C2}\n")
        + f"*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, {temperature}\n"
        + f"*AMPLITUDE, NAME=A\n0., 0., {rise}, 1.\n"
        + fe.step(period, "*BOUNDARY\nBOT, 3, 3\n1, 1, 2\n2, 2\n*BOUNDARY, AMPLITUDE=A\n", f"TOP, 3, 3, {-strain}\n")
    )
    simulation = fe.run(tmp_path, text)
    shift = 10.0 ** (-C1 * (temperature - THETA0) / (C2 + temperature - THETA0))
    time = simulation.clock[1] - simulation.largest
    exact = 1.0 - sum(g for g, _ in PRONY)
    for g, tau in PRONY:
        t = tau * shift
        exact += g * t / rise * (np.exp(-(time - rise) / t) - np.exp(-time / t))
    force = -fe.held_force(simulation, block.top, 2)
    assert force == pytest.approx(modulus * strain * exact, rel=1e-3)


def test_merged_slow_terms_keep_the_relaxation_modulus() -> None:
    """24 terms over ten decades, merged for a run of 15 ms: the modulus moves by less than 1e-6 of E_0 at any time."""
    from tread_validate.fe.material import Material
    from tread_validate.fe.relaxation import relaxation_of

    tau = np.logspace(-6, 4, 24)
    g = np.full(24, 0.035)
    material = Material("M", "here", 1e-9, 30.0, 0.47, True, np.column_stack([g, g, tau]), None)
    merged = relaxation_of(material, 20.0, 15e-3)
    time = np.concatenate([[0.0], np.logspace(-7, np.log10(15e-3), 200)])
    exact = 1.0 - g.sum() + np.exp(-np.multiply.outer(time, 1.0 / tau)) @ g
    assert merged.times.size < 16
    assert np.abs(merged.modulus(time) - exact).max() < 1e-6
