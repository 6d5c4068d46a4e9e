"""Apparent moduli of bonded blocks: limits of the theories, and what they do to the springs."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.errors import InputError
from tread_validate.spring import pass_of, run, variants
from tread_validate.spring.block_pass import prepare
from tread_validate.spring.shape_factor import ratios, stiffened
from tread_validate.spring.stiffness import gent_lindley, pressure_theory, shape_factor, shear_theory
from tread_validate.study import Block, load_study

INCOMPRESSIBLE = 0.5 - 1e-9


def block(length=25.0, width=20.0, height=8.0, **more):
    plan = {"origin": "assumed", "source": "test", "shape": "rectangle", "mounting": "flat"}
    return Block(**{**plan, "length_mm": length, "width_mm": width, "height_mm": height, **more})


def test_shape_factor_is_loaded_over_free_area():
    """25 x 20 x 8 mm: 500/(2 x 8 x 45) = 0.69444."""
    assert shape_factor(block()) == pytest.approx(500 / 720, rel=1e-12)
    assert shape_factor(block(), sliding=True) == pytest.approx(500 / 1440, rel=1e-12)


def test_long_incompressible_strip_has_the_exact_parabola_of_pressure():
    """Plane strain: p = 6 G e (a^2 - x^2)/h^2, mean 4 G e S^2 with S = a/h, so E_a = E (1 + 4/3 S^2), G = E/3.

    The strip is 500 times as wide as long: ends cost 0.63/500 of the pressure term.
    """
    strip = block(length=2.0, width=1000.0, height=0.4)
    assert pressure_theory(strip, INCOMPRESSIBLE) == pytest.approx(1 + 4 / 3 * 2.5**2, rel=2e-3)


def test_incompressible_square_has_kellys_coefficient():
    """E_a - E = 6.75 G S^2 for a square (Kelly prints 6.73): 2.25 E S^2, to the printed digits."""
    square = block(length=20.0, width=20.0, height=2.0)
    assert (pressure_theory(square, INCOMPRESSIBLE) - 1) / shape_factor(square) ** 2 == pytest.approx(2.25, rel=5e-3)


def test_very_flat_block_is_limited_by_its_bulk_modulus():
    """S -> infinity: E_a -> E + K of the pressure method, and K alone of Gent and Lindley's sum."""
    pad = block(length=1000.0, width=1000.0, height=0.5)
    bulk = 1 / (3 * (1 - 2 * 0.47))
    assert pressure_theory(pad, 0.47) == pytest.approx(1 + bulk, rel=0.01)
    assert gent_lindley(pad, 0.47) == pytest.approx(bulk, rel=1e-4)


@given(st.floats(5, 60), st.floats(5, 60), st.floats(2, 20), st.floats(0.1, 0.49))
def test_a_longer_block_is_stiffer_per_area_and_sliding_is_softer(length, width, height, nu):
    """Monotonic for any plan, height and Poisson's ratio."""
    small, large = block(length, width, height), block(1.2 * length, width, height)
    assert pressure_theory(small, nu) <= pressure_theory(large, nu) + 1e-12
    assert 1.0 <= pressure_theory(small, nu, sliding=True) <= pressure_theory(small, nu) + 1e-12
    assert 0.0 < shear_theory(small, nu) < shear_theory(large, nu) < 1.0


def test_theory_refuses_a_block_with_sipes():
    with pytest.raises(InputError, match="sipe"):
        pressure_theory(block(sipes=({"position_mm": 12, "width_mm": 0.5},)), 0.47)


@pytest.fixture(scope="module")
def belt(paper_study):
    return load_study(paper_study).case("belt-simplified-60c-0p2mm-16p7mps-creep0p3")


def test_the_other_levels_are_known_by_name():
    assert {"paper", "shape_factor", "shape_factor_theory", "condensed", "condensed_coarse"} <= set(variants())


def test_shape_factor_springs_carry_the_static_ratio_times_the_papers_normal_force(belt):
    """Without slip in the middle of the pass forces scale exactly with the moduli: peak N by the normal ratio.

    1e-3: the release, and with it nothing of the peak, moves with the friction.
    """
    found = ratios(belt)
    paper, bonded = run(belt, "paper"), run(belt, "shape_factor")
    assert bonded.normal_force.max() == pytest.approx(found.normal * paper.normal_force.max(), rel=1e-3)
    assert 1.5 < found.normal < 2.0
    assert found.normal_sliding < found.normal
    assert found.shear < 1.0


def test_stiffening_by_one_changes_nothing(belt):
    base = prepare(belt)
    assert np.array_equal(stiffened(base, 1.0, 1.0).forces(0.003), base.forces(0.003))


def test_a_unknown_level_is_refused_by_name(belt):
    with pytest.raises(InputError, match="spring variant"):
        pass_of(belt, "pasternak")
