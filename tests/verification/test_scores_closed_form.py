"""Scores of histories against values that can be worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tread_validate.compare.quantities import HISTORY_METRIC, scalars
from tread_validate.compare.scores.ensemble import bias_and_scatter
from tread_validate.compare.scores.iso18571 import grade, iso18571
from tread_validate.compare.scores.metrics import relative_rms, sprague_geers
from tread_validate.errors import InputError
from tread_validate.history import History

PERIOD = np.linspace(0.0, 1.0, 20001)


def half_sine(peak: float = 100.0, duration: float = 0.012, shear: float = 30.0, n: int = 4001) -> History:
    """Return N = peak sin(pi t/d), T = shear sin(2 pi t/d), slipping in the last quarter, with rest on both sides."""
    t = np.linspace(-0.2 * duration, 1.2 * duration, n)
    inside = (t >= 0.0) & (t <= duration)
    return History(
        t,
        np.where(inside, peak * np.sin(np.pi * t / duration), 0.0),
        np.where(inside, shear * np.sin(2.0 * np.pi * t / duration), 0.0),
        np.where(inside & (t > 0.75 * duration), 0.5, 0.0),
    )


def test_sprague_geers_of_a_taller_and_later_sine() -> None:
    """sin(2 pi t) against 1.2 sin(2 pi (t - 0.05)) over a period: M = 0.2, P = 0.1 (cos(0.1 pi) is the correlation),
    C = sqrt(0.05) = 0.2236. The trapezoid rule is exact to rounding for whole periods; arccos loses half the digits.
    """
    score = sprague_geers(PERIOD, np.sin(2 * np.pi * PERIOD), 1.2 * np.sin(2 * np.pi * (PERIOD - 0.05)))
    assert score.magnitude == pytest.approx(0.2, abs=1e-9)
    assert score.phase == pytest.approx(0.1, abs=1e-9)
    assert score.comprehensive == pytest.approx(math.sqrt(0.05), abs=1e-9)


WAVES = st.lists(st.floats(-100.0, 100.0), min_size=4, max_size=4)


@given(WAVES, WAVES, st.floats(0.1, 10.0))
def test_sprague_geers_holds_its_bounds_for_all_waves(a: list[float], b: list[float], factor: float) -> None:
    """P lies in [0, 1] and C is the length of (M, P); scaling the prediction by f makes 1 + M f times as large and
    leaves P alone (arccos near 1 loses half the digits: 1e-6).
    """
    modes = np.array([np.sin((k + 1) * np.pi * PERIOD[::50]) for k in range(4)])
    reference, predicted = np.array(a) @ modes, np.array(b) @ modes
    if min(np.max(np.abs(reference)), np.max(np.abs(predicted))) < 1e-3:
        return
    time = PERIOD[::50]
    one, other = sprague_geers(time, reference, predicted), sprague_geers(time, reference, factor * predicted)
    assert 0.0 <= one.phase <= 1.0
    assert one.comprehensive == pytest.approx(math.hypot(one.magnitude, one.phase), rel=1e-12)
    assert other.magnitude + 1.0 == pytest.approx(factor * (one.magnitude + 1.0), rel=1e-9)
    assert other.phase == pytest.approx(one.phase, abs=1e-6)


def test_relative_rms_of_a_ten_per_cent_taller_sine_is_a_tenth_of_the_sine_s_own() -> None:
    """RMS of sin over a period is 1/sqrt(2) of its peak: 0.1/sqrt(2). Rectangle rule over n + 1 points: 1/(2n)."""
    wave = np.sin(2 * np.pi * PERIOD)
    assert relative_rms(wave, 1.1 * wave) == pytest.approx(0.1 / math.sqrt(2.0), rel=1e-4)


def test_zero_histories_have_no_score() -> None:
    """A zero reference is no scale, a zero prediction has no phase: errors, never a zero score."""
    wave, nothing = np.sin(2 * np.pi * PERIOD), np.zeros_like(PERIOD)
    with pytest.raises(InputError, match="zero everywhere"):
        relative_rms(nothing, wave)
    with pytest.raises(InputError, match="zero everywhere"):
        sprague_geers(PERIOD, nothing, wave)
    with pytest.raises(InputError, match="no phase"):
        sprague_geers(PERIOD, wave, nothing)
    with pytest.raises(InputError, match="constant history"):
        iso18571(wave[:401], nothing[:401])


def test_iso_rating_of_identical_curves_is_one() -> None:
    """Every part of ISO/TS 18571 is 1 for equal curves, exactly."""
    wave = np.sin(np.pi * np.linspace(0, 1, 401))
    rating = iso18571(wave, wave)
    assert (rating.corridor, rating.phase, rating.magnitude, rating.slope) == (1.0, 1.0, 1.0, 1.0)
    assert rating.overall == pytest.approx(1.0, abs=1e-15)
    assert rating.grade == "excellent"


def test_iso_corridor_of_a_twenty_per_cent_taller_half_sine() -> None:
    """d = 0.2 sin(pi x): inside 0.05 up to x1 = asin(1/4)/pi, else ((0.5 - d)/0.45)^2. Integral over x in closed form:
    Z = 2 x1 + (2/0.2025) [0.25 x - 0.2 (-cos pi x)/pi + 0.04 (x/2 - sin(2 pi x)/(4 pi))] from x1 to 1/2 = 0.61685.
    Phase is 1 (scaling does not move a curve). The sum over 401 points is within half a step at each of the two ends
    (0.3 %).
    """
    x = np.linspace(0, 1, 401)
    wave = np.sin(np.pi * x)
    rating = iso18571(wave, 1.2 * wave)
    x1 = math.asin(0.25) / math.pi

    def antiderivative(s: float) -> float:
        return (
            0.25 * s
            + 0.2 * math.cos(math.pi * s) / math.pi
            + 0.04 * (0.5 * s - math.sin(2 * math.pi * s) / (4 * math.pi))
        )

    exact = 2 * x1 + 2 / 0.2025 * (antiderivative(0.5) - antiderivative(x1))
    assert rating.corridor == pytest.approx(exact, rel=3e-3)
    assert rating.phase == 1.0


def test_iso_phase_falls_linearly_with_the_shift() -> None:
    """A pulse that is k samples late of n: EP = (0.2 n - k)/(0.2 n), exactly.

    The search ends at floor(0.2 n) = 80 samples, so a pulse that is 100 late scores 0.2/80.2 and not quite 0.
    """
    n, k = 401, 20
    place = np.arange(n)

    def pulse(centre: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        return np.exp(-(((place - centre) / 15.0) ** 2))

    assert iso18571(pulse(200), pulse(200 + k)).phase == pytest.approx((0.2 * n - k) / (0.2 * n), abs=1e-12)
    assert iso18571(pulse(150), pulse(250)).phase == pytest.approx(0.2 / 80.2, rel=1e-9)


def test_iso_slope_of_a_taller_curve() -> None:
    """Slopes all f times the reference's: error |f - 1|, score (2 - |f - 1|)/2 = 0.9 for f = 1.2; linear, so exact."""
    wave = np.sin(np.pi * np.linspace(0, 1, 401))
    assert iso18571(wave, 1.2 * wave).slope == pytest.approx(0.9, abs=1e-12)


@pytest.mark.parametrize(
    ("score", "word"),
    [(0.95, "excellent"), (0.94, "good"), (0.81, "good"), (0.80, "fair"), (0.59, "fair"), (0.5, "poor")],
)
def test_iso_grades_are_the_published_ones(score: float, word: str) -> None:
    """> 0.94 excellent, > 0.80 good, > 0.58 fair, else poor."""
    assert grade(score) == word


@pytest.mark.parametrize("factor", [0.98, 1.02])
def test_scores_move_less_than_their_declared_sensitivity(factor: float) -> None:
    """The sensitivity of each ISO part bounds its change when the reference is scaled by 2 %; it is a first-order
    bound, so 10 % of slack for the second order.
    """
    x = np.linspace(0, 1, 401)
    reference, predicted = np.sin(np.pi * x), 1.15 * np.sin(np.pi * x**1.05)
    before, after = iso18571(reference, predicted), iso18571(factor * reference, predicted)
    for name in ("corridor", "phase", "magnitude", "slope"):
        bound = 1.1 * HISTORY_METRIC[f"iso18571_{name}"].sensitivity * 0.02
        assert abs(getattr(after, name) - getattr(before, name)) <= bound + 1e-12
    assert abs(after.overall - before.overall) <= 1.1 * HISTORY_METRIC["iso18571_r"].sensitivity * 0.02


def test_scalars_of_a_half_sine_pass() -> None:
    """N = 100 sin(pi t/d) is above 1 % of its peak from d asin(0.01)/pi on: duration d (1 - 2 asin(0.01)/pi), impulse
    (2/pi) 100 d cos(asin 0.01); T = 30 sin(2 pi t/d) has peaks +-30, no net impulse and no sign change in its last
    tenth; half of the face slips in the last quarter, and N is the weight. Linear interpolation between 4001 samples:
    1e-6 relative, and one sample of 5.0e-6 s for the slip.
    """
    found = scalars(half_sine())
    d, edge = 0.012, math.asin(0.01) / math.pi
    assert found.peak_normal_force == pytest.approx(100.0, rel=1e-6)
    assert found.contact_duration == pytest.approx(d * (1 - 2 * edge), rel=1e-5)
    assert found.normal_impulse == pytest.approx(2 / math.pi * 100 * d * math.cos(math.pi * edge), rel=1e-5)
    assert found.peak_positive_tangential_force == pytest.approx(30.0, rel=1e-5)
    assert found.peak_negative_tangential_force == pytest.approx(-30.0, rel=1e-5)
    assert found.net_tangential_impulse == pytest.approx(0.0, abs=1e-9)
    assert found.time_of_peak_normal_force == pytest.approx(d / 2, abs=5e-6)
    assert found.tangential_to_normal_ratio == pytest.approx(0.3, rel=1e-5)
    assert found.late_sign_change == 0.0
    assert found.slipping_share == pytest.approx(0.25 * (1.0 - math.sqrt(0.5) / math.cos(math.pi * edge)), abs=3e-4)


def test_a_reversal_in_the_last_tenth_is_seen() -> None:
    """T = sin(pi t/d) - sin(22 pi t/(11 d))...: simply T < 0 until 0.95 d, > 0 after it."""
    t = np.linspace(0.0, 0.01, 1001)
    normal = 100.0 * np.sin(np.pi * t / 0.01)
    tangential = np.where(t < 0.0095, -20.0, 4.0) * np.sin(np.pi * t / 0.01)
    late = History(t, normal, tangential, np.zeros_like(t))
    early = History(t, normal, np.where(t < 0.007, -20.0, 4.0) * np.sin(np.pi * t / 0.01), np.zeros_like(t))
    assert scalars(late).late_sign_change == 1.0
    assert scalars(early).late_sign_change == 0.0


def test_bias_of_a_model_that_is_ten_per_cent_high_everywhere() -> None:
    """ln ratios all ln 1.1: u = 0, sigma_M = 0, bias = 1.1 exp(-sigma_E^2/2); exact."""
    found = bias_and_scatter([100.0, 50.0, 20.0], [110.0, 55.0, 22.0], 0.05)
    assert found.bias == pytest.approx(1.1 * math.exp(-0.5 * 0.05**2), rel=1e-14)
    assert found.model_scatter == 0.0
    assert found.total_scatter == pytest.approx(0.0, abs=1e-14)


def test_scatter_of_two_runs() -> None:
    """Ratios e^s and e^-s: u = s sqrt(2); with sigma_E = s, sigma_M = s and the bias is exp(0) = 1; exact."""
    s = 0.2
    found = bias_and_scatter([1.0, 1.0], [math.exp(s), math.exp(-s)], s)
    assert found.total_scatter == pytest.approx(s * math.sqrt(2.0), rel=1e-14)
    assert found.model_scatter == pytest.approx(s, rel=1e-12)
    assert found.bias == pytest.approx(1.0, rel=1e-14)


@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, None])
def test_bias_counts_every_point(bad: float | None) -> None:
    """A missing or non-positive point is an error, never left out."""
    with pytest.raises(InputError, match="every point counts"):
        bias_and_scatter([1.0, 2.0], [1.0, bad], 0.0)


def test_time_of_a_flat_peak_does_not_hang_on_round_off() -> None:
    """A trapezoid of N, flat for 2 ms about 5 ms, peaks at 5 ms, whichever sample of the top is the largest."""
    time = np.linspace(0.0, 0.01, 1001)
    force = np.interp(time, [0.0, 0.004, 0.006, 0.01], [0.0, 100.0, 100.0, 0.0])
    for largest in (400, 500, 600):
        lifted = force.copy()
        lifted[largest] += 1e-9
        history = History(time, lifted, np.zeros_like(time), np.zeros_like(time), {})
        assert scalars(history).time_of_peak_normal_force == pytest.approx(0.005, abs=1e-9)
