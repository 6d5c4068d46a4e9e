"""A block pressed on a moving plane: what is prescribed, and what springs of every variant make of it."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate import deck
from tread_validate.case_file.build import case_file
from tread_validate.deck.lint import lint
from tread_validate.deck.mesh import block_mesh
from tread_validate.deck.placement import LEAD_IN, mount_tables
from tread_validate.errors import InputError
from tread_validate.fe import run_deck
from tread_validate.geometry import path_of
from tread_validate.spring import run
from tread_validate.study import Case, load_study
from tread_validate.units import MM

STUDY = """
schema_version: 1
name: track
title: An elastic block on a flat track
compounds:
  elastic: {kind: prony, origin: assumed, source: elastic, long_term_modulus_MPa: 10.0}
friction_laws:
  half: {kind: coulomb, origin: assumed, source: one number, kinetic_coefficient: 0.5}
blocks:
  block:
    {origin: assumed, source: box, shape: rectangle, length_mm: 20.0, width_mm: 10.0, height_mm: 8.0, mounting: flat}
paths:
  track: {kind: flat_track, origin: assumed, source: smooth, approach_ms: 4.0, hold_ms: 20.0, retreat_ms: 3.0}
runs:
  - name: press
    path: track
    block: block
    compound: elastic
    friction: half
    temperature_degC: 22.0
    interference_mm: 0.2
    speed_m_s: 0.5
deck: {element_size_mm: 2.0, layers: 4}
"""


WIDE = {"band_rad_s": (0.25, 1e6)}  # of the fit: the study's own ends at 2500 rad/s


@pytest.fixture
def case(tmp_path: Path) -> Case:
    (tmp_path / "study.yaml").write_text(STUDY, encoding="utf-8")
    return load_study(tmp_path / "study.yaml").cases()[0]


def test_face_goes_down_a_sine_holds_and_comes_up(case):
    """Touch at 0, D from 4 to 24 ms, clear at 27 ms; half of D at a third of the approach (sin 30 deg); to rounding."""
    path = path_of(case)
    times = np.array([-1e-3, 0.0, 4e-3 / 3, 4e-3, 12e-3, 24e-3, 26e-3, 27e-3])
    depth = path.indentation(0.004, times)
    pressed = 0.2 * MM
    expected = pressed * np.array([-0.125 * math.pi, 0.0, 0.5, 1.0, 1.0, 1.0, 0.5, 0.0])
    np.testing.assert_allclose(depth, expected, rtol=1e-12, atol=1e-17)
    assert path.contact_duration == pytest.approx(27e-3, rel=1e-14)


def test_whole_face_touches_at_once_and_the_block_stands_still(case):
    """No column is ahead of another in time; they stand side by side over the block's length; no velocity along x."""
    path = path_of(case)
    s = np.linspace(0.0, 20.0, 5) * MM
    at = path.at(s, 0.01)
    np.testing.assert_allclose(at.x, 10.0 * MM - s, atol=1e-17)
    assert np.ptp(path.indentation(s, 0.003)) == 0.0
    np.testing.assert_array_equal(at.velocity_x, 0.0)
    times = np.linspace(-2e-3, 30e-3, 3000)
    up, down = path.at(0.0, times + 1e-7), path.at(0.0, times - 1e-7)
    np.testing.assert_allclose((up.y - down.y) / 2e-7, path.at(0.0, times).velocity_y, atol=2e-6)


@pytest.mark.parametrize("variant", ["paper", "shape_factor"])
def test_elastic_block_presses_with_its_stiffness_times_depth_and_slides_about_mu(case, variant):
    """In the hold N is constant and the lumped mass swings about T = -mu N: some 25 periods, no damping.

    A swing of at most 15 % leaves 0.15/(2 pi 25) = 0.1 % in the mean. `paper`: N = E A D/h = 50 N exactly (1e-9).
    """
    history = run(case, variant)
    held = (history.time > 8e-3) & (history.time < 23e-3)
    normal, tangential = history.normal_force[held], history.tangential_force[held]
    assert np.ptp(normal) < 1e-9 * normal.mean()
    assert np.all(np.abs(tangential / normal + 0.5) < 0.15 * 0.5)
    assert tangential.mean() == pytest.approx(-0.5 * normal.mean(), rel=1e-3)
    assert np.all(history.slipping_fraction[held] == 1.0)
    if variant == "paper":
        assert normal.mean() == pytest.approx(10e6 * 200e-6 * 0.2 / 8.0, rel=1e-9)


def test_condensed_face_slides_at_mu_and_is_stiffer_than_springs(case):
    """T/N = 0.5 while the whole face slides, to the march's tolerance of 1e-3; N above the springs' 50 N."""
    history = run(case, "condensed")
    held = (history.time > 8e-3) & (history.time < 23e-3)
    np.testing.assert_allclose(history.tangential_force[held] / history.normal_force[held], -0.5, rtol=2e-3)
    assert 50.0 < history.normal_force[held].mean() < 80.0


def test_mount_tables_integrate_to_the_path(case):
    """The trapezoidal rule over the deck's table of velocities: within 0.1 um of the path, as on a belt."""
    path = path_of(case)
    mesh = block_mesh(case.block, case.deck)
    rows = np.unique(np.round(mesh.s[mesh.mount_nodes], 9))
    for table in mount_tables(path, rows, 1.05 * path.contact_duration, 0.0):
        np.testing.assert_array_equal(table.velocity_x, 0.0)
        travel = np.concatenate(
            [[0.0], np.cumsum(np.diff(table.time_y) * 0.5 * (table.velocity_y[1:] + table.velocity_y[:-1]))]
        )
        path_y = 1e3 * path.at(table.s * MM, table.time_y - LEAD_IN).y
        np.testing.assert_allclose(travel, path_y - path_y[0], atol=1e-4)


def test_case_file_of_a_track_says_where_every_column_is(case):
    """Place and height of the free face rebuilt from the file: linear between samples, 1e-7 m."""
    document, path = case_file(case), path_of(case)
    columns, samples = document.block.columns, document.path.samples
    assert columns.x_offset_m[0] == pytest.approx(-columns.x_offset_m[-1]) == pytest.approx(10.0 * MM)
    time = np.linspace(0.0, document.expected_duration_s, 29)
    y = np.interp(document.path.first_contact_arc_m + document.path.arc_speed_m_s * time, samples.arc_m, samples.y_m)
    np.testing.assert_allclose(document.block.height_m - y, path.indentation(0.01, time), atol=1e-7)


def test_a_block_that_does_not_roll_has_no_creep(tmp_path):
    (tmp_path / "study.yaml").write_text(
        STUDY.replace("speed_m_s: 0.5", "speed_m_s: 0.5\n    creep_percent: free_rolling")
    )
    with pytest.raises(InputError, match=r"creep_percent: got free_rolling, expected 0"):
        load_study(tmp_path / "study.yaml").cases()


def test_deeper_is_proportionally_harder_on_linear_springs(case):
    """Twice the depth, twice the force: 1e-9."""
    deep = run(replace(case, interference=0.4 * MM)).normal_force.max()
    assert deep == pytest.approx(2.0 * run(case).normal_force.max(), rel=1e-9)


@pytest.mark.parametrize(("mu", "lossy"), [(0.2, False), (0.5, True)], ids=["elastic, mu 0.2", "rubber, mu 0.5"])
def test_deck_of_a_track_is_clean_and_the_engine_slides_at_mu_too(case, paper_study, tmp_path, mu, lossy):
    """T/N = -mu over the hold, while all slides: 0.5 % in the mean. N within 3 % of the condensed face's.

    The mesh is 2 mm in the one and follows from the block in the other; both are the same continuum. Rubber that slides
    steadily at 0.5 needs its loss at the frequencies of its own face, some 1e5 rad/s: docs/paths.md.
    """
    law = case.friction.model_copy(update={"kinetic_coefficient": mu, "static_coefficient": mu})
    case = replace(case, friction=law)
    if lossy:
        rubber = load_study(paper_study).cases()[0].compound
        case = replace(case, compound=rubber.model_copy(update={"fit": rubber.fit.model_copy(update=WIDE)}))
    deck.write(case, tmp_path)
    assert lint(tmp_path / f"{case.case_id}.inp") == []
    result = run_deck(tmp_path / f"{case.case_id}.inp", tmp_path / "vfric.f")
    assert result.record["reference_quality"]["usable"]
    history = result.history
    held = (history.time > 8e-3) & (history.time < 23e-3)
    normal = history.normal_force[held].mean()
    assert history.tangential_force[held].mean() == pytest.approx(-mu * normal, rel=5e-3)
    face = run(case, "condensed")
    middle = np.interp(0.015, history.time, history.normal_force)
    assert middle == pytest.approx(np.interp(0.015, face.time, face.normal_force), rel=0.03)


@pytest.mark.parametrize(("mu", "short"), [(0.3, 0.005), (0.8, 0.05)])
def test_an_elastic_face_that_shivers_on_a_track_is_no_reference_and_says_so(case, tmp_path, mu, short):
    """Hardly damped, the mean of T/N over the hold falls short of mu by more than `short`; the run names the cause."""
    law = case.friction.model_copy(update={"kinetic_coefficient": mu, "static_coefficient": mu})
    case = replace(case, friction=law)
    deck.write(case, tmp_path)
    result = run_deck(tmp_path / f"{case.case_id}.inp", tmp_path / "vfric.f")
    held = (result.history.time > 8e-3) & (result.history.time < 23e-3)
    ratio = -result.history.tangential_force[held].mean() / result.history.normal_force[held].mean()
    assert ratio < (1.0 - short) * mu
    quality = result.record["reference_quality"]
    assert not quality["usable"]
    assert any("chatter leaves out" in reason for reason in quality["reasons"])
