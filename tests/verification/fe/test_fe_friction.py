"""Friction: VFRIC against the built-in law, and against closed-form motion."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from tread_validate.errors import InputError

CONSTANT = "      fTangential(1,k) = -min(props(1)*fNormal(k), fStickForce(k))"
# mu = props(1) + props(2) v
RISING = """      fmu = props(1) + props(2)*v
      fTangential(1,k) = -min(fmu*fNormal(k), fStickForce(k))"""


def rolled(fe: ModuleType, folder: Path, friction: str, vfric: str | None, threads: int = 1):  # type: ignore[no-untyped-def]
    """A flat block carried straight over the crest of a wheel that turns 2 % faster."""
    block = fe.brick(10, 4, 4, 20.0, 8.0, 8.0)
    speed, radius, low = 5000.0, 200.0, -0.15
    moved = fe.Brick(block.points - [40.0, 0.0, 0.0], block.elements)
    text = (
        moved.text() + fe.elastic(20.0, 0.47) + fe.wheel(radius, low) + friction
        + "*BOUNDARY\nROADREF, 1, 4\nROADREF, 6, 6\nTOP, 2, 3\n"
        + f"*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, {speed}\nROADREF, 5, {1.02 * speed / radius}\n"
        + fe.step(60.0 / speed, f"*BOUNDARY, TYPE=VELOCITY\nTOP, 1, 1, {speed}\n"
                                f"ROADREF, 5, 5, {1.02 * speed / radius}\n", fe.CONTACT)
    )  # fmt: skip
    return fe.run(folder, _one_by_one(text), vfric, threads)


def _one_by_one(text: str) -> str:
    """The increment of the elements one by one: the same for a whole block and its half."""
    return text.replace("*DYNAMIC, EXPLICIT", "*DYNAMIC, EXPLICIT, ELEMENT BY ELEMENT")


def test_constant_coefficient_by_vfric_equals_built_in_friction(tmp_path: Path, fe: ModuleType) -> None:
    """The same law twice: forces agree to 1e-9 of their peak (they differ by rounding at most)."""
    built_in = rolled(fe, tmp_path, fe.coulomb(0.3), None)
    user = rolled(fe, tmp_path, fe.user_friction(0.3), CONSTANT)
    for name in ("normal", "tangential"):
        a, b = np.array(getattr(built_in.samples, name)), np.array(getattr(user.samples, name))
        assert np.abs(a).max() > 1.0
        assert np.abs(a - b).max() < 1e-9 * np.abs(a).max()
    assert max(built_in.samples.slipping) > 0.05, "some of the contact slips"


def test_a_disc_made_by_revolution_is_the_plane_made_by_sweeping(tmp_path: Path, fe: ModuleType) -> None:
    """Pressed, rubbed and slipping: forces agree to 1e-9 of their peak, wherever the disc's axis stands, even under
    the block.
    """
    block, period = fe.brick(4, 3, 2, 8.0, 6.0, 4.0), 4e-4
    found = []
    for road in (fe.plane(), fe.disc((2.0, 3.0)), fe.disc((-7.0, 1.5))):
        text = (
            block.text() + fe.elastic(20.0, 0.47) + road + fe.coulomb(0.3)
            + f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {0.5 * period}, 1.\n"
            + "*BOUNDARY\nROADREF, 1, 6\nTOP, 2, 2\n"
            + fe.step(period, "*BOUNDARY, AMPLITUDE=A\nTOP, 1, 1, 0.2\nTOP, 3, 3, -0.1\n", fe.CONTACT)
        )  # fmt: skip
        found.append(fe.run(tmp_path, text).samples)
    for name in ("normal", "tangential"):
        plane, *discs = (np.array(getattr(samples, name)) for samples in found)
        for disc in discs:
            assert np.abs(disc - plane).max() < 1e-9 * np.abs(plane).max()
    assert max(found[0].slipping) > 0.05


@pytest.mark.parametrize(("mu0", "slope"), [(0.4, 0.0), (0.2, 1.5e-5)], ids=["constant", "rising with speed"])
def test_thrown_block_slows_down_as_its_equation_of_motion_says(
    tmp_path: Path, fe: ModuleType, mu0: float, slope: float
) -> None:
    """A block of height h under pressure p slides along a plane: dv/dt = -mu(v) p/(rho h), mu = mu0 + slope v.

    Exact for a pressure that rises smoothly over t1 (its integral is p (t - t1/2)): v = v0 - mu0 P, or
    (v0 + mu0/slope) exp(-slope P) - mu0/slope, with P = p (t - t1/2)/(rho h). Tolerance 0.1 % of the loss of speed,
    in the mean velocity of the block's mass: the block swings in shear, which the mean does not see.
    """
    length, width, height, density, pressure, speed = 20.0, 4.0, 2.0, 1e-9, 0.2, 10000.0
    period, rise = 1.2e-4, 3e-5
    block = fe.brick(20, 4, 2, length, width, height)
    text = (
        block.text() + fe.elastic(200.0, 0.3, density) + fe.plane()
        + "*ELSET, ELSET=HIGH\n"
        + "".join(f"{i + 1},\n" for i, e in enumerate(block.elements) if np.isin(e[4:], block.top).all())
        + (fe.coulomb(mu0) if slope == 0.0 else fe.user_friction(mu0, slope))
        + f"*AMPLITUDE, NAME=A, DEFINITION=SMOOTH STEP\n0., 0., {rise}, 1.\n"
        + f"*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, {speed}\n*BOUNDARY\nROADREF, 1, 6\n"
        + fe.step(period, f"*DLOAD, AMPLITUDE=A\nHIGH, P2, {pressure}\n", fe.CONTACT)
    )  # fmt: skip
    simulation = fe.run(tmp_path, text, None if slope == 0.0 else RISING)
    mass = simulation.blocks.mass
    velocity = simulation.nodes.v.reshape(-1, 3)[: mass.size, 0]
    mean = float(mass @ velocity / mass.sum())
    # the velocity lives half an increment before the end
    impulse = pressure * (period - 0.5 * simulation.largest - 0.5 * rise) / (density * height)
    exact = speed - mu0 * impulse
    if slope:
        exact = (speed + mu0 / slope) * np.exp(-slope * impulse) - mu0 / slope
    assert speed - mean == pytest.approx(speed - exact, rel=1e-3)
    assert mean == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize(
    "body",
    [
        "      fTangential(1,k) = -2.d0*fStickForce(k)",
        "      fTangential(1,k) = fNormal(k)",
        "      fTangential(1,k) = 0.d0/(p-p)",
    ],
    ids=["more than sticks", "pushes", "not a number"],
)
def test_force_out_of_range_stops_with_the_node(tmp_path: Path, fe: ModuleType, body: str) -> None:
    """fTangential(1,k) lies between 0 and -fStickForce(k); anything else stops the run."""
    with pytest.raises(InputError, match=r"vfric\.f: VFRIC at .* node \d+"):
        rolled(fe, tmp_path, fe.user_friction(0.3), body)


def test_half_block_with_symmetry_gives_half_the_force(tmp_path: Path, fe: ModuleType) -> None:
    """YSYMM on the middle plane of the rolled block: twice the half's force is the whole's, to 1e-8 of the peak."""
    whole = rolled(fe, tmp_path, fe.coulomb(0.3), None)
    speed, radius, low = 5000.0, 200.0, -0.15
    block = fe.brick(10, 2, 4, 20.0, 4.0, 8.0)
    moved = fe.Brick(block.points - [40.0, 0.0, 0.0], block.elements)
    middle = np.flatnonzero(block.points[:, 1] == 4.0)
    text = (
        moved.text() + "*NSET, NSET=MID\n" + "".join(f"{n + 1},\n" for n in middle) + fe.elastic(20.0, 0.47)
        + fe.wheel(radius, low) + fe.coulomb(0.3)
        + "*BOUNDARY\nROADREF, 1, 4\nROADREF, 6, 6\nTOP, 2, 3\nMID, YSYMM\n"
        + f"*INITIAL CONDITIONS, TYPE=VELOCITY\nALL, 1, {speed}\nROADREF, 5, {1.02 * speed / radius}\n"
        + fe.step(60.0 / speed, f"*BOUNDARY, TYPE=VELOCITY\nTOP, 1, 1, {speed}\n"
                                f"ROADREF, 5, 5, {1.02 * speed / radius}\n", fe.CONTACT)
    )  # fmt: skip
    half = fe.run(tmp_path, _one_by_one(text))
    for name in ("normal", "tangential"):
        a = np.array(getattr(whole.samples, name))[:, [0, 2]]
        b = np.array(getattr(half.samples, name))[:, [0, 2]]
        assert np.abs(a - 2.0 * b).max() < 1e-8 * np.abs(a).max()


def test_answer_is_the_same_on_one_and_two_threads(tmp_path: Path, fe: ModuleType) -> None:
    """The same operations in the same order: bit for bit."""
    one = rolled(fe, tmp_path, fe.user_friction(0.3), CONSTANT)
    two = rolled(fe, tmp_path, fe.user_friction(0.3), CONSTANT, threads=2)
    assert np.array_equal(np.array(one.samples.normal), np.array(two.samples.normal))
    assert np.array_equal(one.displacement(), two.displacement())
