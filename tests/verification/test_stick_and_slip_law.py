"""One law of stick and slip (docs/friction.md) in the condensed face: a node on its own, then three that share a block.

Springs to the mount make the answers exact: a node of stiffness k is dragged by the road at the speed V.
"""

import numpy as np
import pytest

from tread_validate.friction import coulomb_law
from tread_validate.spring.condensed.inputs import (
    FREE,
    SLIP,
    STICK,
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

NORMAL, SHEAR, DEPTH, SPEED, DT = 3e5, 1e5, 1e-4, 0.1, 1e-5
FORCE = NORMAL * DEPTH


class Springs:
    """Nodes on springs (n, 3) x (n, 3) in N/m, pressed on to a plane that runs at a speed."""

    def __init__(self, stiffness, law, moduli=None):
        n = stiffness.shape[0] // 3
        terms = (np.zeros(1), np.ones(1)) if moduli is None else moduli
        solid = Solid(1.0, *terms)
        compliance = np.linalg.inv(stiffness).astype(np.float32)
        face = FaceNodes(np.full(n, 1e-6), np.zeros(n, dtype=np.int64), compliance)
        law = KernelLaw(law.static_coefficient, *law.kernel_arguments)
        self.scene = Scene(face, solid, RoadMotion(np.inf, 0.0), law, Solver(1e-9, 2000))
        pool = stiffness.astype(np.float32).ravel()
        self.windows = Windows(np.array([0, n]), np.array([[-1, 0]]), pool)
        self.state, self.work, self.n = fresh_state(n, terms[0].size), scratch(n, terms[0].size), n
        self.height = DEPTH
        start(self.pose(self.height), self.scene, self.state, self.work)

    def pose(self, height):
        face = np.column_stack([np.arange(self.n) * 1e-3, np.zeros(self.n), np.zeros(self.n)])
        return Pose(0.0, height, 0.0, face)

    def step(self, depth, speed, dt=DT):
        scene = self.scene._replace(road=RoadMotion(np.inf, speed))
        take_step(self.pose(-depth), dt, scene, self.windows, self.state, self.work)
        return self.state.force.copy(), self.state.code.copy()


def one(law, **more):
    return Springs(np.diag([SHEAR, NORMAL, SHEAR]), law, **more)


def dragged(block, steps, speed=SPEED, depth=DEPTH):
    force, code = zip(*(block.step(depth, speed) for _ in range(steps)), strict=True)
    return np.array(force), np.array(code)


def test_a_node_at_rest_stays_up_to_the_static_limit():
    """k V t <= mu_s N sticks, beyond it slips with mu_k N at once: exact step by step."""
    law = coulomb_law(0.5, 0.9)
    block = one(law)
    block.step(DEPTH, 0.0)
    force, code = dragged(block, 400)
    pull = SHEAR * SPEED * DT * np.arange(1, 401)
    holds = pull <= 0.9 * FORCE
    assert 100 < holds.sum() < 400
    assert np.all(code[holds, 0] == STICK)
    assert force[holds, 0, 0] == pytest.approx(pull[holds], rel=1e-5)
    assert np.all(code[~holds, 0] == SLIP)
    assert force[~holds, 0, 0] == pytest.approx(0.5 * FORCE, rel=1e-5)


def test_a_slipping_node_stops_when_its_speed_passes_zero_not_when_its_force_is_below_the_static_limit():
    """Slip goes on at mu_k N < mu_s N as long as the road runs; it ends when the road turns back."""
    block = one(coulomb_law(0.5, 0.9))
    block.step(DEPTH, 0.0)
    dragged(block, 400)
    _, code = dragged(block, 50)
    assert np.all(code == SLIP)
    force, code = dragged(block, 3, speed=-SPEED)
    assert np.all(code[:, 0] == STICK)
    expected = 0.5 * FORCE - SHEAR * SPEED * DT * np.arange(1, 4)
    assert force[:, 0, 0] == pytest.approx(expected, rel=1e-4)


def test_a_node_that_left_the_road_comes_back_at_rest():
    """After some time in the air (its recoil over) the static limit holds again."""
    block = one(coulomb_law(0.5, 0.9))
    block.step(DEPTH, 0.0)
    dragged(block, 400)
    for _ in range(2):
        _, code = block.step(-DEPTH, SPEED)
    assert code[0] == FREE
    force, code = block.step(DEPTH, 0.0)
    assert code[0] == STICK
    assert force[0, 0] == pytest.approx(0.0, abs=1e-9 * FORCE)


def test_relaxation_of_the_spring_relaxes_what_friction_can_hold():
    """A stuck node on a Maxwell spring slips when exp(-t/tau) N meets k V t-history: friction is mu times N of now."""
    block = one(coulomb_law(0.5, 0.5), moduli=(np.array([1.0]), np.array([2e-3])))
    block.step(DEPTH, 0.0)
    force, code = dragged(block, 600)
    slips = code[:, 0] == SLIP
    assert slips[-1]
    assert force[slips, 0, 0] == pytest.approx(0.5 * force[slips, 0, 1], rel=1e-5)


def chain(coupling=0.4):
    """Three nodes whose tangential springs pull at each other, normal springs on their own."""
    pulls = SHEAR * np.array([[1 + coupling, -coupling, 0], [-coupling, 1 + 2 * coupling, -coupling],
                              [0, -coupling, 1 + coupling]])  # fmt: skip
    stiffness = np.zeros((9, 9))
    stiffness[0::3, 0::3] = pulls
    stiffness[1::3, 1::3] = NORMAL * np.diag([1.0, 0.2, 1.0])
    stiffness[2::3, 2::3] = SHEAR * np.eye(3)
    return stiffness


@pytest.mark.parametrize("static", [0.5, 0.9])
def test_three_nodes_slip_one_after_the_other(static):
    """The lightly pressed middle node slips first and hands its load to its neighbours, which slip later.

    Exact: while the outer ones stick at u, the middle is at mu_k N_2 = S_22 q + S_21 2 u.
    """
    stiffness = chain()
    block = Springs(stiffness, coulomb_law(0.5, static))
    block.step(DEPTH, 0.0)
    speed = 0.99 * SPEED  # so that no step ends at the limit itself, where rounding would decide
    force, code = dragged(block, 500, speed)
    place = speed * DT * np.arange(1, 501)
    middle = SHEAR * place  # all three at one place: the coupling springs carry nothing
    holds = middle <= static * 0.2 * FORCE
    assert np.all(code[holds] == STICK)
    first = int(np.argmin(holds))
    assert list(code[first]) == [STICK, SLIP, STICK]
    both = [k for k in range(500) if list(code[k]) == [STICK, SLIP, STICK]]
    assert len(both) > 50
    q = (0.5 * 0.2 * FORCE + 0.8 * SHEAR * place[both]) / (1.8 * SHEAR)
    outer = 1.4 * SHEAR * place[both] - 0.4 * SHEAR * q
    assert force[both, 1, 0] == pytest.approx(0.5 * 0.2 * FORCE, rel=1e-4)
    assert force[both, 0, 0] == pytest.approx(outer, rel=1e-4)
    assert force[both, 2, 0] == pytest.approx(outer, rel=1e-4)
    assert outer[-1] <= static * FORCE * (1 + 1e-6)
    assert list(code[-1]) == [SLIP, SLIP, SLIP]
    assert force[-1, :, 0] == pytest.approx(0.5 * force[-1, :, 1], rel=1e-5)
