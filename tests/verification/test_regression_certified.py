"""Regressions against certified values, exact lines and other formulas."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from tread_validate.compare.regression.differences import differences
from tread_validate.compare.regression.fit import Peak, fieller
from tread_validate.compare.regression.line import Coefficient, fit_line, mean_interval, regress
from tread_validate.errors import InputError

# NIST Statistical Reference Datasets, Norris: y, x, 36 observations
NORRIS = """
0.1 0.2 338.8 337.4 118.1 118.2 888.0 884.6 9.2 10.1 228.1 226.5 668.5 666.3 998.5 996.3 449.1 448.6 778.9 777.0
559.2 558.2 0.3 0.4 0.1 0.6 778.1 775.5 668.8 666.9 339.3 338.0 448.9 447.5 10.8 11.6 557.7 556.0 228.3 228.1
998.0 995.8 888.8 887.6 119.6 120.2 0.3 0.3 0.6 0.3 557.6 556.8 339.3 339.1 888.0 887.2 998.5 999.0 778.9 779.0
10.2 11.1 117.6 118.3 228.9 229.2 668.4 669.1 449.2 448.9 0.2 0.5
"""
NORRIS_SLOPE, NORRIS_INTERCEPT = 1.00211681802045, -0.262323073774029
SPEEDS = (1.571, 3.142, 4.712, 6.283)


def peaks(a_v: float = 0.036, a_theta: float = -0.0034, shape: str = "rectangle") -> list[Peak]:
    """Return a grid of peaks that follow F0 (1 + a_v v)(1 + a_theta (T - 22)) exactly."""
    return [
        Peak(f"{t:g}c-{d:g}mm-{v:g}", shape, t, d, v, 500.0 * d * (1 + a_v * v) * (1 + a_theta * (t - 22.0)))
        for t in (22.0, 45.0)
        for d in (0.1, 0.2, 0.3)
        for v in SPEEDS
    ]


def mean(rows: tuple[Coefficient, ...], name: str) -> Coefficient:
    return next(row for row in rows if row.coefficient == name and row.set == "mean")


def test_norris_slope_over_intercept_has_the_certified_digits() -> None:
    """NIST certifies slope and intercept to 15 digits; their ratio is met to 11, as double precision leaves."""
    values = np.array(NORRIS.split(), dtype=float).reshape(-1, 2)
    fit = fit_line(values[:, 1], values[:, 0])
    assert fit.coefficient == pytest.approx(NORRIS_SLOPE / NORRIS_INTERCEPT, rel=1e-11)


def test_forces_on_exact_lines_give_their_coefficients_back() -> None:
    """F = F0 (1 + a_v v)(1 + a_theta dT): every set's a_v is a_v and every a_theta is a_theta; no residuals."""
    found = regress(peaks())
    a_v, a_theta = mean(found.coefficients, "a_v"), mean(found.coefficients, "a_theta")
    assert a_v.value == pytest.approx(0.036, rel=1e-12)
    assert a_v.spread == pytest.approx(0.0, abs=1e-14)
    assert a_v.n == 4
    assert a_theta.value == pytest.approx(-0.0034, rel=1e-12)
    assert a_theta.n == 2
    assert all(
        row.force_N == pytest.approx(row.fitted_N, rel=1e-12) for row in found.residuals if row.coefficient == "a_v"
    )


def test_the_published_groups_leave_out_the_deepest_interference() -> None:
    """0.3 mm is not in the paper's regressions: a force there changes nothing, unless nothing is excluded."""
    bent = [replace(p, force=2.0 * (p.force or 0.0) + 7.0 * p.speed) if p.interference == 0.3 else p for p in peaks()]
    assert mean(regress(bent).coefficients, "a_v").value == pytest.approx(0.036, rel=1e-12)
    assert mean(regress(bent, exclude=()).coefficients, "a_v").value != pytest.approx(0.036, rel=1e-3)
    assert mean(regress(bent, exclude=()).coefficients, "a_v").n == 6


def test_a_missing_run_takes_its_set_and_the_mean_with_it() -> None:
    """A set without one of its runs has no coefficient, and the mean says so; it is never a mean of what is left."""
    gone = [
        Peak(p.case_id, p.shape, p.temperature, p.interference, p.speed, None) if i == 0 else p
        for i, p in enumerate(peaks())
    ]
    rows = regress(gone).coefficients
    broken = [row for row in rows if row.status == "missing"]
    assert {(row.coefficient, row.set) for row in broken} == {
        ("a_v", "22 degC 0.1 mm"), ("a_v", "mean"), ("a_theta", "0.1 mm"), ("a_theta", "mean"),
    }  # fmt: skip
    assert all(row.value is None for row in broken)


def unbalanced(noise: float = 0.0, seed: int = 0) -> list[Peak]:
    """Return peaks whose speeds differ between the temperatures: the cold runs were slow ones."""
    random = np.random.default_rng(seed)
    speeds = {22.0: (1.0, 2.0, 3.0, 4.0), 45.0: (4.0, 5.0, 6.0, 7.0)}
    return [
        Peak(f"{t:g}-{d:g}-{v:g}", "rectangle", t, d, v,
             500.0 * d * (1 + 0.036 * v) * (1 - 0.0034 * (t - 22.0)) * (1.0 + noise * random.standard_normal()))
        for t in speeds for d in (0.1, 0.2) for v in speeds[t]
    ]  # fmt: skip


def test_speeds_that_differ_between_temperatures_do_not_bias_a_theta() -> None:
    """Exact data of the product law: -0.0034 to 1e-9 (one line over the temperatures would give about +0.0011).

    With 1 % noise, 95 % intervals of 200 sets hold it within three binomial deviations (0.046).
    """
    row = mean(regress(unbalanced()).coefficients, "a_theta")
    assert row.value == pytest.approx(-0.0034, rel=1e-9)
    sets = [r for r in regress(unbalanced()).coefficients if r.coefficient == "a_theta" and r.set != "mean"]
    assert all("fitted together" in r.note for r in sets)
    hits = 0
    for seed in range(100):
        for r in regress(unbalanced(0.01, seed)).coefficients:
            if r.coefficient == "a_theta" and r.set != "mean":
                hits += (r.ci_low or 0.0) <= -0.0034 <= (r.ci_high or 0.0)
    assert hits / 200 == pytest.approx(0.95, abs=3 * math.sqrt(0.95 * 0.05 / 200))


def test_a_deleted_row_and_a_blank_one_are_the_same() -> None:
    """With missing runs dropped, both leave the set with one run fewer, and neither biases exact data."""
    blank = [replace(p, force=None) if i == 3 else p for i, p in enumerate(peaks())]
    deleted = [p for i, p in enumerate(peaks()) if i != 3]
    one, other = (mean(regress(p, drop_missing=True).coefficients, "a_theta") for p in (blank, deleted))
    assert one.value == other.value == pytest.approx(-0.0034, rel=1e-9)


def test_speeds_within_half_a_per_cent_are_repeats() -> None:
    """5 and 5.0000001 m/s are one setting: no slope comes of them."""
    two = [Peak("a", "rectangle", 22.0, 0.1, 5.0, 50.0), Peak("b", "rectangle", 22.0, 0.1, 5.0000001, 51.0)]
    (row,) = [r for r in regress(two).coefficients if r.coefficient == "a_v" and r.set != "mean"]
    assert row.value is None
    assert "repeats" in row.note


def test_fieller_interval_with_a_certain_denominator_is_the_student_one() -> None:
    """var(b) = cov = 0: the interval is (a -+ t sqrt(var a))/b, exactly."""
    low, high = fieller(3.0, 2.0, 0.04, 0.0, 0.0, 10, 0.95)
    half = float(stats.t.ppf(0.975, 10)) * 0.2
    assert low == pytest.approx((3.0 - half) / 2.0, rel=1e-12)
    assert high == pytest.approx((3.0 + half) / 2.0, rel=1e-12)


def test_fieller_interval_is_unbounded_where_the_denominator_may_be_zero() -> None:
    """b = 1 with standard deviation 1 cannot be told from zero: no finite interval."""
    assert fieller(3.0, 1.0, 0.04, 1.0, 0.0, 10, 0.95) == (-math.inf, math.inf)


def test_fieller_interval_covers_the_truth_as_often_as_it_says() -> None:
    """400 samples of a line with noise: coverage 0.95 within 3 standard deviations of a binomial (0.033)."""
    generator = np.random.default_rng(11)
    x = np.array(SPEEDS)
    hits = 0
    for _ in range(400):
        fit = fit_line(x, 100.0 * (1 + 0.036 * x) + generator.normal(0.0, 1.0, x.size))
        hits += fit.low <= 0.036 <= fit.high
    assert hits / 400 == pytest.approx(0.95, abs=3 * math.sqrt(0.95 * 0.05 / 400))


def test_mean_interval_is_student_s() -> None:
    """Four values with standard deviation 1.8 about 3.6: 3.6 -+ 3.18245 x 1.8/2 (t of 3 degrees of freedom, tables)."""
    low, high = mean_interval(3.6, 1.8, 4)
    assert (low, high) == pytest.approx((3.6 - 3.18245 * 0.9, 3.6 + 3.18245 * 0.9), rel=1e-5)


def test_published_means_are_compared_by_welch() -> None:
    """Table 1, rectangle, a_v: rig 3.6 (1.8) and FE 3.4 (0.8), four sets each: scipy's Welch test gives the same p."""

    def row(source: str, value: float, sd: float) -> Coefficient:
        return Coefficient(
            source, "rectangle", "a_v", "mean", value, "s/m", sd, "sd", value - sd, value + sd, None, None, 0.95, 4,
            "current",
        )  # fmt: skip

    (found,) = differences([row("rig:published", 0.036, 0.018), row("fe:published", 0.034, 0.008)])
    other = stats.ttest_ind_from_stats(0.034, 0.008, 4, 0.036, 0.018, 4, equal_var=False)
    assert found.p_value == pytest.approx(other.pvalue, rel=1e-12)
    assert found.significant is False
    assert found.test == "Welch t"


def with_sets(source: str, values: np.ndarray[tuple[int], np.dtype[np.float64]]) -> list[Coefficient]:
    sets = [
        Coefficient(source, "rectangle", "a_v", f"set {i}", float(v), "s/m", None, "", None, None, None, None, 0.95,
                    4, "current")
        for i, v in enumerate(values)
    ]  # fmt: skip
    whole = Coefficient(
        source, "rectangle", "a_v", "mean", float(values.mean()), "s/m", float(values.std(ddof=1)), "sd", None,
        None, None, None, 0.95, 4, "current",
    )  # fmt: skip
    return [*sets, whole]


def test_two_sources_with_the_same_sets_are_compared_set_by_set() -> None:
    """Paired: differences 0.001 -+ scatter over four sets; scipy's paired test gives the same p."""
    base = np.array([0.044, 0.043, 0.034, 0.032])
    other = base + np.array([0.0011, 0.0009, 0.0012, 0.0008])

    (found,) = differences([*with_sets("spring:a", base), *with_sets("spring:b", other)])
    assert found.test == "paired t"
    assert found.p_value == pytest.approx(stats.ttest_rel(other, base).pvalue, rel=1e-9)
    assert found.significant is True


@pytest.mark.parametrize("digits", [7, 17])
def test_round_off_between_two_sources_is_no_scatter_in_seven_digits_or_in_all(digits: int) -> None:
    """One model is another times a constant: equal slopes but for 1e-6. No test, whichever digits were kept."""
    base = np.array([0.0440123456789, 0.0431, 0.0342, 0.0323])
    other = base * (1.0 + 1e-6 * np.array([3.0, -1.0, 2.0, -4.0]))
    kept = [np.array([float(f"{value:.{digits}g}") for value in values]) for values in (base, other)]
    (found,) = differences([*with_sets("spring:a", kept[0]), *with_sets("spring:b", kept[1])])
    assert (found.p_value, found.status, found.note) == (None, "undefined", "no scatter between the sets")


def test_one_speed_is_no_line() -> None:
    """A coefficient needs two levels."""
    with pytest.raises(InputError, match="two different levels"):
        fit_line(np.array([1.0, 1.0]), np.array([2.0, 3.0]))
