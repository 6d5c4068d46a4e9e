"""Richardson's extrapolation, against sequences whose limit is known."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.compare.scores.convergence import convergence, history_errors, richardson
from tread_validate.errors import InputError
from tread_validate.history import History


@given(
    limit=st.floats(1.0, 1e3),
    factor=st.floats(-0.05, 0.05).filter(lambda value: abs(value) > 1e-3),
    order=st.floats(0.6, 3.5),
    medium=st.floats(0.4, 0.7),
    fine=st.floats(0.1, 0.3),
)
def test_power_law_sequence_gives_its_limit_and_order(limit, factor, order, medium, fine):
    """f(h) = f0 (1 + c h^p): order and limit are exact, whatever the ratios of the sizes."""
    sizes = np.array([1.0, medium, fine])
    values = limit * (1.0 + factor * sizes**order)
    result = richardson(sizes, values)
    assert result.order == pytest.approx(order, rel=1e-5)
    assert result.limit == pytest.approx(limit, rel=1e-6)
    np.testing.assert_allclose(result.errors, np.abs(factor) * sizes**order, rtol=1e-3, atol=1e-9)


@pytest.mark.parametrize("values", [(1.0, 1.1, 1.05), (1.0, 1.0, 1.0), (1.0, 1.01, 1.10)])
def test_scattered_sequence_gives_a_bound_and_no_order(values):
    """Not monotone, or diverging: the bound is the scatter over the finest value."""
    result = richardson((2.0, 1.0, 0.5), values)
    assert result.order is None
    assert result.limit == values[2]
    assert result.errors == pytest.approx([(max(values) - min(values)) / values[2]] * 3)


def test_every_scalar_of_a_pass_is_extrapolated():
    """Half sines of 100 (1 + h^2) N: the peak's limit is 100 N, second order."""
    time = np.linspace(0.0, 1e-2, 2001)
    shape = np.sin(np.pi * time / 1e-2)
    histories = [
        History(time, 100.0 * (1.0 + h**2) * shape, 20.0 * np.sin(2 * np.pi * time / 1e-2), 0.0 * time)
        for h in (0.2, 0.1, 0.05)
    ]
    peak = convergence((0.2, 0.1, 0.05), histories)["peak_normal_force"]
    assert peak.order == pytest.approx(2.0, abs=1e-6)
    assert peak.limit == pytest.approx(100.0, rel=1e-9)


@pytest.mark.parametrize(("sizes", "values"), [((1, 2, 3), (1, 2, 3)), ((2, 1), (1, 2)), ((3, 2, 1), (1, np.nan, 2))])
def test_wrong_mesh_study_is_refused(sizes, values):
    with pytest.raises(InputError, match="mesh study"):
        richardson(sizes, values)


def test_history_error_of_a_first_order_mesh_is_its_distance_from_the_limit():
    """Histories F (1 + h) of a half sine: at h = 1 mm the limit is missed by F, rms 0.7071 of its largest value.

    The finest mesh's largest value, 1.5 F, is the scale: 0.7071 / 1.5.
    """
    time = np.linspace(0.0, 1.0, 4001)
    shape = np.sin(np.pi * time)
    histories = [History(time, (1.0 + h) * shape, (1.0 + h) * shape, 0.0 * time) for h in (2.0, 1.0, 0.5)]
    errors = history_errors((2.0, 1.0, 0.5), histories, 1.0)
    assert errors == pytest.approx({"normal_force": np.sqrt(0.5) / 1.5, "tangential_force": np.sqrt(0.5) / 1.5})
    with pytest.raises(InputError, match="but the finest"):
        history_errors((2.0, 1.0, 0.5), histories, 0.5)
