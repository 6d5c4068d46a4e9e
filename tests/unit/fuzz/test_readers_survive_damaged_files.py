"""Every reader on damaged files: a reading that makes sense or one line of refusal, never a traceback or a hang.

Files are copied with one to four faults each (tests/unit/fuzz/mutations.py). What is accepted is compared with what
any such file must say: finite numbers, order, ranges. 2,000 inputs for each reader run with `make verify`, 60 here.
"""

from __future__ import annotations

import importlib.util
import random
import signal
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tread_validate.calculix import read_elastic_deck
from tread_validate.deck.lint import lint
from tread_validate.errors import InputError
from tread_validate.fe.model import read_model
from tread_validate.friction.law_file import read_friction
from tread_validate.friction.table_file import read_friction_table
from tread_validate.geometry.belt_file import read_belt
from tread_validate.geometry.trace_import import read_ridges
from tread_validate.history import History
from tread_validate.inp import read_deck
from tread_validate.material.material_file import read_material
from tread_validate.material.sweeps import read_export
from tread_validate.reference.abaqus import load_settings, read_table
from tread_validate.reference.rig_record import read_record
from tread_validate.stimulus import load_pitch_sequence, read_impulse_response, read_transfer_function
from tread_validate.study import load_study

ROOT = Path(__file__).resolve().parents[3]
LONGEST = 20  # s for one input, on a busy machine
spec = importlib.util.spec_from_file_location("mutations", Path(__file__).with_name("mutations.py"))
assert spec is not None
assert spec.loader is not None
mutations = importlib.util.module_from_spec(spec)
spec.loader.exec_module(mutations)


@dataclass(frozen=True)
class Reader:
    name: str
    suffix: str
    seed: Callable[[], bytes]
    read: Callable[[Path], Any]
    sound: Callable[[Any], bool]


def file(name: str) -> Callable[[], bytes]:
    return lambda: (ROOT / name).read_bytes()


def rising(values: Any) -> bool:
    return bool(np.all(np.isfinite(values)) and np.all(np.diff(values) > 0))


def finite(*arrays: Any) -> bool:
    return all(bool(np.all(np.isfinite(array))) for array in arrays)


def history() -> bytes:
    time = np.linspace(0.0, 0.01, 40)
    force = 200 * np.sin(np.pi * time / 0.01).clip(0)
    return History(time, force, 0.3 * force, np.zeros(40), {"case_id": "a"}).to_csv().encode()


def deck() -> bytes:
    source = importlib.util.spec_from_file_location("d", ROOT / "tests" / "unit" / "calculix" / "conftest.py")
    assert source is not None
    assert source.loader is not None
    decks = importlib.util.module_from_spec(source)
    source.loader.exec_module(decks)
    return str(decks.PRESS.format(block=decks.block_text(2, 1, 2), friction=0.5, speed=1.0)).encode()


def tdms() -> bytes:
    import io

    from nptdms import ChannelObject, RootObject, TdmsWriter

    rng = np.random.default_rng(0)
    angle = np.linspace(0, 40.0, 400)
    force = 50 + 30 * np.sin(angle) + rng.normal(0, 0.3, 400)
    stream = io.BytesIO()
    with TdmsWriter(stream) as writer:
        channels = [
            ChannelObject("rig", name, values)
            for name, values in (
                ("time_s", np.arange(400) * 1e-3),
                ("normal_force_N", force),
                ("tangential_force_N", 0.3 * force),
                ("wheel_angle_rad", angle),
            )
        ]
        writer.write_segment([RootObject(properties={"origin": "synthetic"}), *channels])
    return stream.getvalue()


def record_text() -> bytes:
    return b"\n".join((ROOT / "reference_data/rig/synthetic_record.csv").read_bytes().split(b"\n")[:420])


def tdms_record(path: Path) -> Any:
    names = ("time_s", "normal_force_N", "tangential_force_N", "wheel_angle_rad")
    return read_record(path, {name: f"rig/{name}" for name in names})


def given_or_not(*columns: Any) -> bool:
    """Whether each column is a history's or, its heading damaged, left out of it throughout."""
    return all(bool(np.isnan(column).all()) or finite(column) for column in columns)


def study_with_cases(path: Path) -> Any:
    study = load_study(path)
    study.cases()  # what cannot be is refused here at the latest
    return study


def study_is_sound(study: Any) -> bool:
    cases = study.cases()
    return bool(cases) and all(
        np.isfinite([case.speed, case.interference, case.temperature]).all()
        and case.speed > 0
        and 0 < case.interference < case.height
        for case in cases
    )


def impulse() -> bytes:
    return b"# quantity: hub force\n# unit: N\ntime_s,to_normal,to_tangential\n" + b"".join(
        b"%.4f,%.5f,%.5f\n" % (0.001 * i, np.exp(-i / 4) * np.sin(i), 0.2 * np.exp(-i / 4)) for i in range(40)
    )


def model_is_sound(model: Any) -> bool:
    return model is not None


READERS = (
    Reader("study", ".yaml", file("config/study.yaml"), study_with_cases, study_is_sound),
    Reader("own study", ".yaml", file("tests/workflow/slurm/study.yaml"), study_with_cases, study_is_sound),
    Reader("deck syntax", ".inp", deck, read_deck, lambda d: all(block.keyword for block in d.blocks)),
    Reader("deck for the engine", ".inp", deck, read_model, model_is_sound),
    Reader("deck for CalculiX", ".inp", deck, read_elastic_deck, lambda d: d.young == d.young and len(d.nodes) >= 8),
    Reader("deck for lint", ".inp", deck, lint, lambda findings: isinstance(findings, list)),
    Reader(
        "history", ".csv", history, History.read_csv,
        lambda h: rising(h.time) and finite(h.normal_force) and given_or_not(h.tangential_force, h.slipping_fraction),
    ),
    Reader(
        "DMA sweeps", ".csv", file("reference_data/material/synthetic_sweeps.csv"), lambda path: read_export(path)[0],
        lambda sweeps: all(rising(s.angular_frequency) and (s.storage_modulus > 0).all() for s in sweeps),
    ),
    Reader(
        "material", ".yaml", file("reference_data/material/synthetic_material.yaml"), read_material,
        lambda m: m is not None,
    ),
    Reader(
        "friction table", ".csv", file("reference_data/friction/synthetic_tribometer.csv"), read_friction_table,
        lambda t: finite(t.pressure, t.slip_speed, t.coefficient) and bool((t.coefficient > 0).all()),
    ),
    Reader(
        "friction law", ".yaml", file("reference_data/friction/synthetic_friction.yaml"), read_friction,
        lambda f: f is not None,
    ),
    Reader(
        "ridges", ".csv", file("reference_data/belt/synthetic_ridges.csv"), read_ridges, lambda r: rising(r.position),
    ),
    Reader(
        "belt", ".yaml", file("reference_data/belt/synthetic_belt.yaml"), read_belt,
        lambda traces: all(rising(x) and finite(y) for x, y in traces.values()),
    ),
    Reader(
        "rig record", ".csv", record_text, read_record,
        lambda r: r.sampling_rate > 0 and finite(r.normal_force, r.tangential_force),
    ),
    Reader(
        "TDMS record", ".tdms", tdms, tdms_record,
        lambda r: r.sampling_rate > 0 and finite(r.normal_force, r.tangential_force),
    ),
    Reader(
        "XY report", ".rpt", file("examples/own_study/data/synthetic_forces.rpt"), read_table,
        lambda t: rising(t.values[:, 0]) and not np.isinf(t.values).any(),  # NoValue is refused where it is used
    ),
    Reader("engine settings", ".yaml", lambda: b"abaqus: {command: abq, cpus: 2, licence_wait_s: 5}\n", load_settings,
           lambda s: s.cpus >= 1 and s.licence_wait_s >= 0),
    Reader(
        "pitch sequence", ".yaml", file("examples/own_study/pitch_mixed.yaml"), load_pitch_sequence,
        lambda s: 0 < s.circumference < float("inf") and bool(s.placements()),
    ),
    Reader("impulse response", ".csv", impulse, read_impulse_response, lambda t: rising(t.time)),
    Reader(
        "transfer function", ".csv", file("examples/own_study/data/synthetic_hub.csv"), read_transfer_function,
        lambda t: rising(t.frequency) and finite(t.normal_ratio),
    ),
)  # fmt: skip


class HangError(BaseException):
    """Not an Exception: nothing in a reader may swallow it."""


def _hang(*_: object) -> None:
    raise HangError


def survive(reader: Reader, folder: Path, count: int, first: int = 0) -> tuple[int, int]:
    """Feed `count` damaged files to a reader; return how many it refused and accepted."""
    seed = reader.seed()
    others = [other.seed() for other in READERS if other.suffix != reader.suffix]
    path = folder / f"input{reader.suffix}"
    refused = accepted = 0
    before = signal.signal(signal.SIGALRM, _hang)
    try:
        for number in range(first, first + count):
            rng = random.Random(f"{reader.name} {number}")
            data = mutations.mutate(seed, rng, rng.choice(others))
            path.write_bytes(data)
            signal.alarm(LONGEST)
            try:
                value = reader.read(path)
                signal.alarm(0)
            except InputError as error:
                signal.alarm(0)
                refused += 1
                if "\n" in str(error) or len(str(error)) > 2000:
                    pytest.fail(f"{reader.name}, input {number}: more than one line")
                continue
            except HangError:
                pytest.fail(f"{reader.name}, input {number}: longer than {LONGEST} s")
            except Exception as error:
                pytest.fail(f"{reader.name}, input {number}: {type(error).__name__}: {error}")
            assert reader.sound(value), f"{reader.name}, input {number}: accepted silently"
            accepted += 1
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
    return refused, accepted


@pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.name)
def test_reader_refuses_damaged_files_in_one_line(reader, tmp_path):
    """60 inputs; the undamaged file is accepted."""
    path = tmp_path / f"whole{reader.suffix}"
    path.write_bytes(reader.seed())
    if reader.name == "study":  # its data files lie beside it
        path = ROOT / "config" / "study.yaml"
    assert reader.sound(reader.read(path))
    refused, accepted = survive(reader, tmp_path, 60)
    assert refused + accepted == 60
    assert refused > 0


@pytest.mark.heavy
@pytest.mark.parametrize("reader", READERS, ids=lambda reader: reader.name)
def test_reader_survives_two_thousand_damaged_files(reader, tmp_path, record_property):
    refused, accepted = survive(reader, tmp_path, 2000, first=1000)
    record_property("refused", refused)
    record_property("accepted", accepted)
    print(f"{reader.name}: {refused} refused, {accepted} accepted and sound")
    assert refused + accepted == 2000
