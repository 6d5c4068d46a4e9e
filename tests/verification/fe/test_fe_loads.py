"""Loads, supports, mass scaling, increments and relaxation with closed-form answers."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.fe.mesh import FACES


def mean_velocity(simulation) -> np.ndarray:  # type: ignore[no-untyped-def]
    """Velocity of the centre of mass."""
    mass = simulation.blocks.mass
    return mass @ simulation.nodes.v.reshape(-1, 3)[: mass.size] / mass.sum()


@pytest.mark.parametrize(
    "load",
    [
        "*CLOAD, AMPLITUDE=A\nTOP, 3, -0.5\n",
        "*DLOAD, AMPLITUDE=A\nHIGH, P2, 2.0\n",
        "*DSLOAD, AMPLITUDE=A\nCROWN, P, 2.0\n",
    ],
    ids=["CLOAD", "DLOAD", "DSLOAD"],
)
def test_free_cube_pushed_from_above_gains_the_impulse(tmp_path: Path, fe: ModuleType, load: str) -> None:
    """A force F a(t) on a free cube of mass m: v = F int a dt/m. 2 N by nodes (4 x 0.5) or by pressure on 1 mm2.

    Tolerance 0.1 %: the cube's face changes its area under 2 MPa on 1000 MPa (nu = 0, so hardly).
    """
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    period, rise, density = 4e-4, 1e-4, 1e-8
    text = (
        block.text() + "*SURFACE, TYPE=ELEMENT, NAME=CROWN\nE, S2\n*ELSET, ELSET=HIGH\n1,\n"
        + fe.elastic(1000.0, 0.0, density) + f"*AMPLITUDE, NAME=A\n0., 0., {rise}, 1.\n" + fe.step(period, load)
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    exact = -2.0 * (period - 0.5 * simulation.largest - 0.5 * rise) / density
    assert mean_velocity(simulation)[2] == pytest.approx(exact, rel=1e-3)


def test_smooth_step_velocity_moves_the_mount_by_its_exact_integral(tmp_path: Path, fe: ModuleType) -> None:
    """v = V (10 x^3 - 15 x^4 + 6 x^5), x = t/T: the distance is V T/2 whatever the increment. Tolerance 1e-12."""
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    text = (
        block.text() + fe.elastic(20.0, 0.3) + "*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., 1e-4, 1.\n"
        + fe.step(1e-4, "*BOUNDARY\nTOP, 1, 2\n*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=A\nTOP, 3, 3, 300.\n")
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    assert simulation.displacement()[block.top, 2] == pytest.approx(0.5 * 300.0 * 1e-4, rel=1e-12)


def test_laterally_held_element_relaxes_shear_and_volume_each_by_its_own_terms(tmp_path: Path, fe: ModuleType) -> None:
    """Oedometer: stress = e (K R_k(t) + 4/3 G R_g(t)) with k_i unlike g_i, for a strain that rises over t1.

    Tolerance 0.1 %: finite strain at 1e-4.
    """
    terms = [(0.3, 0.1, 2e-4), (0.2, 0.0, 2e-3), (0.1, 0.3, 5e-3), (0.05, 0.05, 2e-2), (0.05, 0.0, 1e-1)]
    modulus, ratio, strain, rise, period = 30.0, 0.4, 1e-4, 4e-4, 4e-3
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    prony = "*VISCOELASTIC, TIME=PRONY\n" + "".join(f"{g}, {k}, {tau}\n" for g, k, tau in terms)
    text = (
        block.text() + fe.elastic(modulus, ratio, extra=prony) + f"*AMPLITUDE, NAME=A\n0., 0., {rise}, 1.\n"
        + fe.step(period, "*BOUNDARY\nBOT, 1, 3\nTOP, 1, 2\n*BOUNDARY, AMPLITUDE=A\n", f"TOP, 3, 3, {-strain}\n")
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    assert simulation.blocks.terms == 5
    time = simulation.clock[1] - simulation.largest
    shear, bulk = modulus / (2.0 * (1.0 + ratio)), modulus / (3.0 * (1.0 - 2.0 * ratio))
    exact = 0.0
    for stiff, column in ((4.0 / 3.0 * shear, 0), (bulk, 1)):
        left = 1.0 - sum(term[column] for term in terms)
        exact += stiff * left
        for term in terms:
            tau = term[2]
            exact += stiff * term[column] * tau / rise * (np.exp(-(time - rise) / tau) - np.exp(-time / tau))
    assert -fe.held_force(simulation, block.top, 2) == pytest.approx(strain * exact, rel=1e-3)


def test_increment_of_a_nearly_incompressible_brick_follows_all_three_edges(tmp_path: Path, fe: ModuleType) -> None:
    """2/omega = 1/(c sqrt(1/a^2 + 1/b^2 + 1/h^2)) for nu -> 1/2, c the dilatational speed; l/c would be unstable.

    Tolerance 1 % at nu = 0.499: the bound leaves out what is of the order of G/K.
    """
    block = fe.brick(1, 1, 1, 1.0, 0.8, 0.5)
    modulus, ratio, density = 30.0, 0.499, 1e-9
    text = block.text() + fe.elastic(modulus, ratio, density) + fe.step(1e-5, "*BULK VISCOSITY\n0., 0.\n")
    simulation = fe.run(tmp_path, text)
    wave = np.sqrt(modulus * (1 - ratio) / ((1 + ratio) * (1 - 2 * ratio)) / density)
    exact = 1.0 / (wave * np.sqrt(1.0 + 1.0 / 0.64 + 4.0))
    found = 2.0 / np.sqrt(simulation.blocks.frequency_squared().max())
    assert found == pytest.approx(exact, rel=0.01)
    assert simulation.largest <= found


@pytest.mark.parametrize(
    ("scaling", "factor"),
    [("*FIXED MASS SCALING, FACTOR=4.\n", 2.0), ("*FIXED MASS SCALING, DT=3e-6, TYPE=UNIFORM\n", None)],
    ids=["FACTOR", "DT"],
)
def test_fixed_mass_scaling_lengthens_the_increment(
    tmp_path: Path, fe: ModuleType, scaling: str, factor: float | None
) -> None:
    """Four times the mass doubles the increment; DT= with UNIFORM makes DT the stable one. Exact to 1e-9."""
    block = fe.brick(2, 2, 2, 2.0, 2.0, 2.0)
    head = block.text() + fe.elastic(20.0, 0.47)
    plain = fe.run(tmp_path, head + fe.step(1e-4))
    scaled = fe.run(tmp_path, head + fe.step(1e-4, scaling))
    bare = 2.0 / np.sqrt(scaled.blocks.frequency_squared().max())
    expected = 3e-6 if factor is None else factor * 2.0 / np.sqrt(plain.blocks.frequency_squared().max())
    assert bare == pytest.approx(expected, rel=1e-9)


def test_two_steps_do_what_one_does(tmp_path: Path, fe: ModuleType) -> None:
    """A motion by total time, cut in two steps: the same end, to what other increments make (1e-4)."""
    block = fe.brick(3, 3, 3, 3.0, 3.0, 3.0)
    head = (
        block.text() + fe.elastic(20.0, 0.47, extra="*VISCOELASTIC, TIME=PRONY\n0.5, 0.5, 1e-4\n")
        + "*AMPLITUDE, NAME=A, TIME=TOTAL TIME, DEFINITION=SMOOTH STEP\n0., 0., 1e-3, 1.\n"
        + "*BOUNDARY\nBOT, 1, 3\nTOP, 1, 2\n"
    )  # fmt: skip
    move = "*BOUNDARY, TYPE=VELOCITY, AMPLITUDE=A\nTOP, 3, 3, -200.\n"
    one = fe.run(tmp_path, head + fe.step(1.2e-3, move))
    two = fe.run(tmp_path, head + fe.step(0.5e-3, move) + fe.step(0.7e-3))
    assert two.clock[0] == pytest.approx(1.2e-3, rel=1e-12)
    assert np.abs(one.displacement() - two.displacement()).max() < 1e-4 * np.abs(one.displacement()).max()


@pytest.mark.parametrize(
    "load",
    ["*CLOAD{}\nTOP, 3, -{}\n", "*DLOAD{}\nHIGH, P2, {}\n", "*DSLOAD{}\nCROWN, P, {}\n"],
    ids=["CLOAD", "DLOAD", "DSLOAD"],
)
@pytest.mark.parametrize("operation", ["", ", OP=NEW"], ids=["modified", "new"])
def test_load_given_again_in_a_later_step_takes_the_place_of_the_first(
    tmp_path: Path, fe: ModuleType, load: str, operation: str
) -> None:
    """A free cube under 1 for a time T and 2 for a time T: v = 3 T/m with a load of 1 each (1/4 at each node).

    Added instead of replaced it would be 4 T/m. An amplitude in step time in each of two steps is no fault when the
    second replaces the first. Tolerance 0.5 %, as half an increment at the end is 0.3 %.
    """
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    period, density = 2e-4, 1e-8
    first, second = ("0.25", "0.5") if "CLOAD" in load else ("1.0", "2.0")
    text = (
        block.text() + "*SURFACE, TYPE=ELEMENT, NAME=CROWN\nE, S2\n*ELSET, ELSET=HIGH\n1,\n"
        + fe.elastic(1000.0, 0.0, density) + "*AMPLITUDE, NAME=A\n0., 1., 1., 1.\n"
        + fe.step(period, load.format(", AMPLITUDE=A", first))
        + fe.step(period, load.format(", AMPLITUDE=A" + operation, second))
    )  # fmt: skip
    simulation = fe.run(tmp_path, text)
    assert mean_velocity(simulation)[2] == pytest.approx(-3.0 * period / density, rel=5e-3)


def test_load_on_another_place_in_a_later_step_comes_on_top(tmp_path: Path, fe: ModuleType) -> None:
    """OP=MOD leaves what it does not name: half the nodes at 0.25, then the other half too: v = (0.5 + 1) T/m."""
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    period, density = 2e-4, 1e-8
    a, b = block.top[:2] + 1, block.top[2:] + 1
    nodes = [f"{n}, 3, -0.25\n" for n in (*a, *b)]
    text = (
        block.text() + fe.elastic(1000.0, 0.0, density) + fe.step(period, "*CLOAD\n" + nodes[0] + nodes[1])
        + fe.step(period, "*CLOAD\n" + nodes[2] + nodes[3])
    )  # fmt: skip
    assert mean_velocity(fe.run(tmp_path, text))[2] == pytest.approx(-1.5 * period / density, rel=5e-3)


def test_step_time_amplitude_that_would_go_on_into_a_later_step_is_refused(tmp_path: Path, fe: ModuleType) -> None:
    """Nothing in the second step takes the load's place: its amplitude has no meaning there."""
    block = fe.brick(1, 1, 1, 1.0, 1.0, 1.0)
    text = (
        block.text() + fe.elastic(1000.0, 0.0) + "*AMPLITUDE, NAME=A\n0., 1., 1., 1.\n"
        + fe.step(1e-4, "*CLOAD, AMPLITUDE=A\nTOP, 3, 1.\n") + fe.step(1e-4)
    )  # fmt: skip
    with pytest.raises(InputError, match="STEP TIME"):
        fe.run(tmp_path, text)


def test_pressure_on_a_distorted_patch_gives_a_uniform_stress(tmp_path: Path, fe: ModuleType) -> None:
    """A cube of 3 x 3 x 3 elements with crooked faces under p on all sides: nodal forces balance the stress p exactly.

    The forces of a uniform Cauchy stress -p on the elements are -p V b summed over elements; those of the pressure are
    the integrals of the shape functions over the faces. By Gauss' theorem they are equal and opposite: 1e-12 of them.
    """
    from tread_validate.fe.blocks import mean_gradients
    from tread_validate.fe.step_kernel import pressure_loads

    block = fe.brick(3, 3, 3, 3.0, 3.0, 3.0)
    points = block.points + np.random.default_rng(3).uniform(-0.25, 0.25, block.points.shape)
    volume, gradients = mean_gradients(points[block.elements])
    inner = np.zeros_like(points)
    np.add.at(inner, block.elements, np.transpose(volume[:, None, None] * gradients, (0, 2, 1)))
    every = np.concatenate([block.elements[:, face] for face in FACES])
    labels = np.sort(every, axis=1)
    _, first, count = np.unique(labels, axis=0, return_index=True, return_counts=True)
    faces = np.ascontiguousarray(every[first[count == 1]])
    load = np.zeros(points.size)
    pressure_loads(
        faces, np.ones(len(faces)), np.full(len(faces), -1), np.zeros(1), points.ravel().copy(), np.zeros(points.size),
        load,
    )  # fmt: skip
    assert np.abs(load.reshape(-1, 3) + inner).max() < 1e-12 * np.abs(inner).max()
