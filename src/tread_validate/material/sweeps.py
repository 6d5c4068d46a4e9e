"""Isothermal frequency sweeps of a dynamic mechanical analyser."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..columns import Columns, read_columns
from ..errors import InputError
from ..study import Wlf
from .wlf import pole

Array = NDArray[np.float64]

COLUMNS = ("temperature_degC", "frequency_Hz", "storage_modulus_Pa", "loss_modulus_Pa")
UNITS = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9}
SAME_TEMPERATURE = 0.6  # K: an instrument holds its set point no better
PLAUSIBLE_MODULUS = (1e4, 1e12)  # Pa, of the median storage modulus of a solid polymer
PLAUSIBLE_TEMPERATURE = (-170.0, 300.0)  # degC
FEWEST_POINTS = 5


@dataclass(frozen=True)
class Sweep:
    """One isothermal frequency sweep.

    Attributes
    ----------
    temperature : float, degC
    angular_frequency : (n,) array, rad/s, increasing
    storage_modulus, loss_modulus : (n,) arrays, Pa, > 0
    line : (n,) array of int
        Line of the source file.
    """

    temperature: float
    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    line: NDArray[np.int64]


def read_sweeps(
    path: Path | str,
    modulus_unit: str | None = None,
    confirm_units: bool = False,
    reference_temperature: float | None = None,
) -> tuple[Sweep, ...]:
    """Read sweeps; consecutive rows within 0.6 K are one sweep, rising or falling in frequency.

    Columns temperature_degC, frequency_Hz, storage_modulus_Pa, loss_modulus_Pa; others are passed over. A file without
    temperatures is a ready master curve and needs `reference_temperature` in degC. `modulus_unit` (Pa, kPa, MPa, GPa)
    states the unit of both moduli whatever the header says; without it values that cannot be Pa are refused unless
    `confirm_units`.

    Raises `InputError` with file, line and reason: a missing column, moduli or frequencies <= 0, frequencies out of
    order, values out of any polymer's range (unit), fewer than 5 points in a sweep.
    """
    needed = COLUMNS if reference_temperature is None else COLUMNS[1:]
    table = read_columns(path, needed)
    for name in COLUMNS[1:]:
        table.refuse(~(table[name] > 0), name, "a value > 0")
    if modulus_unit is not None and modulus_unit not in UNITS:
        raise InputError("modulus unit", modulus_unit, f"one of {', '.join(UNITS)}")
    factor = UNITS[modulus_unit or "Pa"]
    if not confirm_units:
        _check_ranges(table, factor, reference_temperature is None)
    if reference_temperature is None:
        temperature = table["temperature_degC"]
        starts = _starts(temperature)
    else:
        temperature = np.full(table.line.size, reference_temperature)
        starts = [0]
    return tuple(
        _sweep(table, temperature, slice(first, last), factor)
        for first, last in zip(starts, [*starts[1:], table.line.size], strict=True)
    )


def _starts(temperature: Array) -> list[int]:
    starts = [0]
    for row in range(1, temperature.size):
        if abs(temperature[row] - temperature[starts[-1]]) > SAME_TEMPERATURE:
            starts.append(row)
    return starts


def _sweep(table: Columns, temperature: Array, rows: slice, factor: float) -> Sweep:
    frequency = table["frequency_Hz"][rows]
    mean = float(np.mean(temperature[rows]))
    if frequency.size < FEWEST_POINTS:
        found = f"a sweep of {frequency.size} point(s) at {mean:.4g} degC"
        raise InputError(table.where(rows.start), found, f"at least {FEWEST_POINTS} at one temperature")
    steps = np.diff(frequency)
    rising = steps[0] > 0
    wrong = ~(steps > 0) if rising else ~(steps < 0)
    if wrong.any():
        row = rows.start + int(np.argmax(wrong)) + 1
        expected = f"a frequency {'above' if rising else 'below'} the {table['frequency_Hz'][row - 1]:g} Hz before it"
        raise InputError(f"{table.where(row)}: frequency_Hz", f"{table['frequency_Hz'][row]:g} Hz", expected)
    order = slice(None) if rising else slice(None, None, -1)
    return Sweep(
        temperature=mean,
        angular_frequency=2.0 * np.pi * frequency[order],
        storage_modulus=factor * table["storage_modulus_Pa"][rows][order],
        loss_modulus=factor * table["loss_modulus_Pa"][rows][order],
        line=table.line[rows][order],
    )


def _check_ranges(table: Columns, factor: float, has_temperature: bool) -> None:
    storage = table["storage_modulus_Pa"] * factor
    middle = float(np.median(storage))
    low, high = PLAUSIBLE_MODULUS
    if not low <= middle <= high:
        likely = "MPa" if 1e-2 <= middle < 1e4 else "another unit"
        raise InputError(
            f"{table.where(0)}: storage_modulus_Pa",
            f"a median of {middle:.4g} Pa, which no solid polymer has (is it {likely}?)",
            f"{low:g} to {high:g} Pa; state the unit (--modulus-unit) or confirm this one (--confirm-units)",
        )
    with np.errstate(over="ignore"):  # a single absurd value is no reason to warn: the median decides
        ratio = float(np.median(table["loss_modulus_Pa"] / table["storage_modulus_Pa"]))
    if not 1e-4 <= ratio <= 20.0:
        raise InputError(
            f"{table.where(0)}: loss_modulus_Pa",
            f"a median loss factor of {ratio:.3g}",
            "0.0001 to 20, with both moduli in one unit, or --confirm-units",
        )
    if has_temperature:
        temperature = table["temperature_degC"]
        wrong = (temperature < PLAUSIBLE_TEMPERATURE[0]) | (temperature > PLAUSIBLE_TEMPERATURE[1])
        if np.min(temperature) > 200.0:
            wrong = np.ones_like(wrong)
        table.refuse(wrong, "temperature_degC", "degC, not K or degF, or --confirm-units")


def check_above_pole(sweeps: tuple[Sweep, ...], wlf: Wlf, source: str) -> None:
    """Raise `InputError` for a sweep at or below Ts - C2, where the WLF law has no meaning."""
    for sweep in sweeps:
        if sweep.temperature <= pole(wlf):
            raise InputError(
                f"{source}:{sweep.line[0]}: temperature_degC",
                f"{sweep.temperature:g} degC",
                f"above the WLF pole Ts - C2 = {pole(wlf):g} degC",
            )
