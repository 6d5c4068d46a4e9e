"""Rig records that are refused, and what is kept of one that is imported."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tread_validate.errors import InputError
from tread_validate.reference.rig import load_rig, peak_row, write_rig
from tread_validate.reference.rig_passes import cut_passes
from tread_validate.reference.rig_record import RigRecord, read_record
from tread_validate.reference.rig_synthetic import record_csv, synthetic_record, write_tdms

CONDITIONS = {"shape": "rectangle", "temperature_degC": "22", "interference_mm": "0.2", "speed_m_s": "3.14159"}
Lines = list[str]


@pytest.fixture(scope="module")
def text() -> str:
    return record_csv(synthetic_record(revolutions=4))


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory, text: str) -> RigRecord:
    path = tmp_path_factory.mktemp("rig") / "record.csv"
    path.write_text(text, encoding="utf-8")
    return read_record(path)


def without_trigger(lines: Lines) -> None:
    for k in range(6, len(lines)):
        lines[k] = lines[k].rsplit(",", 1)[0]


def clipped(lines: Lines) -> None:
    for k in range(7, len(lines)):
        t, n, f, v = lines[k].split(",")
        lines[k] = f"{t},{min(float(n), 60.0):.2f},{f},{v}"


def uneven(lines: Lines) -> None:
    for k in range(300, len(lines)):
        t, rest = lines[k].split(",", 1)
        lines[k] = f"{float(t) + 5e-5:.6f},{rest}"


def dead(lines: Lines) -> None:
    for k in range(7, len(lines)):
        t, n, _, v = lines[k].split(",")
        lines[k] = f"{t},{n},0.00,{v}"


def short(lines: Lines) -> None:
    del lines[100:]


@pytest.mark.parametrize(
    ("alter", "reason"),
    [
        (without_trigger, r"record.csv:7: got a record without a trigger"),
        (clipped, r"normal_force_N: got \d+ samples in a row at 60 N, \d+ in all: clipped"),
        (uneven, r"record.csv:301: time_s: got a step of 0.00015 s, expected even sampling, 0.0001 s"),
        (dead, r"tangential_force_N: got 0 N throughout"),
        (short, "at least 200"),
    ],
)
def test_wrong_records_are_refused(tmp_path: Path, text: str, alter: Callable[[Lines], None], reason: str) -> None:
    lines = text.splitlines()
    alter(lines)
    path = tmp_path / "record.csv"
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(InputError, match=reason):
        read_record(path)


def test_damaged_tdms_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "record.tdms"
    path.write_bytes(b"TDSm\x00\x01garbage that is no TDMS file at all")
    with pytest.raises(InputError, match=r"record.tdms"):
        read_record(path)
    with pytest.raises(InputError, match="no such file"):
        read_record(tmp_path / "none.tdms")


def test_tdms_channels_go_by_their_own_names(tmp_path: Path) -> None:
    path = tmp_path / "record.tdms"
    write_tdms(path, synthetic_record(revolutions=4))
    with pytest.raises(InputError, match="channel Fz"):
        read_record(path, {"normal_force_N": "Fz"})
    assert read_record(path, {"normal_force_N": "Rig/normal_force_N"}).normal_force.size > 1000
    with pytest.raises(InputError, match="an unknown name"):
        read_record(path, {"force": "Fz"})


@pytest.mark.parametrize(
    ("alter", "reason"),
    [
        (lambda r: replace(r, trigger=np.zeros_like(r.trigger)), "a trigger between 0 and 0 V"),
        (lambda r: replace(r, trigger=np.where(np.arange(r.trigger.size) < 3, 0.0, 5.0)), "at least 3"),
        (lambda r: replace(r, normal_force=np.random.default_rng(1).normal(size=r.trigger.size)), "contact|noise"),
    ],
)
def test_records_without_usable_passes_are_refused(
    record: RigRecord, alter: Callable[[RigRecord], RigRecord], reason: str
) -> None:
    with pytest.raises(InputError, match=reason):
        cut_passes(alter(record))


@pytest.mark.parametrize("cutoff", [0.0, -5.0, 4500.0])
def test_a_cutoff_beyond_the_sampling_is_refused(record: RigRecord, cutoff: float) -> None:
    with pytest.raises(InputError, match="cut-off"):
        cut_passes(record, cutoff)


def test_imported_record_is_loaded_as_a_reference(tmp_path: Path, record: RigRecord) -> None:
    passes = cut_passes(record)
    write_rig(tmp_path, "one", passes, "synthetic", "a test", "rig-x", CONDITIONS, {"input": "record.csv"})
    (found,) = load_rig(tmp_path)
    assert (found.name, found.origin) == ("one", "synthetic")
    assert found.history.normal_force.max() == pytest.approx(passes.normal_force.mean(axis=0).max(), abs=1e-4)
    assert found.record["peaks"]["peak_normal_force_N"] == pytest.approx(passes.peak_normal_force.mean, abs=1e-3)
    history = tmp_path / "one.csv"
    history.write_text(history.read_text(encoding="utf-8").replace("0.0", "0.1", 1), encoding="utf-8")
    with pytest.raises(InputError, match="another checksum"):
        load_rig(tmp_path)


def test_error_bars_are_the_least_and_largest_pass(record: RigRecord) -> None:
    passes = cut_passes(record)
    row = peak_row(passes, "rig", "rig-x", CONDITIONS)
    assert row["peak_normal_force_min_N"] <= row["peak_normal_force_N"] <= row["peak_normal_force_max_N"]
    assert row["peak_normal_force_max_N"] == pytest.approx(passes.normal_force.max(), abs=1e-3)
