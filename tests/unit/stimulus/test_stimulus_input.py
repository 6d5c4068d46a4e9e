"""What the stimulus refuses, and how it says so."""

from __future__ import annotations

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.history import History
from tread_validate.stimulus import (
    PitchSequence,
    load_pitch_sequence,
    read_impulse_response,
    read_transfer_function,
    respond,
    superpose,
)
from tread_validate.stimulus.blocks import belt_case, by_history, by_model
from tread_validate.stimulus.output import force_csv, spectrum_csv, summary_rows

PITCH = """\
schema_version: 1
name: two_ribs
origin: assumed
source: a test
pitches:
  short: {block_mm: 20.0, gap_mm: 5.0}
  long: {block_mm: 25.0, gap_mm: 5.0}
ribs:
  - {name: left, sequence: [short, long], repeat: 3}
  - {name: right, sequence: [long, long, long, short, short, short], offset_mm: 4.0, width_mm: 15.0}
"""


def pulse(duration: float = 0.01) -> History:
    time = np.linspace(0.0, duration, 101)
    return History(time, 100 * np.sin(np.pi * time / duration).clip(0), np.zeros(101), np.zeros(101))


def write(folder, text, name="pitch.yaml"):
    path = folder / name
    path.write_text(text)
    return path


def test_positions_run_round_the_tyre_against_the_travel(tmp_path):
    """Left rib: leading ends at 0, 25, 55, 80, 110, 135 mm; 165 mm round; the right rib begins 4 mm later."""
    sequence = load_pitch_sequence(write(tmp_path, PITCH))
    assert sequence.circumference == pytest.approx(0.165)
    by_key = {(p.rib, round(p.block_length * 1e3)): p for p in sequence.placements()}
    assert by_key["left", 20].positions == pytest.approx((0.0, 0.055, 0.110))
    assert by_key["left", 25].positions == pytest.approx((0.025, 0.080, 0.135))
    assert by_key["right", 20].positions == pytest.approx((0.094, 0.119, 0.144))
    assert by_key["right", 25].block_width == pytest.approx(0.015)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("sequence: [short, long]", "sequence: [short, lnog]", "ribs[0].sequence: got lnog"),
        ("repeat: 3", "repeat: 4", "ribs[1]: got 165 mm round the tyre, expected 220 mm"),
        ("gap_mm: 5.0}\n  long", "gap_mm: -1}\n  long", "pitches.short.gap_mm: got -1"),
        ("block_mm: 20.0", "block_mm: .nan", "pitches.short.block_mm: got nan"),
        ("name: right", "name: left", "ribs: got one name twice"),
        ("repeat: 3", "repeat: 3000", "ribs[0]: got 6000 blocks"),
        ("schema_version: 1", "schema_version: 2", "schema_version: got 2"),
        ("offset_mm", "ofset_mm", "ofset_mm"),
    ],
)
def test_wrong_pitch_file_is_one_line_with_the_key(tmp_path, old, new, says):
    path = write(tmp_path, PITCH.replace(old, new))
    with pytest.raises(InputError) as fault:
        load_pitch_sequence(path)
    assert says in str(fault.value)
    assert "\n" not in str(fault.value)


def test_cut_off_history_is_refused(tmp_path):
    """A pass that ends with the block still in contact would put a false step into every block's force."""
    sequence = load_pitch_sequence(write(tmp_path, PITCH))
    whole = pulse()
    cut = History(whole.time[:60], whole.normal_force[:60], whole.tangential_force[:60], whole.slipping_fraction[:60])
    with pytest.raises(InputError, match="last sample"):
        superpose(sequence, 10.0, lambda _: cut)


def test_history_without_contact_is_refused(tmp_path):
    sequence = load_pitch_sequence(write(tmp_path, PITCH))
    none = History(np.arange(3.0), np.zeros(3), np.zeros(3), np.zeros(3))
    with pytest.raises(InputError, match="touches the road"):
        superpose(sequence, 10.0, lambda _: none)


@pytest.mark.parametrize("speed", [0.0, -1.0, float("nan"), float("inf")])
def test_speed_must_be_positive(tmp_path, speed):
    with pytest.raises(InputError, match="speed"):
        superpose(load_pitch_sequence(write(tmp_path, PITCH)), speed, lambda _: pulse())


def test_files_carry_units_and_mark_block_passing(tmp_path):
    """Left rib: 6 blocks in 165 mm at 10 m/s: order 6 at 363.6 Hz is its first block-passing line."""
    sequence = load_pitch_sequence(write(tmp_path, PITCH))
    stimulus = superpose(sequence, 10.0, lambda _: pulse(), label="m", provenance={"case_id": "c"})
    lines = spectrum_csv(stimulus).splitlines()
    assert lines[0] == "# case_id: c"
    assert lines[1].startswith("order,frequency_Hz,normal_amplitude_N")
    assert lines[2 + 6].startswith("6,363.636364,")
    assert lines[2 + 6].endswith(",left x1; right x1")
    assert force_csv(stimulus).splitlines()[1] == "time_s,normal_force_N,tangential_force_N"
    row = summary_rows(stimulus)[0]
    assert row["mean_normal_force_N"] == pytest.approx(row["normal_impulse_times_rate_N"], rel=1e-12)


IMPULSE = "# quantity: hub force\n# unit: N\ntime_s,to_normal,to_tangential\n0,0,0\n0.001,100,10\n0.002,0,0\n"


def test_impulse_response_file_reads_with_its_unit(tmp_path):
    path = read_impulse_response(write(tmp_path, IMPULSE, "h.csv"))
    assert (path.quantity, path.unit) == ("hub force", "N")
    normal, _ = path.at(np.zeros(1))
    assert normal[0] == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (IMPULSE.replace("0.002,0,0", "0.002,50,0"), "died away"),
        (IMPULSE.replace("0,0,0\n0.001", "-1,0,0\n0.001"), "before the impulse"),
        (IMPULSE.replace("0.002,0,0", "0.001,0,0"), "above the one before"),
        (IMPULSE.replace("100", "nan"), ":5: to_normal: got an empty cell"),
        (IMPULSE.replace("100", "x"), ":5: to_normal: got 'x', expected a number"),
        (IMPULSE.replace(",10\n", "\n"), ":5: got 2 cells"),
        (IMPULSE.replace("to_normal,", "normal,"), "expected column to_normal"),
    ],
)
def test_wrong_impulse_response_is_refused(tmp_path, text, says):
    with pytest.raises(InputError) as fault:
        read_impulse_response(write(tmp_path, text, "h.csv"))
    assert says in str(fault.value)


def test_transfer_function_must_reach_the_highest_line(tmp_path):
    head = "frequency_Hz,to_normal_real,to_normal_imag,to_tangential_real,to_tangential_imag\n"
    function = read_transfer_function(write(tmp_path, head + "10,1,0,0,0\n500,1,0,0,0\n", "t.csv"))
    stimulus = superpose(load_pitch_sequence(write(tmp_path, PITCH)), 10.0, lambda _: pulse())
    with pytest.raises(InputError, match="at least"):
        respond(stimulus, function)


def test_lines_below_the_transfer_function_are_left_out(tmp_path):
    """A function from 100 Hz has no static part: the response's mean is 0 and the file says from where it holds."""
    head = "frequency_Hz,to_normal_real,to_normal_imag,to_tangential_real,to_tangential_imag\n"
    function = read_transfer_function(write(tmp_path, head + "100,1,0,0,0\n1500,1,0,0,0\n", "t.csv"))
    stimulus = superpose(load_pitch_sequence(write(tmp_path, PITCH)), 10.0, lambda _: pulse())
    response = respond(stimulus, function)
    assert response.lowest_frequency == 100.0
    assert response.lines[0] == 0.0
    np.testing.assert_allclose(response.lines[2:], stimulus.normal_lines[2:])


def test_model_runs_once_per_block_size(tmp_path, belt):
    """Two lengths on the left rib, two of another width on the right: four runs, each with its own block."""
    sequence = load_pitch_sequence(write(tmp_path, PITCH))
    asked: list[tuple[float, float]] = []

    def run(case):
        asked.append((round(case.block.length_mm, 9), round(case.block.width_mm, 9)))
        return pulse()

    superpose(sequence, belt.speed, by_model(belt, run))
    assert sorted(asked) == [(20.0, 15.0), (20.0, 20.0), (25.0, 15.0), (25.0, 20.0)]


def test_given_history_serves_its_own_block_only(tmp_path, belt):
    sequence = load_pitch_sequence(write(tmp_path, PITCH))
    with pytest.raises(InputError, match="20 x 20 mm"):
        superpose(sequence, belt.speed, by_history(belt, pulse(), "fe.csv"))
    own = PitchSequence.model_validate({**sequence.model_dump(), "ribs": [{"name": "a", "sequence": ["long"]}]})
    assert superpose(own, belt.speed, by_history(belt, pulse(), "fe.csv")).mean_normal_force > 0


def test_rig_case_is_no_tyre(rig):
    with pytest.raises(InputError, match="belt"):
        belt_case(rig)
