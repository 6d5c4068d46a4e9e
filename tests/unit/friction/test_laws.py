"""Friction laws as entries of a study: what one number means, and the laws' limits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from tread_validate.errors import InputError
from tread_validate.friction import (
    ENTRIES,
    FORMS,
    Coulomb,
    Friction,
    FrictionData,
    FrictionTable,
    Huemer,
    Power,
    coulomb_law,
    huemer_law,
    law,
    power_law,
    table_law,
)

SOURCED = {"origin": "assumed", "source": "for the test"}


def entry(**keys: object):
    return TypeAdapter(Friction).validate_python(SOURCED | keys)


def test_coulomb_law_of_one_number_has_one_coefficient():
    """The static coefficient is the kinetic one where it is not given: nothing sticks at a number nobody set."""
    one = entry(kind="coulomb", kinetic_coefficient=0.5)
    assert one.static_coefficient == 0.5
    assert law(one).constant_coefficient == 0.5
    two = entry(kind="coulomb", kinetic_coefficient=0.5, static_coefficient=0.7)
    assert two.static_coefficient == 0.7
    assert law(two).constant_coefficient == 0.5


def test_a_frictionless_law_is_a_law():
    smooth = law(entry(kind="coulomb", kinetic_coefficient=0.0))
    assert smooth.static_coefficient == 0.0
    assert smooth.kinetic(1e5, 1.0) == 0.0
    with pytest.raises(ValidationError):
        entry(kind="coulomb", kinetic_coefficient=0.0, static_coefficient=-0.1)


def test_every_constant_has_a_unit_and_every_form_fortran_of_its_own():
    for form in FORMS.values():
        assert all(form.units.values())
        assert "function fricmu(nProps, props, press, speed)" in form.fortran
        assert all(len(line) <= 72 for line in form.fortran.splitlines())
    assert len({item.model_fields["kind"].annotation for item in ENTRIES}) == len(ENTRIES)


@settings(deadline=None)  # the first call compiles
@given(
    mu=st.floats(0.01, 3.0),
    exponent=st.floats(-1.0, 1.0),
    speed=st.floats(1e-3, 20.0),
    times=st.floats(1.0, 50.0),
    pressure=st.floats(0.0, 1e7),
)
def test_power_law_is_scale_free_above_its_floor_and_level_below(mu, exponent, speed, times, pressure):
    """mu(k v) = k^n mu(v) whatever v and the pressure; mu(v0) = mu0."""
    friction = power_law(mu, 0.1, exponent)
    assert friction.kinetic(pressure, 0.1) == pytest.approx(mu, rel=1e-13)
    ratio = float(friction.kinetic(pressure, times * speed) / friction.kinetic(pressure, speed))
    assert ratio == pytest.approx(times**exponent, rel=1e-12)
    assert friction.kinetic(pressure, 0.0) == friction.kinetic(pressure, 1e-3) == friction.kinetic(pressure, -5e-4)


@pytest.mark.parametrize(
    ("kind", "drawn", "tolerance"),
    [
        (Coulomb, coulomb_law(0.5, 0.9), 1e-12),
        (Power, power_law(0.8, 0.1, -0.2), 1e-12),
        (FrictionTable, power_law(0.8, 0.1, -0.2), 1e-12),
        (Huemer, huemer_law(0.8212, 0.0, 0.9, 10.0, 3.729, -4.495, 1.785), 2e-3),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_law_is_recovered_from_its_own_table(kind, drawn, tolerance):
    """Exact readings at four pressures and eight speeds: to rounding at the readings; Huemer's form by a search."""
    pressures, speeds = np.geomspace(5e4, 8e5, 4), np.geomspace(2e-3, 5.0, 8)
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(4), np.arange(8), indexing="ij"))
    readings = drawn.kinetic(pressures[i], speeds[j])
    data = FrictionData(pressures[i], speeds[j], readings, i, j, pressures, speeds, "test")
    found = kind.fit(data)
    np.testing.assert_allclose(found.kinetic(pressures[i], speeds[j]), readings, rtol=tolerance)
    assert found.kind == FORMS[kind.model_fields["kind"].annotation.__args__[0]].name


def test_a_power_law_needs_two_speeds():
    one = np.array([1e5, 2e5])
    data = FrictionData(
        one, np.full(2, 0.1), np.array([0.5, 0.6]), np.arange(2), np.zeros(2, int), one, np.array([0.1]), "t"
    )
    with pytest.raises(InputError, match="one slip speed only"):
        Power.fit(data)


def test_constants_reach_the_deck_in_its_units_and_the_kernel_in_si():
    """v0 = 0.1 m/s = 100 mm/s; the least slip speed 1 mm/s = 0.001 m/s."""
    friction = law(entry(kind="power", reference_coefficient=0.8, reference_slip_speed_mm_s=100.0, exponent=-0.1))
    assert friction.parameters.tolist() == pytest.approx([0.8, 0.1, -0.1, 1e-3], rel=1e-15)
    assert friction.deck_properties == pytest.approx((0.9, 0.8, 100.0, -0.1, 1.0), rel=1e-15)
    assert replace(friction, static_coefficient=0.0).deck_properties[0] == 0.0


def test_root_of_a_file_is_the_study_s(tmp_path: Path):
    (tmp_path / "table.csv").write_text("pressure_Pa,slip_speed_m_s,friction_coefficient\n1e5,0.1,0.8\n1e5,1,0.6\n")
    table = entry(kind="table", file="table.csv")
    assert law(table, tmp_path).kinetic(1e5, 0.1) == pytest.approx(0.8)
    assert table.measurements(tmp_path).coefficient.size == 2


@pytest.mark.parametrize(
    "friction",
    [
        coulomb_law(0.5, 0.7),
        huemer_law(0.8212, 0.1, 0.9, 10.0, 3.729, -4.495, 1.785),
        power_law(0.8, 0.1, -0.1),
        table_law(np.array([1e5, 4e5]), np.array([0.01, 1.0]), np.array([[1.0, 2.0], [0.5, 0.9]]), 0.9),
    ],
    ids=lambda law: law.kind,
)
def test_leading_constants_scale_the_coefficient(friction):
    """1.25 times the constants (or the table) said to be proportional give 1.25 times the coefficient: rounding."""
    values = list(friction.constants.values())
    values[: friction.form.proportional] = [1.25 * value for value in values[: friction.form.proportional]]
    scaled = replace(
        friction, constants=dict(zip(friction.constants, values, strict=True)), table=1.25 * friction.table
    )
    assert scaled.kinetic(2e5, 0.3) == pytest.approx(1.25 * friction.kinetic(2e5, 0.3), rel=1e-13)
