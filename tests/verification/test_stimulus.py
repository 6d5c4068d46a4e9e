"""The patch force against exact answers of superposition."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tread_validate.history import History
from tread_validate.stimulus import PitchSequence, TransferFunction, respond, superpose
from tread_validate.stimulus.piecewise import integral, transform
from tread_validate.stimulus.stimulus import amplitude

SPEED = 16.7


def half_sine(duration: float = 0.0116, peak: float = 200.0, samples: int = 581) -> History:
    """A pass of a block: half a sine of normal force, a full one of tangential force."""
    time = np.linspace(0.0, duration, samples)
    phase = np.pi * time / duration
    normal = peak * np.sin(phase)
    normal[-1] = 0.0
    return History(time, normal, 0.4 * peak * np.sin(2 * phase) + 0.05 * normal, np.zeros(samples))


def uniform(blocks: int = 64, block: float = 25.0, gap: float = 6.3, **rib: object) -> PitchSequence:
    return PitchSequence.model_validate(
        {
            "schema_version": 1,
            "name": "uniform",
            "origin": "assumed",
            "source": "test",
            "pitches": {"m": {"block_mm": block, "gap_mm": gap}},
            "ribs": [{"name": "centre", "sequence": ["m"], "repeat": blocks, **rib}],
        }
    )


def mixed(sequence: list[str], offsets: tuple[float, ...] = (0.0,)) -> PitchSequence:
    return PitchSequence.model_validate(
        {
            "schema_version": 1,
            "name": "mixed",
            "origin": "assumed",
            "source": "test",
            "pitches": {
                "s": {"block_mm": 25.0, "gap_mm": 2.0},
                "m": {"block_mm": 25.0, "gap_mm": 6.0},
                "l": {"block_mm": 25.0, "gap_mm": 11.0},
            },
            "ribs": [
                {"name": f"rib{index}", "sequence": sequence, "offset_mm": offset}
                for index, offset in enumerate(offsets)
            ],
        }
    )


def test_transform_of_triangle_is_sinc_squared():
    """A unit triangle of half width h about t = h: h sinc^2(w h / 2) exp(-i w h); exact but for rounding (1e-13)."""
    h = 0.003
    w = 2 * np.pi * np.array([0.0, 1e-6, 1.0, 50.0, 333.3, 1000.0, 2e4])
    found = transform(np.array([0.0, h, 2 * h]), np.array([0.0, 1.0, 0.0]), w)
    exact = h * np.sinc(w * h / 2 / np.pi) ** 2 * np.exp(-1j * w * h)
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-13 * h)


def test_transform_at_zero_frequency_is_the_integral():
    """int f dt of the trapezoids; equal but for rounding."""
    history = half_sine()
    found = transform(history.time, history.normal_force, np.zeros(1))[0]
    assert found == pytest.approx(integral(history.time, history.normal_force), rel=1e-14)


def test_uniform_pitch_has_lines_only_at_multiples_of_speed_over_pitch():
    """64 equal pitches: every line but orders 64, 128, ... vanishes; rounding is left."""
    sequence = uniform(64)
    stimulus = superpose(sequence, SPEED, lambda _: half_sine())
    pitch = 31.3e-3
    order = np.arange(stimulus.frequency.size)
    passing = order % 64 == 0
    for lines in (stimulus.normal_lines, stimulus.tangential_lines):
        sizes = amplitude(lines)
        assert sizes[~passing].max() < 1e-6 * sizes[passing].max()
        assert sizes[~passing].max() < 1e-12 * sizes[passing].max()
        assert sizes[64] > 1e-3 * sizes.max()
    np.testing.assert_allclose(stimulus.frequency[passing][1], SPEED / pitch, rtol=1e-12)
    assert stimulus.block_passing()[64] == "centre x1"
    assert stimulus.block_passing()[65] == ""


def test_uniform_pitch_time_signal_repeats_with_every_pitch():
    """F(t + pitch / V) = F(t): the step divides the pitch's time here (64 samples each), so equal but for rounding."""
    sequence = uniform(64)
    period = sequence.circumference / SPEED
    stimulus = superpose(sequence, SPEED, lambda _: half_sine(), longest_step=period / (64 * 40) * (1 + 1e-9))
    assert stimulus.time.size == 64 * 40
    by_pitch = stimulus.normal_force.reshape(64, 40)
    np.testing.assert_allclose(by_pitch, np.broadcast_to(by_pitch[0], by_pitch.shape), rtol=0, atol=1e-9)


@pytest.mark.parametrize("blocks", [1, 7, 64, 80])
def test_mean_force_is_block_impulse_times_block_rate(blocks):
    """Mean = impulse x V / pitch, the impulse by the trapezoid rule on its own; 1e-6 demanded, rounding found."""
    history = half_sine()
    stimulus = superpose(uniform(blocks), SPEED, lambda _: history)
    rate = SPEED / 31.3e-3
    for mean, force in (
        (stimulus.mean_normal_force, history.normal_force),
        (stimulus.mean_tangential_force, history.tangential_force),
    ):
        expected = float(np.trapezoid(force, history.time)) * rate
        assert mean == pytest.approx(expected, rel=1e-6)
        assert mean == pytest.approx(expected, rel=1e-12)


def test_mean_of_the_sampled_signal_is_the_mean_line():
    """Sampling a continuous piecewise-linear signal at 2 us errs by less than its kinks allow: 1e-6 of the mean."""
    stimulus = superpose(uniform(16), SPEED, lambda _: half_sine(), longest_step=2e-6)
    assert float(stimulus.normal_force.mean()) == pytest.approx(stimulus.mean_normal_force, rel=1e-6)


def test_lines_sum_up_to_the_time_signal():
    """Lines up to F rebuild the time signal but for their tail, at a kink of slope s at most s / (2 pi^2 F).

    The kinks are the steps of slope where a block enters or leaves (0.14 N of 200 N here, at 20 kHz), and one block
    enters as another leaves: two of them.
    """
    stimulus = superpose(mixed(list("smlmslls")), SPEED, lambda _: half_sine(), highest_frequency=20_000.0)
    orders = np.arange(1, stimulus.frequency.size)
    waves = np.exp(2j * np.pi * np.outer(stimulus.time / stimulus.period, orders))
    block = half_sine()
    for force, lines, own in (
        (stimulus.normal_force, stimulus.normal_lines, block.normal_force),
        (stimulus.tangential_force, stimulus.tangential_lines, block.tangential_force),
    ):
        kink = float(np.max(np.abs(np.diff(own) / np.diff(block.time))))
        rebuilt = lines[0].real + 2 * (waves @ lines[1:]).real
        assert np.max(np.abs(rebuilt - force)) < 2 * kink / (2 * np.pi**2 * 20_000.0)


def test_two_ribs_half_a_pitch_apart_cancel_odd_block_harmonics():
    """exp(-i pi k) = -1 for odd k: orders 64, 192, ... vanish and even ones double, exactly."""
    one = superpose(uniform(64), SPEED, lambda _: half_sine(), highest_frequency=1200.0)
    data = uniform(64).model_dump()
    data["ribs"] = [data["ribs"][0], {**data["ribs"][0], "name": "second", "offset_mm": 31.3 / 2}]
    two = superpose(PitchSequence.model_validate(data), SPEED, lambda _: half_sine(), highest_frequency=1200.0)
    assert abs(two.normal_lines[64]) < 1e-11 * abs(one.normal_lines[64])
    np.testing.assert_allclose(two.normal_lines[128], 2 * one.normal_lines[128], rtol=1e-9)


@settings(max_examples=40, deadline=None)
@given(st.lists(st.sampled_from("sml"), min_size=1, max_size=30), st.floats(2.0, 60.0))
def test_mean_force_of_any_sequence_is_the_sum_of_impulses_over_the_revolution(sequence, speed):
    """F_0 = n x impulse / T whatever the order of pitches; 1e-6 demanded, 1e-11 holds."""
    history = half_sine(samples=97)
    pitches = mixed(sequence)
    stimulus = superpose(pitches, speed, lambda _: history, highest_frequency=50.0)
    rate = len(sequence) * speed / pitches.circumference
    expected = float(np.trapezoid(history.normal_force, history.time)) * rate
    assert stimulus.mean_normal_force == pytest.approx(expected, rel=1e-11)


@settings(max_examples=25, deadline=None)
@given(st.floats(0.0, 200.0))
def test_offset_shifts_phase_and_leaves_amplitudes(offset):
    """A rib that starts later has the same lines times exp(-2 pi i n offset / circumference), to rounding."""
    base = superpose(mixed(list("smllm")), SPEED, lambda _: half_sine(samples=97))
    moved_sequence = mixed(list("smllm"), (offset,))
    moved = superpose(moved_sequence, SPEED, lambda _: half_sine(samples=97))
    order = np.arange(base.frequency.size)
    turn = np.exp(-2j * np.pi * order * offset * 1e-3 / moved_sequence.circumference)
    np.testing.assert_allclose(moved.normal_lines, base.normal_lines * turn, atol=1e-9 * abs(base.normal_lines[0]))


def test_first_order_response_to_uniform_pitch_meets_its_closed_form():
    """H = 1 / (1 + i w tau): the lines are the force's times H, and the response's mean is the force's.

    The impulse response exp(-t/tau)/tau is sampled at tau/2000 up to 20 tau and taken as linear between the samples,
    which errs by (dt/tau)^2/12 = 2e-8 of it: 1e-6 holds.
    """
    tau = 2e-3
    time = np.arange(40_001) * tau / 2000
    kernel = np.exp(-time / tau) / tau
    path = TransferFunction("velocity", "m/s", time=time, to_normal=kernel, to_tangential=np.zeros_like(time))
    stimulus = superpose(uniform(8), SPEED, lambda _: half_sine())
    response = respond(stimulus, path)
    exact = stimulus.normal_lines / (1 + 2j * np.pi * stimulus.frequency * tau)
    np.testing.assert_allclose(response.lines, exact, atol=1e-6 * abs(exact[0]))
    assert float(response.value.mean()) == pytest.approx(stimulus.mean_normal_force, rel=1e-6)


def test_impulse_response_and_its_transfer_function_give_one_response():
    """Two forms of the same path, the second tabled at the very lines: equal but for rounding."""
    tau = 3e-3
    time = np.linspace(0.0, 0.06, 3001)
    kernel = np.exp(-time / tau) * np.sin(2 * np.pi * 150 * time)
    path = TransferFunction("acceleration", "m/s2", time=time, to_normal=kernel, to_tangential=0.3 * kernel)
    stimulus = superpose(mixed(list("smlmslls")), SPEED, lambda _: half_sine())
    normal, tangential = path.at(stimulus.frequency)
    table = TransferFunction(
        "acceleration",
        "m/s2",
        frequency=stimulus.frequency,
        normal_ratio=normal,
        tangential_ratio=tangential,
    )
    first, second = respond(stimulus, path), respond(stimulus, table)
    np.testing.assert_allclose(first.value, second.value, rtol=0, atol=1e-12 * np.abs(first.value).max())


def test_response_equals_direct_convolution_in_time():
    """Numerical int h(s) F(t - s) ds on a 5 us grid against lines up to 20 kHz: 1e-4 of the peak, the grid's."""
    time = np.linspace(0.0, 0.03, 6001)
    kernel = np.exp(-time / 2e-3) * np.sin(2 * np.pi * 300 * time)
    path = TransferFunction("x", "m", time=time, to_normal=kernel, to_tangential=np.zeros_like(kernel))
    sequence = mixed(list("smlm"))
    period = sequence.circumference / SPEED
    stimulus = superpose(sequence, SPEED, lambda _: half_sine(), highest_frequency=20_000.0, longest_step=5e-6)
    step = period / stimulus.time.size
    delays = np.arange(0.0, 0.03, step)
    weights = np.interp(delays, time, kernel) * step
    wrapped = np.zeros(stimulus.time.size)
    np.add.at(wrapped, np.arange(delays.size) % stimulus.time.size, weights)
    direct = np.fft.irfft(np.fft.rfft(wrapped) * np.fft.rfft(stimulus.normal_force), stimulus.time.size)
    found = respond(stimulus, path).value
    assert np.max(np.abs(found - direct)) < 1e-4 * np.max(np.abs(direct))
