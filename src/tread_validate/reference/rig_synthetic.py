"""A synthetic rig record: an elastic block through a circular indentation, with the faults of a real record."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..files import atomic_path
from .rig_record import RigRecord

Array = NDArray[np.float64]

LENGTH, AREA, HEIGHT = 25e-3, 25e-3 * 20e-3, 8e-3
MODULUS = 20e6
RADII = 0.1, 0.3
SMALL_WHEEL = 0.1
RESOLUTION = 0.25  # N: 12 bits over +-500 N


@dataclass(frozen=True)
class SyntheticRig:
    """A record and the forces behind it.

    Attributes
    ----------
    record : RigRecord
    time, normal_force, tangential_force : (n,) arrays
        Of the mean pass, exact, from first contact (s, N).
    peaks : (passes,) array, N
        Exact peak normal force of each pass.
    """

    record: RigRecord
    time: Array
    normal_force: Array
    tangential_force: Array
    peaks: Array


def exact_force(distance: Array, interference: float) -> Array:
    """Return the normal force in N on a row of springs whose middle is `distance` (m) from the line of centres."""
    radius = 1.0 / (1.0 / RADII[0] + 1.0 / RADII[1])
    half = np.sqrt(2.0 * radius * interference)

    def area(x: Array) -> Array:
        inside = np.clip(x, -half, half)
        return np.asarray(interference * inside - inside**3 / (6.0 * radius), dtype=np.float64)

    stiffness = MODULUS * AREA / LENGTH / HEIGHT
    return np.asarray(stiffness * (area(distance + 0.5 * LENGTH) - area(distance - 0.5 * LENGTH)), dtype=np.float64)


def synthetic_record(
    speed_rpm: float = 300.0,
    interference: float = 0.2e-3,
    revolutions: int = 8,
    sampling_rate: float = 10e3,
    noise: float = 0.6,
    drift: float = 4.0,
    variation: float = 0.03,
    seed: int = 6,
) -> SyntheticRig:
    """Return a record of `revolutions` with noise (N), drift (N), pass-to-pass `variation` (relative) and 12-bit steps.

    One trigger pulse a revolution, wheel angle too; the first contact comes a third of a revolution after the trigger.
    """
    random = np.random.default_rng(seed)
    period = 60.0 / speed_rpm
    speed = 2.0 * np.pi * SMALL_WHEEL / period
    time = np.arange(0.0, (revolutions + 0.35) * period, 1.0 / sampling_rate)
    turn = time / period + 0.9
    number, phase = np.floor(turn).astype(int), turn % 1.0
    scale = 1.0 + variation * random.standard_normal(number.max() + 1)
    distance = (phase - 1.0 / 3.0) * period * speed
    normal = exact_force(distance, interference) * scale[number]
    tangential = _tangential(distance, interference, speed) * scale[number]
    slow = drift * (np.sin(2 * np.pi * 0.23 * time / period + 0.4) + 0.6 * time / time[-1])
    readings = []
    for force, share in ((normal, 1.0), (tangential, 0.4)):
        noisy = force + share * slow + noise * random.standard_normal(time.size)
        readings.append(np.round(noisy / RESOLUTION) * RESOLUTION)
    trigger = np.where(phase < 0.03, 5.0, 0.0) + 0.02 * random.standard_normal(time.size)
    record = RigRecord(
        sampling_rate, readings[0], readings[1], np.round(trigger, 3), 2 * np.pi * phase, "synthetic record",
        {"origin": "synthetic", "shape": "rectangle", "temperature_degC": "22", "interference_mm": "0.2",
         "speed_rpm": f"{speed_rpm:g}"},
    )  # fmt: skip
    reach = 0.5 * LENGTH + np.sqrt(2.0 * interference / (1.0 / RADII[0] + 1.0 / RADII[1]))
    place = np.linspace(-reach, reach, 2001)
    exact = exact_force(place, interference)
    return SyntheticRig(
        record, (place + reach) / speed, exact, _tangential(place, interference, speed), exact.max() * scale
    )


def _tangential(distance: Array, interference: float, speed: float) -> Array:
    """Return a force that is positive while the block loads and, a little less, negative while it unloads."""
    step = 1e-5
    slope = (exact_force(distance + step, interference) - exact_force(distance - step, interference)) / (2 * step)
    deflection = 0.04 * exact_force(distance, interference)
    return np.asarray(1.6e-3 * slope + deflection, dtype=np.float64)


def record_csv(synthetic: SyntheticRig) -> str:
    """Return the record as CSV text."""
    r = synthetic.record
    assert r.trigger is not None
    lines = ["# synthetic record: not measured"]
    lines += [f"# {key}: {value}" for key, value in r.comments.items()]
    lines.append("time_s,normal_force_N,tangential_force_N,trigger_V")
    time = np.arange(r.normal_force.size) / r.sampling_rate
    for t, n, f, v in zip(time, r.normal_force, r.tangential_force, r.trigger, strict=True):
        lines.append(f"{t:.4f},{n:.2f},{f:.2f},{v:.2f}")
    return "\n".join(lines) + "\n"


def write_tdms(path: Path, synthetic: SyntheticRig) -> None:
    """Write the record as TDMS, in single precision, with the conditions as properties."""
    from nptdms import ChannelObject, RootObject, TdmsWriter

    r = synthetic.record
    assert r.trigger is not None
    waveform = {"wf_increment": 1.0 / r.sampling_rate, "wf_start_offset": 0.0}
    columns = {"normal_force_N": r.normal_force, "tangential_force_N": r.tangential_force, "trigger_V": r.trigger}
    channels = [
        ChannelObject("Rig", name, values.astype(np.float32), properties=waveform) for name, values in columns.items()
    ]
    with atomic_path(path) as temporary, TdmsWriter(str(temporary)) as writer:
        writer.write_segment([RootObject(properties=dict(r.comments)), *channels])
