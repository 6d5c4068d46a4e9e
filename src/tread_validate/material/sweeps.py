"""Isothermal frequency sweeps of a dynamic mechanical analyser."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import InputError
from ..instrument import Reading
from ..study import TimeShift
from ..units import GPA, KPA, MPA
from .dma_file import DmaTable, read_dma
from .ramps import isothermal, ramp_rounds
from .sweep import Sweep

COLUMNS = ("temperature_degC", "frequency_Hz", "storage_modulus_Pa", "loss_modulus_Pa")
UNITS = {"Pa": 1.0, "kPa": KPA, "MPa": MPA, "GPa": GPA}
SAME_TEMPERATURE = 0.6  # K: an instrument holds its set point no better
PLAUSIBLE_MODULUS = (1e4, 1e12)  # Pa, of the median storage modulus of a solid polymer
PLAUSIBLE_TEMPERATURE = (-170.0, 300.0)  # degC
FEWEST_POINTS = 5
LARGEST_FREQUENCY, LARGEST_MODULUS = 1e20, 1e15  # Hz, Pa
SAME_FREQUENCY = 0.4  # in ln f: back at the first one


def read_export(
    path: Path | str | Sequence[Path | str],
    modulus_unit: str | None = None,
    confirm_units: bool = False,
    reference_temperature: float | None = None,
    reading: Reading | None = None,
) -> tuple[tuple[Sweep, ...], tuple[str, ...]]:
    """Return the sweeps of files, and what was understood of them in lines of text.

    Columns are known by name and unit (`tread_validate.instrument`). A sweep is what the file counts as one; else
    consecutive rows within 0.6 K whose frequency rises or falls. Ramps that run through a few frequencies again and
    again become one sweep a round, at its middle temperature. Files without temperatures are master curves and need
    `reference_temperature` in degC. `modulus_unit` holds for all moduli whatever the heading says.

    Raises `InputError` with file, line, column and reason; values out of any polymer's range (a wrong unit) unless
    `confirm_units`.
    """
    if modulus_unit is not None and modulus_unit not in UNITS:
        raise InputError("modulus unit", modulus_unit, f"one of {', '.join(UNITS)}")
    chosen = reading or Reading()
    if modulus_unit is not None:
        chosen = replace(chosen, units={**chosen.units, "--modulus-unit": modulus_unit})
    sweeps: list[Sweep] = []
    notes: list[str] = []
    for file in [path] if isinstance(path, str | Path) else path:
        tables, understood = read_dma(file, chosen)
        notes += understood
        for table in tables:
            checked = _checked(table, confirm_units, reference_temperature)
            found, ramp = _sweeps(checked)
            sweeps += found
            notes += [ramp] if ramp and ramp not in notes else []
    notes.append(f"{len(sweeps)} sweep(s), {sum(sweep.line.size for sweep in sweeps)} points")
    return tuple(sweeps), tuple(notes)


def _checked(table: DmaTable, confirm_units: bool, reference_temperature: float | None) -> DmaTable:
    for key, values, most in (
        ("frequency", table.angular_frequency / (2.0 * np.pi), LARGEST_FREQUENCY),
        ("storage", table.storage_modulus, LARGEST_MODULUS),
        ("loss", table.loss_modulus, LARGEST_MODULUS),
    ):
        unit = "Hz" if key == "frequency" else "Pa"
        table.refuse(
            ~((values > 0) & (values <= most)), key, values, f"a value > 0: a number from 0 to {most:g} {unit}"
        )
    if reference_temperature is not None:
        table = replace(table, temperature=np.full(table.line.size, reference_temperature), sweep=table.sweep * np.nan)
    elif np.isnan(table.temperature).any():
        raise InputError(
            f"{table.source}:{max(table.line[0] - 1, 1)}",
            "no temperature",
            "a column of temperatures, or 'temperature: ... degC' above the table, or --master with --reference-degC",
        )
    if not confirm_units:
        _check_ranges(table, reference_temperature is None)
    return table


def _sweeps(table: DmaTable) -> tuple[list[Sweep], str]:
    if np.isfinite(table.sweep).all():
        starts = np.flatnonzero(np.diff(table.sweep, prepend=np.nan) != 0).tolist()
    else:
        rounds = ramp_rounds(table)
        if rounds:
            return isothermal(table, rounds)
        starts = _starts(table)
    ends = [*starts[1:], table.line.size]
    return [_sweep(table, slice(first, last)) for first, last in zip(starts, ends, strict=True)], ""


def _starts(table: DmaTable) -> list[int]:
    """Return the rows at which a sweep starts: another temperature, or back at the first frequency.

    Back means against the sweep's own direction: dense points are near the first one while they go on.
    """
    temperature, w = table.temperature, table.angular_frequency
    starts = [0]
    for row in range(1, w.size):
        first = starts[-1]
        near = row - first >= FEWEST_POINTS and abs(np.log(w[row] / w[first])) < SAME_FREQUENCY
        again = near and (w[row] - w[row - 1]) * (w[first + 1] - w[first]) <= 0
        if abs(temperature[row] - temperature[first]) > SAME_TEMPERATURE or again:
            starts.append(row)
    return starts


def _sweep(table: DmaTable, rows: slice) -> Sweep:
    w = table.angular_frequency[rows]
    mean = float(np.mean(table.temperature[rows]))
    if w.size < FEWEST_POINTS:
        found = f"a sweep of {w.size} point(s) at {mean:.4g} degC"
        raise InputError(table.where(rows.start), found, f"at least {FEWEST_POINTS} at one temperature")
    steps = np.diff(w)
    rising = steps[0] > 0
    wrong = ~(steps > 0) if rising else ~(steps < 0)
    if wrong.any():
        row = rows.start + int(np.argmax(wrong)) + 1
        before, here = table.angular_frequency[row - 1 : row + 1] / (2.0 * np.pi)
        expected = f"a frequency {'above' if rising else 'below'} the {before:g} Hz before it"
        raise InputError(f"{table.where(row)}: {table.names['frequency']}", f"{here:g} Hz", expected)
    order = slice(None) if rising else slice(None, None, -1)
    return Sweep(
        temperature=mean,
        angular_frequency=w[order],
        storage_modulus=table.storage_modulus[rows][order],
        loss_modulus=table.loss_modulus[rows][order],
        line=table.line[rows][order],
    )


def _check_ranges(table: DmaTable, has_temperature: bool) -> None:
    middle = float(np.median(table.storage_modulus))
    low, high = PLAUSIBLE_MODULUS
    if not low <= middle <= high:
        likely = "MPa" if 1e-2 <= middle < 1e4 else "another unit"
        raise InputError(
            f"{table.where(0)}: {table.names.get('storage', 'modulus')}",
            f"a median of {middle:.4g} Pa, which no solid polymer has (is it {likely}?)",
            f"{low:g} to {high:g} Pa; state the unit (--modulus-unit) or confirm this one (--confirm-units)",
        )
    with np.errstate(over="ignore"):  # a single absurd value is no reason to warn: the median decides
        ratio = float(np.median(table.loss_modulus / table.storage_modulus))
    if not 1e-4 <= ratio <= 20.0:
        raise InputError(
            f"{table.where(0)}: {table.names.get('loss', 'tan delta')}",
            f"a median loss factor of {ratio:.3g}",
            "0.0001 to 20, with both moduli in one unit, or --confirm-units",
        )
    if has_temperature:
        temperature = table.temperature
        wrong = (temperature < PLAUSIBLE_TEMPERATURE[0]) | (temperature > PLAUSIBLE_TEMPERATURE[1])
        if np.min(temperature) > 200.0:
            wrong = np.ones_like(wrong)
        table.refuse(wrong, "temperature", temperature, "degC, not K or degF, or --confirm-units")


def check_shifts(sweeps: tuple[Sweep, ...], law: TimeShift, source: str) -> None:
    """Raise `InputError` for a sweep where `law` has no meaning: at or below a WLF pole, outside a table."""
    for sweep in sweeps:
        law.check(sweep.temperature, f"{source}:{sweep.line[0]}: temperature_degC")
