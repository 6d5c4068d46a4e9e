"""Numbers are kept within what their quantity can be, by name and unit."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from tread_validate.bounds import NAMES, UNITS, bound_of, bounded, first_beyond
from tread_validate.errors import InputError
from tread_validate.fields import Strict


@pytest.mark.parametrize(
    ("name", "found"),
    [
        ("--temperature-degC", UNITS["degC"]),
        ("interference_mm", NAMES["interference_mm"]),
        ("small_wheel_diameter_mm", NAMES["diameter_mm"]),
        ("position_mm", UNITS["mm"]),
        ("slip_speed_m_s", UNITS["m_s"]),
        ("n", NAMES["n"]),
        ("lateral_stiffness_N_m", None),  # N/m is no length
        ("friction_coefficient_c", None),  # nor is every c a constant of the law
        ("origin", None),
    ],
)
def test_name_or_unit_tells_the_quantity(name: str, found: object) -> None:
    assert bound_of(name) is found


@given(st.sampled_from([*NAMES, *(f"x_{unit}" for unit in UNITS)]), st.floats())
def test_what_passes_is_finite_and_in_range(name: str, value: float) -> None:
    """For every quantity and every double, nan and infinities too."""
    bound = bound_of(name)
    assert bound is not None
    inside = math.isfinite(value) and bound.least <= value <= bound.most and not (bound.open and value == bound.least)
    assert bound.holds(value) is inside
    if inside:
        assert bounded(value, name) == value
    else:
        with pytest.raises(InputError, match="a number from"):
            bounded(value, name)


def test_columns_and_keys_go_by_the_same_bounds() -> None:
    assert first_beyond(np.array([0.2, np.nan, -0.1]), "interference_mm") == (2, str(NAMES["interference_mm"]))
    assert first_beyond(np.array([1e308]), "remark") is None

    class Wheel(Strict):
        diameter_mm: float
        temperatures_degC: tuple[float, ...] = ()

    assert Wheel(diameter_mm=200.0, temperatures_degC=(22, 60)).diameter_mm == 200.0
    for wrong in ({"diameter_mm": -5.0}, {"diameter_mm": 1e300}, {"diameter_mm": 1.0, "temperatures_degC": (22, 500)}):
        with pytest.raises(ValidationError, match="a number from"):
            Wheel.model_validate(wrong)
