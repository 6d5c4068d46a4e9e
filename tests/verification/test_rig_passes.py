"""Passes cut from rig records against the exact forces behind them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate.reference.rig_passes import cut_passes, low_pass
from tread_validate.reference.rig_record import read_record
from tread_validate.reference.rig_synthetic import SyntheticRig, record_csv, synthetic_record, write_tdms

FIRST = 2  # the record starts too late for the passes before


@pytest.fixture(scope="module")
def rig() -> SyntheticRig:
    return synthetic_record()


def test_filter_halves_the_power_at_its_cutoff_and_shifts_nothing() -> None:
    """A sine at the cut-off keeps 1/sqrt 2 of its amplitude and its zero crossings; at a tenth of it, all of it.

    1e-3 is left for the ends of the record, 20 periods away.
    """
    rate, cutoff = 10e3, 500.0
    t = np.arange(20_000) / rate
    middle = slice(8000, 12_000)
    for frequency, gain in ((cutoff, 1 / np.sqrt(2)), (0.1 * cutoff, 1.0)):
        sine, cosine = np.sin(2 * np.pi * frequency * t), np.cos(2 * np.pi * frequency * t)
        out = low_pass(sine, rate, cutoff)[middle]
        assert 2 * np.mean(out * sine[middle]) == pytest.approx(gain, abs=1e-3)
        assert 2 * np.mean(out * cosine[middle]) == pytest.approx(0.0, abs=1e-3)


def test_mean_pass_is_the_exact_force(rig: SyntheticRig) -> None:
    """Noise 0.6 N, drift 10 N, 12-bit steps: the mean of seven passes within 4 % of the exact peak everywhere.

    The largest part of that is first contact, extrapolated 0.1 ms early; the plateau itself is within 1 %.
    """
    passes = cut_passes(rig.record)
    kept = rig.peaks[FIRST : FIRST + passes.count].mean() / rig.normal_force.max()
    exact = np.interp(passes.time, rig.time, rig.normal_force, 0.0, 0.0) * kept
    mean, peak = passes.normal_force.mean(axis=0), exact.max()
    assert np.max(np.abs(mean - exact)) < 0.04 * peak
    plateau = exact > 0.999 * peak
    assert np.max(np.abs(mean[plateau] - peak)) < 0.01 * peak
    assert passes.contact_duration == pytest.approx(rig.time[-1], rel=0.03)


def test_every_pass_keeps_its_own_peak(rig: SyntheticRig) -> None:
    """Peaks of the passes vary by 3 %: least and largest of the seven within 2 % of the exact ones (filtered noise)."""
    passes = cut_passes(rig.record)
    exact = rig.peaks[FIRST : FIRST + passes.count]
    np.testing.assert_allclose(passes.normal_force.max(axis=1), exact, rtol=0.02)
    assert passes.peak_normal_force.least == pytest.approx(exact.min(), rel=0.02)
    assert passes.peak_normal_force.largest == pytest.approx(exact.max(), rel=0.02)


def test_tangential_force_changes_sign_where_the_exact_one_does(rig: SyntheticRig) -> None:
    """Positive while the block loads, negative while it unloads; extremes within 5 % of the exact ones' mean."""
    passes = cut_passes(rig.record)
    scale = rig.peaks[FIRST : FIRST + passes.count].mean() / rig.normal_force.max()
    assert passes.largest_tangential_force.mean == pytest.approx(rig.tangential_force.max() * scale, rel=0.05)
    assert passes.least_tangential_force.mean == pytest.approx(rig.tangential_force.min() * scale, rel=0.05)


def test_drift_does_not_reach_the_result(rig: SyntheticRig) -> None:
    """Offset, trend and one slow wave added to the record: peaks move by less than 0.5 % (the wave's bend)."""
    n = rig.record.normal_force.size
    t = np.linspace(0, 1, n)
    drifted = replace(rig.record, normal_force=rig.record.normal_force + 25.0 - 12.0 * t + 2.0 * np.sin(5 * t))
    plain, moved = cut_passes(rig.record), cut_passes(drifted)
    assert moved.peak_normal_force.mean == pytest.approx(plain.peak_normal_force.mean, rel=0.005)
    assert moved.drift > plain.drift + 5.0


@pytest.mark.parametrize("rpm", [150.0, 600.0])
def test_speed_is_read_from_the_triggers(rpm: float) -> None:
    """One pulse a revolution: rpm to 0.1 % (a tenth of a sample in 1000)."""
    passes = cut_passes(synthetic_record(speed_rpm=rpm).record)
    assert passes.speed_rpm == pytest.approx(rpm, rel=1e-3)


def test_wheel_angle_serves_in_place_of_a_trigger(rig: SyntheticRig) -> None:
    """The same passes come from the angle, wrapped at a turn: peaks to 0.1 %."""
    by_angle = cut_passes(replace(rig.record, trigger=None))
    by_trigger = cut_passes(rig.record)
    assert by_angle.peak_normal_force.mean == pytest.approx(by_trigger.peak_normal_force.mean, rel=1e-3)
    assert by_angle.count in (by_trigger.count, by_trigger.count + 1, by_trigger.count - 1)


def test_csv_and_tdms_hold_one_record(rig: SyntheticRig, tmp_path: Path) -> None:
    """Steps of 0.25 N are exact in both files, so the peaks agree to 1e-6; conditions travel as properties."""
    (tmp_path / "record.csv").write_text(record_csv(rig), encoding="utf-8")
    write_tdms(tmp_path / "record.tdms", rig)
    text, binary = (read_record(tmp_path / name) for name in ("record.csv", "record.tdms"))
    np.testing.assert_allclose(binary.normal_force, text.normal_force, atol=1e-9)
    assert cut_passes(binary).peak_normal_force.mean == pytest.approx(cut_passes(text).peak_normal_force.mean, rel=1e-6)
    assert binary.comments["shape"] == text.comments["shape"] == "rectangle"
