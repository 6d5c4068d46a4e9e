"""A rigid cylinder pressed into a viscoelastic half-space and drawn back, and one that rolls: the condensed face.

The face's compliance is that of the half-space in plane strain (Johnson, Contact Mechanics, 1985, section 2.7), so that
contact and memory of the condensed model meet closed forms: Hertz, Ting, Hunter.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from tread_validate.friction import coulomb_law
from tread_validate.spring.condensed.inputs import (
    FaceNodes,
    Pose,
    RoadMotion,
    Scene,
    Solid,
    Solver,
    Windows,
    fresh_state,
    scratch,
)
from tread_validate.spring.condensed.march import start, take_step
from tread_validate.spring.inputs import KernelLaw

sys.path.insert(0, str(Path(__file__).parent))
from half_space import DATUM, MODULUS, RADIUS, RELAXED, SLOW, Cylinder, ting

REACH = 4e-3


class HalfSpace:
    """Nodes `size` apart on a half-space (a metre wide, E/(1 - nu^2) of 1 Pa) above a cylinder, without friction."""

    def __init__(self, size, long_term, moduli, times, reach=REACH, datum=DATUM):
        self.x, self.datum = np.arange(-reach, reach + 0.5 * size, size), datum
        n = self.x.size
        compliance = np.zeros((3 * n, 3 * n))
        compliance[1::3, 1::3] = self.compliance(size)
        for axis in (0, 2):
            compliance[axis::3, axis::3] = np.eye(n)
        stiffness = np.linalg.inv(compliance)
        law = coulomb_law(0.0, 0.0)
        face = FaceNodes(np.full(n, size), np.zeros(n, dtype=np.int64), compliance.astype(np.float32))
        kernel_law = KernelLaw(law.static_coefficient, *law.kernel_arguments)
        self.scene = Scene(
            face, Solid(long_term, np.array(moduli), np.array(times)), RoadMotion(RADIUS, 0.0), kernel_law,
            Solver(1e-7, 5000),
        )  # fmt: skip
        self.windows = Windows(np.array([0, n]), np.array([[-1, 0]]), stiffness.astype(np.float32).ravel())
        self.state, self.work = fresh_state(n, len(moduli)), scratch(n, len(moduli))
        self.size = size

    def compliance(self, size):
        """Displacement at each node under a unit force per width, spread evenly over the strip of another."""
        apart = self.x[:, None] - self.x[None, :]
        high, low = apart + 0.5 * size, apart - 0.5 * size
        whole = high * (np.log(np.abs(high) / self.datum) - 1.0) - low * (np.log(np.abs(low) / self.datum) - 1.0)
        return -2.0 / (np.pi * size) * whole

    def pose(self, depth, x=0.0):
        return Pose(x, -depth, 0.0, np.column_stack([self.x, np.zeros_like(self.x), np.zeros_like(self.x)]))

    def press(self, depths, dt, travel=0.0):
        """Normal force per width, N/m, and half-width, m, at each depth; pressure of the last."""
        x = -travel * dt * len(depths) / 2
        start(self.pose(depths[0], x), self.scene, self.state, self.work)
        force, width = [], []
        for depth in depths[1:]:
            x += travel * dt
            take_step(self.pose(depth, x), dt, self.scene, self.windows, self.state, self.work)
            pressed = self.state.force[:, 1]
            force.append(pressed.sum())
            width.append(0.5 * self.size * np.count_nonzero(pressed > 0.0))
        return np.array(force), np.array(width), self.state.force[:, 1] / self.size


def test_an_elastic_half_space_carries_what_hertz_says():
    """P = pi E* a^2/(4 R), largest pressure sqrt(P E*/(pi R)), at the depth of 2 mm of half-width: 0.5 %, 1 %."""
    cylinder = Cylinder()
    face = HalfSpace(1e-4, MODULUS, [0.0], [1.0])
    force, width, pressure = face.press(np.linspace(-1e-7, cylinder.depth(2e-3), 40), 1e-3)
    assert force[-1] == pytest.approx(cylinder.load(2e-3) * MODULUS, rel=5e-3)
    assert width[-1] == pytest.approx(2e-3, abs=1e-4)
    assert pressure.max() == pytest.approx(np.sqrt(force[-1] * MODULUS / (np.pi * RADIUS)), rel=1e-2)


@pytest.mark.parametrize("period", [0.3 * SLOW, 3.0 * SLOW], ids=["fast", "slow"])
def test_cylinder_pressed_into_a_viscoelastic_half_space_and_drawn_back_feels_the_force_of_ting(period):
    """Depth as sin^2 in time: force within 1 % of its peak at every instant, and contact lost when Ting says, to 1 %.

    Ting, J. Appl. Mech. 33 (1966) 845-854: while the contact shrinks, only what went before it was last as wide counts.
    """
    time = np.linspace(0.0, period, 241)
    depth = Cylinder().depth(2e-3) * np.sin(np.pi * time / period) ** 2
    exact, lost = ting(time, depth)
    face = HalfSpace(1e-4, RELAXED, [MODULUS - RELAXED], [SLOW])
    force, _, _ = face.press(depth, time[1])
    peak = exact.max()
    assert force == pytest.approx(exact[1:], abs=1e-2 * peak)
    assert lost < 0.97 * period
    assert time[1:][force > 1e-3 * peak][-1] == pytest.approx(lost, abs=1e-2 * period)


@pytest.mark.parametrize(
    ("creep_time", "depth", "largest", "width"),
    [(0.0, 1.2474e-3, 60.32, 12.80), (0.009, 1.18e-3, 78.74, 9.92), (0.045, 9.238e-4, 84.72, 9.12)],
)
def test_rolling_viscoelastic_cylinder_has_the_pressure_of_hunters_problem(creep_time, depth, largest, width):
    """Wang and Knothe, J. Appl. Mech. 60 (1993) 310-317, at 600 N/mm by half-space theory (elements of 0.16 mm):
    largest pressure (MPa) 0.3 %, contact width (mm) 0.4, a node and a half.

    R 100 mm, 1 m/s; G 1143 MPa creeps to 571.5 MPa, so the modulus falls by half with half the creep time; nu 0.4.
    `depth` (m) is such that the load is near 600 N/mm; pressure and width go with its root.
    """
    stiff, size, speed = 2e6 * 1143.0 / 0.6, 4e-4, 1.0
    terms = ([0.5 * stiff], [0.5 * creep_time]) if creep_time else ([0.0], [1.0])
    face = HalfSpace(size, 0.5 * stiff, *terms, reach=0.028, datum=1.0)
    dt = 0.5 * size / speed
    force, _, pressure = face.press(depth * np.minimum(np.arange(-1, 180) / 30.0, 1.0), dt, speed)
    root = np.sqrt(6e5 / force[-1])
    assert root == pytest.approx(1.0, abs=0.02)
    top = np.argsort(pressure)[-5:]
    a, b, c = np.polyfit(face.x[top], pressure[top], 2)
    assert (c - b * b / (4.0 * a)) * root * 1e-6 == pytest.approx(largest, rel=3e-3)
    assert size * np.count_nonzero(pressure > 0.0) * root * 1e3 == pytest.approx(width, abs=0.4)
