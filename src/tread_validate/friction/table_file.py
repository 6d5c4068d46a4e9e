"""Tribometer tables: contact pressure, slip speed and friction coefficient, repeats allowed."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..columns import read_columns
from ..errors import InputError

Array = NDArray[np.float64]

COLUMNS = ("pressure_Pa", "slip_speed_m_s", "friction_coefficient")
SAME_LEVEL = 0.03  # relative: settings closer than this are repeats of one level
PLAUSIBLE_PRESSURE = (1e3, 1e8)  # Pa, of the median
PLAUSIBLE_SPEED = (1e-8, 50.0)  # m/s, of the median
LARGEST_COEFFICIENT = 5.0


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
    """

    pressure: Array
    slip_speed: Array
    coefficient: Array
    pressure_level: NDArray[np.int64]
    speed_level: NDArray[np.int64]
    pressures: Array
    speeds: Array
    source: str


def read_friction_table(path: Path | str, confirm_units: bool = False) -> FrictionData:
    """Read columns pressure_Pa, slip_speed_m_s, friction_coefficient.

    Raises `InputError` with file, line and reason: a missing column, values <= 0, values that look like MPa, mm/s or
    per cent (unless `confirm_units`).
    """
    table = read_columns(path, COLUMNS)
    for name in COLUMNS:
        table.refuse(~(table[name] > 0), name, "a value > 0")
    if not confirm_units:
        for name, (low, high), likely in (
            ("pressure_Pa", PLAUSIBLE_PRESSURE, "MPa or kPa"),
            ("slip_speed_m_s", PLAUSIBLE_SPEED, "mm/s"),
        ):
            middle = float(np.median(table[name]))
            if not low <= middle <= high:
                unit = name.rsplit("_", name.count("_"))[1:] if name == "slip_speed_m_s" else ["Pa"]
                raise InputError(
                    f"{table.where(0)}: {name}",
                    f"a median of {middle:.4g} {'/'.join(unit[-2:])} (is it {likely}?)",
                    f"{low:g} to {high:g}, or --confirm-units",
                )
        table.refuse(
            table["friction_coefficient"] > LARGEST_COEFFICIENT,
            "friction_coefficient",
            f"at most {LARGEST_COEFFICIENT:g} (is it in per cent?), or --confirm-units",
        )
    pressures, pressure_level = _levels(table["pressure_Pa"])
    speeds, speed_level = _levels(table["slip_speed_m_s"])
    return FrictionData(
        table["pressure_Pa"],
        table["slip_speed_m_s"],
        table["friction_coefficient"],
        pressure_level,
        speed_level,
        pressures,
        speeds,
        str(path),
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
