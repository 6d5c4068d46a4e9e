"""Synthetic isothermal sweeps of a fractional Zener compound, as an instrument would export them."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..study import FractionalZener
from .compound import surrogate_modulus
from .sweep import Sweep
from .sweeps import COLUMNS
from .time_shift import relative_shift

TEMPERATURES = (5.0, 10.0, 22.0, 35.0, 45.0, 60.0)  # degC
FREQUENCIES = (0.1, 100.0)  # Hz
POINTS = 19


def synthetic_sweeps(
    compound: FractionalZener, noise: float = 0.0, outliers: int = 0, seed: int = 1, points: int = POINTS
) -> tuple[Sweep, ...]:
    """Return six sweeps over 0.1..100 Hz with relative Gaussian `noise` on both moduli and a few points off by 20 %.

    The moduli are the compound's law at its data temperature, shifted to each temperature by its WLF constants.
    """
    random = np.random.default_rng(seed)
    w = 2.0 * np.pi * np.geomspace(*FREQUENCIES, points)
    bad = random.choice(len(TEMPERATURES) * points, outliers, replace=False)
    found = []
    for k, temperature in enumerate(TEMPERATURES):
        shift = float(relative_shift(temperature, compound.data_temperature_degC, compound.wlf))
        modulus = surrogate_modulus(compound, w * shift)
        storage = modulus.real * np.exp(noise * random.standard_normal(points))
        loss = modulus.imag * np.exp(noise * random.standard_normal(points))
        here = bad[(bad >= k * points) & (bad < (k + 1) * points)] - k * points
        storage[here] *= 1.2
        loss[here] *= 0.8
        found.append(Sweep(temperature, w, storage, loss, np.arange(points, dtype=np.int64) + k * points + 1))
    return tuple(found)


def sweeps_csv(sweeps: tuple[Sweep, ...], comments: Mapping[str, str]) -> str:
    """Return sweeps as CSV in the columns that `read_export` reads; temperatures wander by less than 0.1 K."""
    lines = [f"# {key}: {value}" for key, value in comments.items()]
    lines.append(",".join(COLUMNS))
    for sweep in sweeps:
        for k in range(sweep.line.size):
            temperature = sweep.temperature + 0.05 * np.sin(1.7 * k)
            frequency = sweep.angular_frequency[k] / (2 * np.pi)
            moduli = f"{sweep.storage_modulus[k]:.5e},{sweep.loss_modulus[k]:.5e}"
            lines.append(f"{temperature:.2f},{frequency:.6g},{moduli}")
    return "\n".join(lines) + "\n"
