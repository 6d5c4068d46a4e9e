"""The interpolation of a pass on to the common clock."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.interpolate import PchipInterpolator

from tread_validate.spring.condensed.monotone import monotone


@settings(deadline=None)
@given(
    steps=arrays(float, st.integers(2, 12), elements=st.floats(0.1, 10.0)),
    seed=st.integers(0, 2**32 - 1),
    flat=st.booleans(),
)
def test_it_is_the_monotone_cubic_of_scipy(steps, seed, flat):
    random = np.random.default_rng(seed)
    time = np.concatenate([[-1.0], -1.0 + np.cumsum(steps)])
    values = random.normal(size=(time.size, 2))
    if flat:
        values[: time.size // 2] = 0.0
    at = np.sort(random.uniform(time[0], time[-1], 40))
    assert monotone(time, values, at) == pytest.approx(PchipInterpolator(time, values)(at), abs=1e-12)


def test_forces_that_rise_from_zero_do_not_fall_below_it():
    time = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    values = np.array([[0.0], [0.0], [5.0], [5.1], [0.0]])
    found = monotone(time, values, np.linspace(0.0, 4.0, 101))
    assert found.min() >= 0.0
    assert found.max() <= 5.1
