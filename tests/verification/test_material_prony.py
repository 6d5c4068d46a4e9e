"""Time-temperature shift, Prony series and their fit against exact answers."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.material import (
    PronySeries,
    RouteSettings,
    abaqus_card,
    fit_prony,
    fit_surrogate,
    fractional_zener,
    material_route,
    prony_series,
    referred_to,
    relative_shift,
    surrogate_modulus,
)
from tread_validate.material.collocation import relaxation_times
from tread_validate.material.kramers_kronig import kramers_kronig
from tread_validate.material.reduce import prune, refine_times
from tread_validate.material.synthetic import synthetic_sweeps
from tread_validate.study import FractionalZener, Wlf, load_study

BAND = (0.25, 2500.0)
WLF = Wlf(c1=8.86, c2_K=101.6, reference_temperature_degC=10.0)


@pytest.fixture(scope="module")
def surrogate(paper_study) -> FractionalZener:
    compound = load_study(paper_study).model.compounds["surrogate"]
    assert isinstance(compound, FractionalZener)
    return compound


def random_series(random: np.random.Generator, terms: int) -> PronySeries:
    times = np.sort(10.0 ** random.uniform(-5, 3, terms))
    return PronySeries(random.uniform(1e5, 1e8), random.uniform(0, 1e8, terms), times, 22.0)


def test_published_constants_shift_22_to_60_degrees_by_96_88() -> None:
    """-C1 (T - Ts)/(C2 + T - Ts) by hand: a(22)/a(60) = 96.88, the paper's 0.25..2500 rad/s -> 3.8 Hz..38 kHz.

    Four printed digits, so 1e-4 relative.
    """
    assert 1.0 / relative_shift(60.0, 22.0, WLF) == pytest.approx(96.88, rel=1e-4)
    assert np.log10(relative_shift(45.0, 22.0, WLF)) == pytest.approx(-1.3342, abs=5e-5)
    assert np.log10(relative_shift(60.0, 22.0, WLF)) == pytest.approx(-1.9862, abs=5e-5)
    assert referred_to(WLF, 22.0) == pytest.approx((7.9241, 113.6), rel=1e-5)


@given(
    t0=st.floats(-60, 80),
    t1=st.floats(-60, 80),
    c1=st.floats(2, 20),
    c2=st.floats(75, 300),
)
def test_shift_then_unshift_gives_the_series_back(t0: float, t1: float, c1: float, c2: float) -> None:
    """a(T0 -> T1) a(T1 -> T0) = 1 identically; 1e-10 leaves room for the rounding of two powers of ten."""
    wlf = Wlf(c1=c1, c2_K=c2, reference_temperature_degC=10.0)
    series = PronySeries(1e6, np.array([2e6, 3e6]), np.array([1e-3, 1.0]), t0)
    back = series.at_temperature(t1, wlf).at_temperature(t0, wlf)
    np.testing.assert_allclose(back.relaxation_times, series.relaxation_times, rtol=1e-10)


@given(reference=st.floats(-50, 70), temperature=st.floats(-60, 90))
def test_law_referred_to_another_temperature_is_the_same_law(reference: float, temperature: float) -> None:
    """C2' = C2 + T0 - Ts, C1' = C1 C2/C2' is algebra; 1e-9 is rounding."""
    c1, c2 = referred_to(WLF, reference)
    there = Wlf(c1=c1, c2_K=c2, reference_temperature_degC=reference)
    exact = relative_shift(temperature, reference, WLF)
    assert relative_shift(temperature, reference, there) == pytest.approx(float(exact), rel=1e-9)


@given(seed=st.integers(0, 10_000), terms=st.integers(1, 30))
@settings(max_examples=60)
def test_storage_modulus_rises_and_no_energy_is_gained(seed: int, terms: int) -> None:
    """E' = E_inf + sum E_i x^2/(1+x^2) rises with w and E'' >= 0 for every E_i >= 0; bounds are E_inf and E_0."""
    series = random_series(np.random.default_rng(seed), terms)
    w = np.geomspace(1e-6, 1e8, 400)
    storage, loss = series.storage_modulus(w), series.loss_modulus(w)
    assert np.all(np.diff(storage) >= -1e-9 * storage[-1])
    assert np.all(loss >= 0)
    assert series.long_term_modulus <= storage[0]
    assert storage[-1] <= series.instantaneous_modulus * (1 + 1e-12)
    t = np.geomspace(1e-9, 1e6, 200)
    assert np.all(np.diff(series.relaxation_modulus(t)) <= 0)


def test_complex_modulus_is_the_transform_of_the_relaxation_modulus() -> None:
    """E*(w) = E_inf + i w int (E(t) - E_inf) exp(-i w t) dt, by quadrature on 4e5 points over 30 times: 1e-6."""
    series = PronySeries(2e6, np.array([3e6, 1e6]), np.array([0.1, 2.0]), 22.0)
    t = np.linspace(0.0, 60.0, 400_001)
    decay = series.relaxation_modulus(t) - series.long_term_modulus
    for w in (0.3, 2.0, 11.0):
        integral = 1j * w * np.trapezoid(decay * np.exp(-1j * w * t), t)
        exact = series.long_term_modulus + integral
        assert series.storage_modulus(w) == pytest.approx(exact.real, rel=1e-6)
        assert series.loss_modulus(w) == pytest.approx(exact.imag, rel=1e-6)


def test_fractional_zener_of_exponent_one_is_one_exponential() -> None:
    """With a = 1 the law is E_inf + dE i w tau/(1 + i w tau), tau = 1/w_c; equal to rounding."""
    w = np.geomspace(1e-2, 1e4, 50)
    law = fractional_zener(w, 5e6, 20e6, 40.0, 1.0)
    series = PronySeries(5e6, np.array([20e6]), np.array([1.0 / 40.0]), 22.0)
    np.testing.assert_allclose(series.storage_modulus(w), law.real, rtol=1e-12)
    np.testing.assert_allclose(series.loss_modulus(w), law.imag, rtol=1e-12)


@given(seed=st.integers(0, 1000), terms=st.integers(1, 6))
@settings(max_examples=25, deadline=None)
def test_moduli_of_an_exact_series_are_recovered(seed: int, terms: int) -> None:
    """Data of a series on the fit's own times have an exact solution; conditioning costs digits, 1e-5 of E_0 left."""
    random = np.random.default_rng(seed)
    times = relaxation_times(BAND, terms, 1.0, 1.0)
    true = PronySeries(4e6, random.uniform(1e6, 9e6, terms), times, 22.0)
    w = np.geomspace(*BAND, 60)
    fit = fit_prony(w, true.storage_modulus(w), true.loss_modulus(w), times, 22.0)
    np.testing.assert_allclose(fit.series.moduli, true.moduli, atol=1e-5 * true.instantaneous_modulus)
    assert fit.series.long_term_modulus == pytest.approx(true.long_term_modulus, rel=1e-4)


@given(seed=st.integers(0, 10_000), terms=st.integers(1, 40), noise=st.floats(0, 0.1), exponent=st.floats(0.1, 0.9))
@settings(max_examples=40, deadline=None)
def test_sign_control_reaches_the_non_negative_minimum(seed: int, terms: int, noise: float, exponent: float) -> None:
    """Both solve one convex problem, so their objectives agree: within 0.1 % as the method is specified."""
    random = np.random.default_rng(seed)
    w = np.geomspace(*BAND, 60)
    exact = fractional_zener(w, 10e6, 10.0 ** random.uniform(6.5, 9), 10.0 ** random.uniform(0, 6), exponent)
    storage = exact.real * np.exp(noise * random.standard_normal(60))
    loss = exact.imag * np.exp(noise * random.standard_normal(60))
    fit = fit_prony(w, storage, loss, relaxation_times(BAND, terms), 22.0)
    assert fit.objective * (1 - 1e-5) <= fit.check_objective <= fit.objective * 1.001 + 1e-12


def test_surrogate_meets_its_two_published_moduli(surrogate: FractionalZener) -> None:
    """Mean |E*| over the band is 20 MPa (to 1 %), and E_0 of the 24-term fit 37 MPa: two digits are printed."""
    w = np.geomspace(*BAND, 2001)
    assert np.mean(np.abs(surrogate_modulus(surrogate, w))) == pytest.approx(20e6, rel=0.01)
    assert prony_series(surrogate).instantaneous_modulus == pytest.approx(37e6, rel=0.015)
    fit = fit_surrogate(surrogate)
    assert fit.storage_rms < 0.01
    assert fit.loss_rms < 0.02


def test_route_from_clean_sweeps_follows_the_law_within_one_and_two_per_cent(surrogate: FractionalZener) -> None:
    """Noise-free sweeps: RMS of the series against the law itself below 1 % in E' and 2 % in E''. Targets as set."""
    route = material_route(synthetic_sweeps(surrogate), surrogate.wlf, 22.0, RouteSettings(band=BAND, replicates=0))
    w = np.geomspace(*BAND, 400)
    law, series = surrogate_modulus(surrogate, w), route.fit.series
    assert np.sqrt(np.mean((series.storage_modulus(w) / law.real - 1.0) ** 2)) < 0.01
    assert np.sqrt(np.mean((series.loss_modulus(w) / law.imag - 1.0) ** 2)) < 0.02
    assert route.outliers == 0


def test_true_moduli_lie_in_the_bands_of_noisy_sweeps(surrogate: FractionalZener) -> None:
    """2 % noise, 20 data sets of six sweeps: 90 to 98 % of the true curve lies inside the 95 % bands.

    Seeds are fixed, so the test does not flicker. No band may be wide enough to be empty talk: half-widths stay below
    6 %, three times the noise of a point.
    """
    inside = []
    for seed in range(20):
        sweeps = synthetic_sweeps(surrogate, 0.02, seed=seed)
        route = material_route(sweeps, surrogate.wlf, 22.0, RouteSettings(band=BAND, replicates=20))
        assert route.bands is not None
        law = surrogate_modulus(surrogate, route.bands.angular_frequency)
        for band, true in ((route.bands.storage_modulus, law.real), (route.bands.loss_modulus, law.imag)):
            inside.append(np.mean((band.lower <= true) & (true <= band.upper)))
            assert np.max((band.upper - band.lower) / (2 * band.centre)) < 0.06
    assert 0.90 <= np.mean(inside) <= 0.98


def test_wlf_constants_are_recovered_from_overlap(surrogate: FractionalZener) -> None:
    """Clean sweeps overlap exactly under the true constants: C1' = 7.9241 and C2' = 113.6 K to 0.1 %.

    With 2 % noise they lie within three standard deviations.
    """
    settings_ = RouteSettings(band=BAND, fit_wlf=True, replicates=0)
    clean = material_route(synthetic_sweeps(surrogate), surrogate.wlf, 22.0, settings_)
    assert (clean.law.c1, clean.law.c2_K) == pytest.approx((7.9241, 113.6), rel=1e-3)
    noisy = material_route(synthetic_sweeps(surrogate, 0.02), surrogate.wlf, 22.0, settings_).wlf_fit
    assert noisy is not None
    for value, exact, deviation in zip((noisy.wlf.c1, noisy.wlf.c2_K), (7.9241, 113.6), noisy.deviations, strict=True):
        assert abs(value - exact) < 3.0 * deviation


def test_bad_points_are_set_aside_and_do_not_move_the_series(surrogate: FractionalZener) -> None:
    """Four points off by 20 % in clean sweeps: found by name, and the series moves by less than 0.5 % anywhere."""
    settings_ = RouteSettings(band=BAND, replicates=0)
    clean = material_route(synthetic_sweeps(surrogate, 0.002), surrogate.wlf, 22.0, settings_)
    bad = material_route(synthetic_sweeps(surrogate, 0.002, outliers=4), surrogate.wlf, 22.0, settings_)
    assert clean.outliers == 0
    assert 4 <= bad.outliers <= 6
    w = np.geomspace(*BAND, 100)
    for name in ("storage_modulus", "loss_modulus"):
        ratio = getattr(bad.fit.series, name)(w) / getattr(clean.fit.series, name)(w)
        assert np.max(np.abs(ratio - 1.0)) < 0.005


@pytest.mark.parametrize("factor", [0.7, 1.3])
def test_kramers_kronig_tells_a_wrong_loss_modulus(surrogate: FractionalZener, factor: float) -> None:
    """E'' of another scale implies another rise of E': dispersion ratio 1/factor in the limit of a wide band.

    10 % of the ratio is left for what lies outside the band. The law itself passes with a mismatch below 0.1 %.
    """
    w = np.geomspace(*BAND, 80)
    law = surrogate_modulus(surrogate, w)
    true = kramers_kronig(w, law.real, law.imag)
    assert true.consistent
    assert true.mismatch < 1e-3
    wrong = kramers_kronig(w, law.real, factor * law.imag)
    assert not wrong.consistent
    assert wrong.dispersion_ratio == pytest.approx(1.0 / factor, rel=0.1)


def test_pruned_series_keeps_the_error_it_was_asked_for(surrogate: FractionalZener) -> None:
    """Fewest terms within 2 %: both RMS errors below 2 %, fewer than the 15 that carry in the full fit."""
    w = np.geomspace(*BAND, 80)
    law = surrogate_modulus(surrogate, w)
    full = fit_prony(w, law.real, law.imag, relaxation_times(BAND, 24), 22.0)
    short = prune(full, 0.02)
    assert max(short.storage_rms, short.loss_rms) <= 0.02
    assert short.series.moduli.size <= 8


@given(seed=st.integers(0, 1000), terms=st.integers(2, 8))
@settings(max_examples=15, deadline=None)
def test_refined_times_never_fit_worse(seed: int, terms: int) -> None:
    """The search starts from the evenly spaced times and keeps the better of the two."""
    random = np.random.default_rng(seed)
    w = np.geomspace(*BAND, 40)
    law = fractional_zener(w, 10e6, 77e6, 10.0 ** random.uniform(1, 6), random.uniform(0.2, 0.8))
    even = fit_prony(w, law.real, law.imag, relaxation_times(BAND, terms), 22.0)
    assert refine_times(even).objective <= even.objective


def test_abaqus_card_repeats_the_series(surrogate: FractionalZener) -> None:
    """E_0, g_i = k_i = E_i/E_0, tau_i and the TRS line 22, 7.9241, 113.6 read back from the card: printed digits."""
    series = prony_series(surrogate)
    lines = abaqus_card(series, surrogate.wlf).splitlines()
    elastic = lines[lines.index("*ELASTIC, MODULI=INSTANTANEOUS") + 1].split(",")
    assert float(elastic[0]) == pytest.approx(series.instantaneous_modulus / 1e6, rel=1e-6)
    first = lines.index("*VISCOELASTIC, TIME=PRONY") + 1
    last = lines.index("*TRS, DEFINITION=WLF")
    rows = np.array([[float(cell) for cell in line.split(",")] for line in lines[first:last]])
    np.testing.assert_array_equal(rows[:, 0], rows[:, 1])
    np.testing.assert_allclose(rows[:, 0] * series.instantaneous_modulus, series.moduli, rtol=1e-5)
    np.testing.assert_allclose(rows[:, 2], series.relaxation_times, rtol=1e-6)
    assert [float(cell) for cell in lines[last + 1].split(",")] == pytest.approx([22.0, 7.9241, 113.6], rel=1e-5)
