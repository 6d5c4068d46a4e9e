"""The kinetic coefficient of any law, for kernels: a choice among the laws' own kernels by the form's code."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..kernels import kernel
from .huemer_form import CODE as HUEMER
from .huemer_form import huemer_kernel
from .laws.coulomb import CODE as COULOMB
from .laws.coulomb import coulomb_kernel
from .laws.power import CODE as POWER
from .laws.power import power_kernel
from .laws.table import CODE as TABLE
from .laws.table import table_kernel

Array = NDArray[np.float64]


@kernel()
def kinetic_kernel(
    code: int, parameters: Array, pressures: Array, slip_speeds: Array, table: Array, pressure: float, slip_speed: float
) -> float:
    """Return the kinetic friction coefficient, dimensionless, >= 0; nan for a code that no form has.

    Parameters
    ----------
    code : int
        Of the `LawForm`.
    parameters : (k,) array
        The law's constants, in the form's order.
    pressures, slip_speeds, table : (i,), (j,), (i, j) arrays
        Grid of the table in Pa and m/s, increasing, and the coefficient at its nodes; length 0 for other laws.
    pressure, slip_speed : float, Pa and m/s
        Only the size of the slip speed matters.
    """
    if code == COULOMB:
        return coulomb_kernel(parameters, pressures, slip_speeds, table, pressure, slip_speed)
    if code == HUEMER:
        return huemer_kernel(parameters, pressures, slip_speeds, table, pressure, slip_speed)
    if code == TABLE:
        return table_kernel(parameters, pressures, slip_speeds, table, pressure, slip_speed)
    if code == POWER:
        return power_kernel(parameters, pressures, slip_speeds, table, pressure, slip_speed)
    return np.nan
