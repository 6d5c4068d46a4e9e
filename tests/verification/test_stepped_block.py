"""A block that a host advances: the pass on a prescribed path, and a belt that gives way."""

import importlib.util
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import tread_validate as tv
from tread_validate.errors import InputError
from tread_validate.geometry import path_of
from tread_validate.spring.condensed.roll import roll

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "belt_on_springs" / "belt_on_springs.py"
RIG = "rig-rectangle-22c-0p2mm-300rpm"
SKEWED = "rig-parallelogram-22c-0p2mm-300rpm"
BELT = "belt-simplified-60c-0p2mm-16p7mps-creep0p3"


@pytest.fixture(scope="module")
def belt():
    spec = importlib.util.spec_from_file_location("belt_on_springs", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    import sys

    sys.modules["belt_on_springs"] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", [RIG, SKEWED, BELT])
def test_a_prescribed_path_gives_the_forces_of_the_pass(name, study_cases):
    """The same steps through the same kernel: to 1e-6 of the peak, measured to round-off."""
    case = study_cases[name]
    face, path = roll(case), path_of(case)
    block = tv.TreadBlock(case)
    middle = 0.5 * path.columns.extent
    at, knots = path.at(middle, face.time), path.at(middle - block.mount_points, face.time[:, None])
    forces = np.zeros((face.time.size, 2))
    for k in range(face.time.size):
        mount = None if case.path.family == "rig" else np.column_stack([knots.x[k], knots.y[k]])
        if k == 0:
            block.start((at.x[0], at.y[0]), at.theta[0], mount)
            continue
        dt = face.time[k] - face.time[k - 1]
        speed = path.speed * (1.0 + case.creep_ratio)
        forces[k] = block.step(dt, (at.x[k], at.y[k]), at.theta[k], speed, mount)
    peak = face.normal_force.max()
    assert np.abs(forces[:, 0] - face.normal_force).max() < 1e-6 * peak
    assert np.abs(forces[:, 1] - face.tangential_force).max() < 1e-6 * peak


def test_a_copy_goes_its_own_way(study_cases):
    case = study_cases[RIG]
    block = tv.TreadBlock(case, "condensed_coarse")
    block.start((0.0, 9e-3), 0.0)
    block.step(1e-4, (0.0, 7.9e-3), 0.0, 0.0)
    twin = block.copy()
    for _ in range(3):
        twin.step(1e-4, (0.0, 7.5e-3), 0.0, 0.0)
    own, other = (each.step(1e-4, (0.0, 7.9e-3), 0.0, 0.0)[0] for each in (block, twin))
    assert own > 10.0
    assert other < own  # the twin was pressed deeper and has relaxed


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((0.0, (0.0, 9e-3), 0.0, 1.0), "dt"),
        ((1e-4, (0.0, np.nan), 0.0, 1.0), "position"),
        ((1e-4, (0.0, 9e-3), np.inf, 1.0), "angle"),
        ((1e-4, (0.0, 9e-3), 0.0, 1.0, np.zeros((2, 2))), "mount"),
    ],
)
def test_a_host_that_errs_is_told_where(study_cases, arguments, said):
    block = tv.TreadBlock(study_cases[RIG], "condensed_coarse")
    block.start((0.0, 9e-3), 0.0)
    with pytest.raises(InputError, match=said):
        block.step(*arguments)


def test_a_step_before_the_start_is_refused(study_cases):
    with pytest.raises(InputError, match="start"):
        tv.TreadBlock(study_cases[RIG], "condensed_coarse").step(1e-4, (0.0, 9e-3), 0.0, 1.0)
    with pytest.raises(InputError, match="one of"):
        tv.TreadBlock(study_cases[RIG], "shape_factor")


@pytest.fixture(scope="module")
def soft(belt, study_cases):
    return belt.ride(study_cases[BELT], belt.Belt(), "condensed_coarse")


@pytest.fixture(scope="module")
def rigid(belt, study_cases):
    return belt.ride(study_cases[BELT], None, "condensed_coarse")


def test_the_belts_energy_is_the_work_of_the_block_on_it(soft):
    """Exact for the trapezoidal rule: 1e-7 of the work done, what the trials at each step leave."""
    error = soft["work"] - soft["mass"] - soft["spring"] - soft["damper"]
    assert np.abs(error).max() < 1e-7 * soft["work"].max()


def test_a_belt_that_gives_way_takes_up_part_of_the_compression(soft, rigid, belt):
    """Static balance with the block's secant stiffness N/D: N_soft/N_rigid = k/(k + N/D), 0.36 of the mean force.

    10 %: the soft pass is shorter, and the rubber relaxes less under it.
    """
    middle = (rigid["time"] > 3e-3) & (rigid["time"] < 10e-3)
    held = np.mean(rigid["normal"][middle])
    expected = belt.Belt().stiffness / (belt.Belt().stiffness + held / 0.2e-3)
    assert np.mean(soft["normal"][middle]) / held == pytest.approx(expected, rel=0.1)


def test_a_very_stiff_belt_is_a_rigid_one(belt, rigid, study_cases):
    """N/(k D) of the compression is lost, below a thousandth."""
    stiff = replace(belt.Belt(), frequency=25000.0)
    found = belt.ride(study_cases[BELT], stiff, "condensed_coarse")
    loss = rigid["normal"].max() / (stiff.stiffness * 0.2e-3)
    assert loss < 1e-3
    assert found["normal"].max() == pytest.approx(rigid["normal"].max(), rel=2e-3)
