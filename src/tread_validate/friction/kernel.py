"""Kinetic friction coefficient at one contact pressure and slip speed: the scalar kernel of every law.

`deck` writes the same arithmetic into the Fortran routine, so a change here is a change there.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ..kernels import kernel

Array = NDArray[np.float64]

COULOMB, HUEMER, TABLE = 0, 1, 2


@kernel()
def kinetic_kernel(
    code: int, parameters: Array, pressures: Array, slip_speeds: Array, table: Array, pressure: float, slip_speed: float
) -> float:
    """Return the kinetic friction coefficient, dimensionless, >= 0.

    Parameters
    ----------
    code : int
        0 constant, 1 Huemer, 2 table.
    parameters : (k,) array
        Constant law: coefficient. Huemer: alpha, beta, n, m, a, b, c (p in MPa, v in m/s), least pressure in Pa,
        least slip speed in m/s. Table: none read.
    pressures, slip_speeds, table : (i,), (j,), (i, j) arrays
        Grid of the table in Pa and m/s, increasing, and the coefficient at its nodes; length 0 for other laws.
    pressure, slip_speed : float, Pa and m/s
        Only the size of the slip speed matters.
    """
    if code == 0:
        return float(parameters[0])
    if code == 1:
        p = max(abs(pressure), parameters[7]) * 1e-6
        v = max(abs(slip_speed), parameters[8])
        u = v ** (-1.0 / parameters[3])
        above = parameters[0] * p ** (parameters[2] - 1.0) + parameters[1]
        return float(above / (parameters[4] + parameters[5] * u + parameters[6] * u * u))
    i, fi = _cell(pressures, abs(pressure))
    j, fj = _cell(slip_speeds, abs(slip_speed))
    below = table[i, j] * (1.0 - fj) + table[i, j + 1] * fj
    above = table[i + 1, j] * (1.0 - fj) + table[i + 1, j + 1] * fj
    return float(below * (1.0 - fi) + above * fi)


@kernel()
def _cell(grid: Array, value: float) -> tuple[int, float]:
    """Return the cell of `grid` that holds `value` and the place in it, 0..1, in the logarithm; ends are held."""
    last = grid.size - 1
    if value <= grid[0]:
        return 0, 0.0
    if value >= grid[last]:
        return last - 1, 1.0
    i = 0
    while value > grid[i + 1]:
        i += 1
    return i, math.log(value / grid[i]) / math.log(grid[i + 1] / grid[i])


@kernel()
def kinetic_array(
    code: int, parameters: Array, pressures: Array, slip_speeds: Array, table: Array, pressure: Array, slip_speed: Array
) -> Array:
    """Return `kinetic_kernel` for each pair of (n,) arrays, (n,)."""
    values = np.empty(pressure.size)
    for i in range(pressure.size):
        values[i] = kinetic_kernel(code, parameters, pressures, slip_speeds, table, pressure[i], slip_speed[i])
    return values
