"""Channels with units, clocks, gaps, missed triggers and turning axes of their own."""

from __future__ import annotations

import runpy
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from nptdms import ChannelObject, RootObject, TdmsWriter

from tread_validate.errors import InputError
from tread_validate.reference.rig_axes import axle_fixed, wheel_angles
from tread_validate.reference.rig_passes import cut_passes
from tread_validate.reference.rig_record import RigRecord, read_record
from tread_validate.reference.rig_synthetic import record_csv, synthetic_record

CHANNELS = {"normal_force_N": "My Rig/Fz", "tangential_force_N": "My Rig/Fx", "trigger_V": "Box 2/Trig"}


@pytest.fixture(scope="module")
def record() -> RigRecord:
    return synthetic_record(revolutions=6).record


def tdms(path: Path, record: RigRecord, unit: str = "kN", slow: int = 1, offset: float = 0.0) -> Path:
    """Write forces in `unit`; the trigger at `slow` times the increment, its clock later by `offset` s."""
    step = 1.0 / record.sampling_rate
    scale = {"kN": 1e-3, "N": 1.0, "mV": 1.0}[unit]
    assert record.trigger is not None
    force = {"unit_string": unit, "wf_increment": step, "wf_start_offset": 0.0}
    late = round(offset / step)
    with TdmsWriter(path) as writer:
        writer.write_segment(
            [
                RootObject(),
                ChannelObject("My Rig", "Fz", scale * record.normal_force, force),
                ChannelObject("My Rig", "Fx", scale * record.tangential_force, force),
                ChannelObject(
                    "Box 2", "Trig", record.trigger[late::slow],
                    {"unit_string": "V", "wf_increment": slow * step, "wf_start_offset": offset},
                ),
            ]
        )  # fmt: skip
    return path


def test_kilonewtons_are_a_thousand_newtons(tmp_path: Path, record: RigRecord) -> None:
    """A channel's unit_string is honoured, in a group whose name has a blank: the same forces to rounding."""
    read = read_record(tdms(tmp_path / "a.tdms", record), CHANNELS)
    np.testing.assert_allclose(read.normal_force, record.normal_force, rtol=1e-12)
    assert "normal_force_N = channel 'My Rig/Fz' in kN" in read.understood


def test_a_voltage_is_no_force(tmp_path: Path, record: RigRecord) -> None:
    with pytest.raises(InputError, match=r"My Rig/Fz: unit_string: got the unit 'mV', expected a unit of normal"):
        read_record(tdms(tmp_path / "a.tdms", record, "mV"), CHANNELS)


def test_channels_with_other_clocks_are_brought_to_the_forces(tmp_path: Path, record: RigRecord) -> None:
    """A trigger sampled half as often, started 0.2 s later: every pass that is left keeps its peak to 0.1 %.

    The edge moves by up to a step of 0.1 ms in 200 ms, which stretches a pass by 0.05 %. The 0.2 s before are a gap,
    so the pass in it is left out.
    """
    whole = cut_passes(record)
    late = cut_passes(read_record(tdms(tmp_path / "a.tdms", record, slow=2, offset=0.2), CHANNELS))
    assert late.count == whole.count - 1
    np.testing.assert_allclose(late.normal_force.max(axis=1), whole.normal_force.max(axis=1)[1:], rtol=1e-3)


@pytest.mark.parametrize(
    ("heading", "unit"),
    [("time_s,normal_force_kN,tangential_force_kN,trigger_V", ""), ("t [ms],Fz [kN],Fx [kN],trig", ""),
     ("t;Fz;Fx;trig", "ms;kN;kN;V")],
)  # fmt: skip
def test_units_in_headings_or_in_a_row_below_are_honoured(
    heading: str, unit: str, tmp_path: Path, record: RigRecord
) -> None:
    """Latin-1 comments, commas or semicolons with decimal commas: the same forces to the digits written."""
    lines = record_csv(synthetic_record(revolutions=6)).splitlines()
    first = next(k for k, line in enumerate(lines) if line[0].isdigit() or line.startswith("-"))
    milli = 1e3 if "ms" in heading + unit else 1.0
    rows = []
    for line in lines[first:]:
        t, n, f, v = (float(cell) for cell in line.split(","))
        rows.append(f"{t * milli:.9g},{n / 1e3:.9g},{f / 1e3:.9g},{v:.6g}")
    text = "\n".join(rows)
    if ";" in heading:
        text = text.replace(",", ";").replace(".", ",")
    path = tmp_path / "record.csv"
    head = ["# Prüfer: Müller", heading, *([unit] if unit else [])]
    path.write_bytes("\n".join([*head, text]).encode("latin-1"))
    names = {} if heading.startswith("time_s") else {
        "time_s": "t", "normal_force_N": "Fz", "tangential_force_N": "Fx", "trigger_V": "trig"}  # fmt: skip
    read = read_record(path, names)
    np.testing.assert_allclose(read.normal_force, record.normal_force, atol=0.006)  # the text keeps 0.01 N
    assert read.sampling_rate == pytest.approx(record.sampling_rate, rel=1e-6)


def test_missing_samples_are_gaps_and_their_passes_are_left_out(tmp_path: Path) -> None:
    """Ten rows cut out and three cells emptied in two revolutions of eight: two passes fewer, the same mean."""
    lines = record_csv(synthetic_record(revolutions=8)).splitlines()
    whole_path, path = tmp_path / "whole.csv", tmp_path / "gaps.csv"
    whole_path.write_text("\n".join(lines))
    whole = cut_passes(read_record(whole_path))
    for row in (12001, 12002, 12003):
        t, _, f, v = lines[row].split(",")
        lines[row] = f"{t},,{f},{v}"
    del lines[5000:5010]
    path.write_text("\n".join(lines))
    passes = cut_passes(read_record(path))
    assert passes.passes_in_gaps == 2
    assert passes.count == whole.count - 2
    assert passes.peak_normal_force.mean == pytest.approx(whole.peak_normal_force.mean, rel=0.02)


def test_missed_and_false_triggers_do_not_cost_a_pass(record: RigRecord) -> None:
    """One pulse wiped out and one of noise added: the same passes, both told."""
    assert record.trigger is not None
    trigger = record.trigger.copy()
    high = trigger > 0.5 * trigger.max()
    rises = np.flatnonzero(~high[:-1] & high[1:])
    trigger[rises[2] - 5 : rises[2] + 200][high[rises[2] - 5 : rises[2] + 200]] = trigger.min()
    trigger[rises[3] + 500 : rises[3] + 505] = trigger.max()
    whole, passes = cut_passes(record), cut_passes(replace(record, trigger=trigger))
    assert (passes.missed_triggers, passes.false_triggers) == (1, 1)
    assert passes.count == whole.count
    assert passes.peak_normal_force.mean == pytest.approx(whole.peak_normal_force.mean, rel=2e-3)


def test_a_revolution_without_contact_is_left_out(record: RigRecord) -> None:
    """The block lifted for one revolution: that pass is left out, and those not beside it keep their peaks to 0.1 %."""
    whole = cut_passes(record)
    rate = record.sampling_rate
    normal = record.normal_force.copy()
    middle = int((2.5 * 60.0 / 300.0 / 1.0) * rate * 0.4)
    third = slice(int(2 * 0.2 * rate) + middle % 1, int(3 * 0.2 * rate))
    normal[third] = np.median(normal)
    passes = cut_passes(replace(record, normal_force=normal))
    assert (passes.passes_without_contact, passes.count) == (1, whole.count - 1)
    peaks, before = passes.normal_force.max(axis=1), whole.normal_force.max(axis=1)
    np.testing.assert_allclose(peaks[[0, 2, 3]], before[[0, 3, 4]], rtol=1e-3)
    assert peaks[1] == pytest.approx(before[2], rel=0.01)  # its free running lacks what was lifted


@pytest.mark.parametrize("direction", [1, -1])
def test_forces_of_a_turning_cell_come_back_in_axes_fixed_to_the_axle(direction: int) -> None:
    """Turned into the wheel's axes and back, contact at 120 degrees: to 1 % of the peak (steps of 0.25 N).

    Unturned, T is wrong by 8.2 % of the largest N: by N sin t, largest at 5.3 degrees, where N is 0.89 of its peak.
    """
    record = synthetic_record(revolutions=6, drift=0.0, noise=0.0).record
    angle = wheel_angles(record)
    zero = 2.0 * np.pi / 3.0
    quiet = replace(
        record,
        normal_force=record.normal_force - np.median(record.normal_force),
        tangential_force=record.tangential_force - np.median(record.tangential_force),
    )
    t = direction * (np.mod(angle - zero + np.pi, 2 * np.pi) - np.pi)
    n, f = quiet.normal_force, quiet.tangential_force
    cell = replace(quiet, normal_force=n * np.cos(t) + f * np.sin(t), tangential_force=f * np.cos(t) - n * np.sin(t))
    back = axle_fixed(cell, zero, direction)
    assert np.max(np.abs(back.normal_force - n)) < 0.01 * n.max()
    assert np.max(np.abs(back.tangential_force - f)) < 0.01 * n.max()
    assert np.max(np.abs(cell.tangential_force - f)) == pytest.approx(0.082 * n.max(), rel=0.03)


def test_half_width_of_a_mean_peak_adds_passes_noise_and_cell(record: RigRecord) -> None:
    """Student's factor times the deviation over the root of n, the noise, and the cell's share, in squares."""
    passes = cut_passes(record)
    spread = passes.peak_normal_force
    without, half = passes.half_width(spread), passes.half_width(spread, 0.01)
    assert half**2 - without**2 == pytest.approx((0.01 * spread.mean) ** 2)
    assert without > 2.0 * spread.deviation / np.sqrt(passes.count)


def test_the_worked_example_gives_the_peaks_of_its_page(root: Path, tmp_path: Path) -> None:
    """Drift, noise, a gap, a missed pass and a turning cell: peaks within their half-widths of those without faults."""
    path = tmp_path / "synthetic_faulty.csv"
    made = runpy.run_path(str(root / "examples" / "rig_record" / "make_record.py"))
    made["main"](path)
    names = {"time_s": "t", "normal_force_N": "Fn", "tangential_force_N": "Ft", "wheel_angle_deg": "phi"}
    faulty = read_record(path, names)
    clean = cut_passes(synthetic_record(revolutions=12, drift=0.0).record)
    passes = cut_passes(axle_fixed(faulty, np.radians(made["ZERO"])))
    assert (passes.passes_in_gaps, passes.passes_without_contact, passes.count) == (1, 1, 9)
    for name in ("peak_normal_force", "largest_tangential_force", "least_tangential_force"):
        spread = getattr(passes, name)
        assert abs(spread.mean - getattr(clean, name).mean) < passes.half_width(spread)
    turning = cut_passes(faulty).largest_tangential_force
    assert turning.mean > 1.2 * clean.largest_tangential_force.mean


def test_lines_of_the_instrument_above_the_heading_are_passed_over(tmp_path: Path, record: RigRecord) -> None:
    """Latin-1, semicolons, decimal commas, two lines above: the same forces."""
    assert record.trigger is not None
    time = np.arange(record.normal_force.size) / record.sampling_rate
    rows = "\n".join(
        f"{a:.4f};{n:.2f};{f:.2f};{v:.3f}".replace(".", ",")
        for a, n, f, v in zip(time, record.normal_force, record.tangential_force, record.trigger, strict=True)
    )
    path = tmp_path / "export.csv"
    path.write_text(f"Prüfstand 2\nDatum;25.11.2026\nZeit [s];Fz [N];Fx [N];Puls [V]\n{rows}\n", encoding="latin-1")
    names = {"time_s": "Zeit", "normal_force_N": "Fz", "tangential_force_N": "Fx", "trigger_V": "Puls"}
    read = read_record(path, names)
    np.testing.assert_allclose(read.normal_force, record.normal_force, atol=1e-9)
    assert read.sampling_rate == pytest.approx(record.sampling_rate, rel=1e-6)
