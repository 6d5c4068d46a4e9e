"""Packing of histories: small numbers, the same curves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.compare.thinned import FORCE_STEPS, pack, thin, unpack
from tread_validate.history import History
from tread_validate.report.histories import BUDGET, FEWEST, SAMPLES, samples_each


def history(samples: int, scale: float = 100.0, spike: int | None = None) -> History:
    """Return a half sine with one sample out of line."""
    time = np.linspace(0.0, 0.01, samples)
    normal = scale * np.sin(np.pi * time / time[-1])
    if spike is not None:
        normal[spike] = 3.0 * scale
    return History(time, np.abs(normal), 0.1 * normal, np.zeros(samples))


@given(st.integers(2, 3000), st.floats(1e-6, 1e6))
def test_packed_history_is_the_history(samples: int, scale: float) -> None:
    """Exact: times to half a microsecond, forces to one 20,000th of their peak at the kept samples."""
    whole = history(samples, scale)
    packed, keep = pack(whole, SAMPLES), thin(whole, SAMPLES)
    assert unpack(packed, "t") == pytest.approx(1e3 * whole.time[keep], abs=0.51e-3)
    peak = whole.normal_force.max()
    tolerance = max(peak / FORCE_STEPS, 1e-12)
    assert unpack(packed, "n") == pytest.approx(whole.normal_force[keep], abs=tolerance)


@given(st.integers(SAMPLES + 1, 5000), st.data())
def test_thinning_keeps_the_peaks(samples: int, data: st.DataObject) -> None:
    """Exact: a one-sample spike anywhere survives, so a peak read off the chart is the peak of the table."""
    spike = data.draw(st.integers(0, samples - 1))
    whole = history(samples, spike=spike)
    keep = thin(whole, SAMPLES)
    assert whole.normal_force[keep].max() == whole.normal_force.max()
    assert whole.tangential_force[keep].max() == whole.tangential_force.max()
    assert keep[0] == 0
    assert keep[-1] == samples - 1
    assert keep.size <= SAMPLES + 3


def test_force_that_is_nowhere_packs_as_zeros() -> None:
    """Exact: no division by the peak of a history without contact."""
    time = np.linspace(0.0, 1.0, 5)
    none = History(time, np.zeros(5), np.zeros(5), np.zeros(5))
    assert pack(none, SAMPLES)["n"] == [0] * 5


@given(st.integers(0, 100_000))
def test_many_histories_share_the_page_s_room(histories: int) -> None:
    """Exact: a usual study draws 300 samples a history, a large one fewer, but never too few to see a curve."""
    each = samples_each(histories)
    assert FEWEST <= each <= SAMPLES
    assert each * histories <= max(BUDGET, FEWEST * histories)
    assert samples_each(260) == SAMPLES
