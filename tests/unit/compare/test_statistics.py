"""Means, scatter and frequency of a force: exact for a sine on a slow course."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from tread_validate.compare.quantities import statistics
from tread_validate.compare.runs import SourceRun, with_scalars
from tread_validate.compare.table_rows import statistics_row
from tread_validate.history import History
from tread_validate.study import load_study


def passed(swing: float, frequency: float = 20000.0) -> History:
    """100 N for 10 ms, T = 30 N and a sine of `swing` N."""
    time = np.linspace(-1e-3, 11e-3, 12001)
    inside = (time >= 0.0) & (time <= 10e-3)
    tangential = 30.0 + swing * np.sin(2.0 * np.pi * frequency * time)
    return History.of(time, np.where(inside, 100.0, 0.0), np.where(inside, tangential, 0.0), np.zeros_like(time))


def test_a_sine_on_a_constant_force_has_its_mean_its_scatter_and_its_frequency():
    """Mean 30, RMS sqrt(30^2 + 5^2/2), scatter 5/sqrt(2), 20 kHz (190 periods, one more or less): 2 %, 1 %."""
    found = statistics(passed(5.0))
    assert found.mean_normal == pytest.approx(100.0, rel=1e-3)
    assert found.mean_tangential == pytest.approx(30.0, rel=1e-3)
    assert found.rms_tangential == pytest.approx(math.hypot(30.0, 5.0 / math.sqrt(2.0)), rel=1e-3)
    assert found.scatter == pytest.approx(5.0 / math.sqrt(2.0), rel=0.02)
    assert found.frequency == pytest.approx(20000.0, rel=0.01)


def test_a_smooth_pass_has_no_frequency():
    found = statistics(passed(0.0))
    assert found.scatter < 0.1
    assert found.frequency is None


def test_a_run_that_is_no_reference_has_its_statistics_all_the_same(paper_study):
    """It says that stick and slip alternate only where its own record does."""
    case = load_study(paper_study).cases()[0]
    whole = with_scalars(SourceRun("fe:embedded", case.case_id, "current"), passed(5.0), None)
    why = "stick and slip alternate: T scatters by 1 % of the peak normal force, at most 0.5 %"
    bad = replace(whole, status="not_a_reference", note=why, history=None, scalars=None)
    row = statistics_row(case, bad)
    assert row.alternates
    assert row.scatter_N == pytest.approx(5.0 / math.sqrt(2.0), rel=0.02)
    assert not statistics_row(case, replace(bad, note="artificial energy is 3 %")).alternates
    assert not statistics_row(case, whole).alternates
    assert statistics_row(case, SourceRun("fe:embedded", case.case_id, "missing")).mean_normal_N is None
