"""CalculiX on decks of the elastic-Coulomb subset, against known static stiffness and the embedded engine."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from tread_validate import deck as decks
from tread_validate.calculix import Resolution, run_deck
from tread_validate.errors import EngineError
from tread_validate.study import load_study

CONFTEST = Path(__file__).parents[1] / "unit" / "calculix" / "conftest.py"
spec = importlib.util.spec_from_file_location("calculix_decks", CONFTEST)
assert spec is not None
assert spec.loader is not None
calculix_decks = importlib.util.module_from_spec(spec)
spec.loader.exec_module(calculix_decks)

STUDY = """\
schema_version: 1
name: elastic
title: elastic block, Coulomb friction
compounds:
  rubber: {kind: prony, origin: assumed, source: test, long_term_modulus_MPa: 16.0}
friction_laws:
  road: {kind: coulomb, origin: assumed, source: test, static_coefficient: 0.9, kinetic_coefficient: 0.9}
blocks:
  flat:
    {origin: assumed, source: test, shape: rectangle, length_mm: 25.0, width_mm: 20.0, height_mm: 8.0, mounting: flat}
paths:
  belt: {kind: simplified_belt, origin: assumed, source: test, patch_length_mm: 60.0}
runs:
  - {name: belt, path: belt, block: flat, compound: rubber, friction: road, temperature_degC: 22.0,
     interference_mm: 0.2, speed_m_s: 16.7, creep_percent: 0.3}
deck: {element_size_mm: 2.5, layers: 4, refinement: 1.0}
"""


def press(folder: Path, friction: float, depth: float) -> Path:
    text = calculix_decks.PRESS.format(
        block=calculix_decks.block_text(10, 4, 8), friction=friction, speed=(0.02 + depth) / 0.05
    )
    path = folder / "press.inp"
    path.write_text(text)
    return path


@pytest.mark.parametrize(("friction", "force"), [(0.0, 261.8), (50.0, 374.5)], ids=["sliding", "sticking"])
def test_pressed_block_carries_the_known_static_force(tmp_path, friction, force):
    """Linear static CalculiX solution of this mesh (C3D8R, nodes glued): 261.8 N at 0.2 mm sliding, 374.5 N sticking.

    Pressed to 0.02 mm, a tenth, so that large-strain terms stay below 0.5 %; penalty contact of 200 E per mm over
    an 8 mm block takes 1/1600 to 1/800 of the stiffness, and the mesh is half as fine over the height: 2 % in all.
    """
    result = run_deck(
        press(tmp_path, friction, 0.02),
        resolution=Resolution(pass_increments=20, contact_stiffness=200.0, stick_ratio=1.0),
        time_limit=300,
    )
    assert float(result.history.normal_force.max()) == pytest.approx(force / 10.0, rel=0.02)
    assert float(np.abs(result.history.tangential_force).max()) < 1e-3 * force


def test_road_and_mount_carry_opposite_forces(tmp_path):
    """No inertia: the two sums balance but for the solver's residual, 1e-4 of the peak."""
    result = run_deck(press(tmp_path, 0.5, 0.02), resolution=Resolution(pass_increments=20), time_limit=300)
    peak = float(result.history.normal_force.max())
    assert np.max(np.abs(result.mount_force[:, 1] + result.history.normal_force)) < 1e-4 * peak


def test_missing_executable_is_said(tmp_path):
    with pytest.raises(EngineError, match="calculix-ccx"):
        run_deck(press(tmp_path, 0.5, 0.02), command="no-such-ccx")


@pytest.mark.heavy
def test_belt_pass_agrees_with_the_embedded_engine(tmp_path):
    """Two codes, two contact formulations, one deck: an elastic block with Coulomb friction over a belt patch.

    Dynamic against quasi-static (0.2 %), logarithmic strain against neo-Hookean (1 %), kinematic against penalty
    contact (0.5 %), two kinds of hourglass control on a coarse mesh: 6 % of the peak for the normal force.
    """
    from tread_validate import fe

    study = tmp_path / "study.yaml"
    study.write_text(STUDY)
    (case,) = load_study(study).cases()
    decks.write(case, tmp_path / "deck")
    inp, user = tmp_path / "deck" / f"{case.case_id}.inp", tmp_path / "deck" / "vfric.f"
    ours = fe.run_deck(inp, user).history
    theirs = run_deck(inp, user, time_limit=1500).history
    normal = np.interp(ours.time, theirs.time, theirs.normal_force, left=0.0, right=0.0)
    assert np.max(np.abs(normal - ours.normal_force)) < 0.10 * ours.normal_force.max()
    assert theirs.normal_force.max() == pytest.approx(ours.normal_force.max(), rel=0.06)
