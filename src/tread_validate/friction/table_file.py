"""Tribometer tables: contact pressure, slip speed and friction coefficient, repeats allowed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError, one_line
from ..instrument import CellBlock, Reading, Recognised, read_blocks, recognise
from ..instrument.quantities import FRICTION

Array = NDArray[np.float64]

COLUMNS = ("pressure_Pa", "slip_speed_m_s", "friction_coefficient")
SAME_LEVEL = 0.03  # relative: settings closer than this are repeats of one level
PLAUSIBLE_PRESSURE = (1e3, 1e8)  # Pa, of the median
PLAUSIBLE_SPEED = (1e-8, 50.0)  # m/s, of the median
LARGEST_COEFFICIENT = 5.0
LARGEST_PRESSURE, LARGEST_SPEED = 1e12, 1e3  # Pa, m/s
SAME_TEMPERATURE = 3.0  # K


@dataclass(frozen=True)
class FrictionData:
    """Measured friction, one row a measurement.

    Attributes
    ----------
    pressure : (n,) array, Pa
    slip_speed : (n,) array, m/s
    coefficient : (n,) array
    pressure_level, speed_level : (n,) arrays of int
        Which level each row belongs to; settings within 3 % are one level.
    pressures, speeds : (i,), (j,) arrays
        Mean setting of each level, increasing.
    source : str
    temperature, run : (n,) arrays or None
        degC, and number of the run, where the table says them.
    understood : tuple of str
        How the table was read.
    """

    pressure: Array
    slip_speed: Array
    coefficient: Array
    pressure_level: NDArray[np.int64]
    speed_level: NDArray[np.int64]
    pressures: Array
    speeds: Array
    source: str
    temperature: Array | None = None
    run: Array | None = None
    understood: tuple[str, ...] = ()


def read_friction_table(
    path: Path | str,
    confirm_units: bool = False,
    reading: Reading | None = None,
    temperature: float | None = None,
) -> FrictionData:
    """Read pressure, slip speed and friction coefficient, known by name and unit; temperature and run where there are.

    A table of several temperatures (apart by more than 6 K) needs `temperature` in degC: rows within 3 K are taken.

    Raises `InputError` with file, line and reason: a missing column or unit, values <= 0, values that look like MPa,
    mm/s or per cent (unless `confirm_units`), several temperatures and none chosen.
    """
    blocks, told = read_blocks(path)
    if len(blocks) > 1:
        raise InputError(f"{path}:{blocks[1].line[0]}", "a second table", "one table of friction")
    block = blocks[0]
    columns = recognise(block, FRICTION, reading or Reading())
    for key in ("pressure", "slip_speed", "coefficient"):
        if key not in columns:
            names = ", ".join(f"{k + 1} '{name}'" for k, name in enumerate(block.names))
            raise InputError(f"{path}:{max(block.line[0] - 1, 1)}", f"columns {names}", f"{key}: --column {key}=NUMBER")
    values = {key: _numbers(block, one) for key, one in columns.items()}
    line = np.array(block.line, dtype=np.int64)
    for key, most in (("pressure", LARGEST_PRESSURE), ("slip_speed", LARGEST_SPEED), ("coefficient", np.inf)):
        _refuse(block, columns[key], ~((values[key] > 0) & (values[key] <= most)), "a value > 0")
    if "temperature" in values:
        kept = _at_temperature(block, values["temperature"], temperature)
        values = {key: one[kept] for key, one in values.items()}
        line = line[kept]
    elif temperature is not None:
        raise InputError(path, "a table without temperatures", "no temperature to choose")
    if not confirm_units:
        _check_units(block, columns, values)
    pressures, pressure_level = _levels(values["pressure"])
    speeds, speed_level = _levels(values["slip_speed"])
    understood = (
        f"{Path(path).name}: {told}, {line.size} row(s)",
        "; ".join(one.told(quantity) for quantity in FRICTION for key, one in columns.items() if key == quantity.key),
    )
    return FrictionData(
        values["pressure"], values["slip_speed"], values["coefficient"], pressure_level, speed_level, pressures, speeds,
        str(path), values.get("temperature"), values.get("run"), understood,
    )  # fmt: skip


def _numbers(block: CellBlock, column: Recognised) -> Array:
    found = []
    for row in range(len(block.cells)):
        value = block.number(row, column.column)
        if value is None:
            raise InputError(f"{block.where}:{block.line[row]}: {column.heading}", "an empty cell", "a number")
        found.append(column.unit.factor * value + column.unit.offset)
    return np.array(found, dtype=np.float64)


def _refuse(block: CellBlock, column: Recognised, wrong: NDArray[np.bool_], expected: str) -> None:
    if np.any(wrong):
        row = int(np.argmax(wrong))
        found = block.cells[row][column.column]
        raise InputError(f"{block.where}:{block.line[row]}: {column.heading}", one_line(found, 40), expected)


def _at_temperature(block: CellBlock, values: Array, chosen: float | None) -> NDArray[np.bool_]:
    """Return the rows to take; all where the table has one temperature."""
    if chosen is None:
        if float(np.ptp(values)) <= 2.0 * SAME_TEMPERATURE:
            return np.ones(values.size, dtype=np.bool_)
        levels = ", ".join(f"{value:.3g}" for value in sorted({round(float(value)) for value in values})[:8])
        raise InputError(block.where, f"temperatures of {levels} degC", "one: --temperature-degC chooses it")
    kept = np.abs(values - chosen) <= SAME_TEMPERATURE
    if not kept.any():
        found = f"temperatures of {values.min():.4g} to {values.max():.4g} degC"
        raise InputError(block.where, found, f"rows within {SAME_TEMPERATURE:g} K of {chosen:g} degC")
    return np.asarray(kept, dtype=np.bool_)


def _check_units(block: CellBlock, columns: dict[str, Recognised], values: dict[str, Array]) -> None:
    for key, unit, (low, high), likely in (
        ("pressure", "Pa", PLAUSIBLE_PRESSURE, "MPa or kPa"),
        ("slip_speed", "m/s", PLAUSIBLE_SPEED, "mm/s"),
    ):
        middle = float(np.median(values[key]))
        if not low <= middle <= high:
            raise InputError(
                f"{block.where}:{block.line[0]}: {columns[key].heading}",
                f"a median of {middle:.4g} {unit} (is it {likely}?)",
                f"{low:g} to {high:g}, or --confirm-units",
            )
    if np.any(values["coefficient"] > LARGEST_COEFFICIENT):
        row = int(np.argmax(values["coefficient"] > LARGEST_COEFFICIENT))
        raise InputError(
            f"{block.where}:{block.line[row]}: {columns['coefficient'].heading}",
            f"{values['coefficient'][row]:g}",
            f"at most {LARGEST_COEFFICIENT:g} (is it in per cent?), or --confirm-units",
        )


def _levels(values: Array) -> tuple[Array, NDArray[np.int64]]:
    """Return the mean of each group of values within 3 % of the group's first, and each value's group."""
    order = np.argsort(values)
    level = np.zeros(values.size, dtype=np.int64)
    first, count = values[order[0]], 0
    for index in order:
        if values[index] > first * (1.0 + SAME_LEVEL):
            first, count = values[index], count + 1
        level[index] = count
    means = np.array([values[level == k].mean() for k in range(count + 1)])
    return means, level


def table_of(data: FrictionData) -> Array:
    """Return the mean coefficient at each pressure and speed level, (i, j).

    Raises `InputError` for a combination that was not measured: a table law needs a full grid.
    """
    table = np.full((data.pressures.size, data.speeds.size), np.nan)
    for i in range(data.pressures.size):
        for j in range(data.speeds.size):
            here = (data.pressure_level == i) & (data.speed_level == j)
            if not here.any():
                missing = f"{data.pressures[i]:.4g} Pa and {data.speeds[j]:.4g} m/s"
                raise InputError(data.source, f"no measurement at {missing}", "every pressure at every slip speed")
            table[i, j] = data.coefficient[here].mean()
    return table
