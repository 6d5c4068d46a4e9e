"""Statistics and scores are what the libraries say, where they are called and where our own search stands in."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from objective_rating_metrics.rating import ISO18571
from scipy.stats import wasserstein_distance
from statsmodels.regression.linear_model import OLS
from statsmodels.stats.multitest import multipletests

from tread_validate.compare.regression.differences import corrected
from tread_validate.compare.regression.line import fit_line
from tread_validate.compare.scores.ensemble import summarise
from tread_validate.compare.scores.iso18571 import INTERVAL, best_shift
from tread_validate.compare.tables import Difference, MetricRow

Array = NDArray[np.float64]
SHAPES = ("pulse", "noisy pulse", "flat then ramp", "the same", "one sample", "sine of many periods", "large offset")


def two_histories(shape: str, seed: int, n: int = 401) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    x = np.linspace(0.0, 1.0, n)
    a = np.sin(np.pi * x) ** rng.uniform(0.5, 4.0)
    b = rng.uniform(0.3, 2.0) * np.interp(x - rng.uniform(-0.3, 0.3), x, a, left=0.0, right=0.0)
    if shape == "noisy pulse":
        b += rng.normal(0.0, 0.05, n)
    elif shape == "flat then ramp":
        a = np.where(x < 0.5, 0.0, x)
    elif shape == "the same":
        b = a.copy()
    elif shape == "one sample":
        a, b = np.eye(n)[n // 2], np.eye(n)[rng.integers(0, n)]
    elif shape == "sine of many periods":
        a, b = np.sin(20.0 * np.pi * x), np.sin(20.0 * np.pi * x + rng.uniform(0.0, 6.0))
    elif shape == "large offset":
        a, b = 1e6 + 1e-3 * a, 1e6 + 1e-3 * b
    return a, b


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.filterwarnings("ignore:invalid value encountered:RuntimeWarning")  # of the package, at constant pieces
def test_best_shift_of_two_histories_is_that_of_a_search_through_all_shifts(shape: str) -> None:
    for seed in range(4):
        a, b = two_histories(shape, seed)
        clock = np.arange(a.size) * INTERVAL
        theirs = ISO18571(np.column_stack([clock, a]), np.column_stack([clock, b]), dt=INTERVAL)
        shift, correlation = best_shift(a, b, int(np.floor(a.size * 0.2) + 1))
        assert (abs(shift), correlation) == (theirs._n_eps, theirs._rho_e)
        if shift:  # the prediction's first sample kept is the shift's, to the left, else the reference's
            assert (theirs._cae_ts if shift > 0 else theirs._t_ts)[0, 0] == pytest.approx(abs(shift) * INTERVAL)


def difference(p_value: float) -> Difference:
    return Difference(
        shape="rectangle", coefficient="a_v", source_a="fe:embedded", source_b="spring:paper", difference=0.1,
        unit="s/m", ci_low=None, ci_high=None, p_value=p_value, p_holm=None, family="models", tests=0,
        significant=None, test="paired t", status="current", note="", assumed="",
    )  # fmt: skip


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=40))
def test_p_values_are_corrected_as_holm_does(values: list[float]) -> None:
    rows = [difference(value) for value in values]
    reject, expected, _, _ = multipletests(values, alpha=0.05, method="holm")
    found = corrected(rows)
    assert [row.p_holm for row in found] == pytest.approx(list(expected), rel=1e-14)
    assert all(row.significant == bool(no) for row, no in zip(found, reject, strict=True) if row.p_holm != 0.05)


def test_a_line_and_its_ratio_are_those_of_ordinary_least_squares() -> None:
    rng = np.random.default_rng(5)
    x = rng.uniform(2.0, 9.0, 12)
    force = 40.0 + 3.0 * x + rng.normal(0.0, 1.0, 12)
    theirs = OLS(force, np.column_stack([np.ones_like(x), x])).fit()
    found = fit_line(x, force)
    assert found.coefficient == pytest.approx(theirs.params[1] / theirs.params[0], rel=1e-12)
    assert found.fitted == pytest.approx(theirs.fittedvalues, rel=1e-12)


def test_area_between_two_samples_is_their_wasserstein_distance() -> None:
    rng = np.random.default_rng(6)
    reference, predicted = rng.normal(100.0, 9.0, 30), rng.normal(104.0, 20.0, 30)
    rows = [
        MetricRow(
            f"case-{i}", "peak_normal_force", "scalar", "fe:embedded", "spring:paper", a, b, "N", b / a - 1.0,
            "relative", 0.0, 0.0, 0.0, 0.0, 0.1, 2.0, True, "agrees", "adequate", "current", "",
        )
        for i, (a, b) in enumerate(zip(reference, predicted, strict=True))
    ]  # fmt: skip
    expected = wasserstein_distance(reference, predicted) / np.mean(reference)
    assert summarise("all", rows).area_metric == pytest.approx(expected, rel=1e-12)


def test_comparing_loads_no_drawing_library() -> None:
    """Rating two histories draws nothing: what draws would take longer to load than the tables to compute."""
    code = (
        "import sys, numpy as np; from tread_validate.compare import build_tables;"
        "from tread_validate.compare.scores.iso18571 import iso18571;"
        "x = np.linspace(0, 3, 101); iso18571(np.sin(x), np.sin(1.1 * x));"
        "print(*sorted({'matplotlib', 'seaborn', 'networkx', 'pandas', 'scipy.stats'} & sys.modules.keys()))"
    )
    said = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert said.stdout.split() == []
