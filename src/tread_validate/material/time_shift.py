"""How far relaxation times move between two temperatures, by whichever law a compound has."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..study import ArrheniusShift, TimeShift, Wlf
from .exact import power_of_ten
from .wlf import log_shift_factor

Array = NDArray[np.float64]

GAS_CONSTANT = 8.314462618e-3  # kJ/(mol K)
ZERO_CELSIUS = 273.15
LN_10 = 2.302585092994046


def relative_shift(temperature: ArrayLike, reference: float, law: TimeShift) -> Array:
    """Return tau(T) / tau(`reference`), dimensionless, > 0; both temperatures in degC, `temperature` of any shape.

    Raises `InputError` where the law has no meaning: at or below a WLF pole, or outside a table.
    """
    return power_of_ten(log_relative_shift(temperature, reference, law))


def log_relative_shift(temperature: ArrayLike, reference: float, law: TimeShift) -> Array:
    """Return log10 of `relative_shift`."""
    if isinstance(law, Wlf):
        return np.asarray(log_shift_factor(temperature, law) - log_shift_factor(reference, law), dtype=np.float64)
    values = np.asarray(temperature, dtype=np.float64)
    for one in (*values.reshape(-1).tolist(), reference):
        law.check(one, "temperature")
    if isinstance(law, ArrheniusShift):
        return arrhenius(values, reference, law.activation_energy_kJ_mol)
    t, logs = np.array(law.points).T
    return np.asarray(np.interp(values, t, logs) - np.interp(reference, t, logs), dtype=np.float64)


def told(law: TimeShift) -> str:
    """Return a law in words, with its constants."""
    if isinstance(law, Wlf):
        return f"WLF, C1 {law.c1:.6g}, C2 {law.c2_K:.6g} K at {law.reference_temperature_degC:g} degC"
    if isinstance(law, ArrheniusShift):
        return f"Arrhenius, {law.activation_energy_kJ_mol:.6g} kJ/mol"
    return f"a table of {len(law.points)} temperatures from {law.points[0][0]:g} to {law.points[-1][0]:g} degC"


def arrhenius(temperatures: Array, reference: float, activation_energy: float) -> Array:
    """Return log10 a_T = E_a/(R ln 10) (1/T - 1/T0); temperatures in degC, `activation_energy` in kJ/mol, > 0."""
    return np.asarray(
        activation_energy / (GAS_CONSTANT * LN_10)
        * (1.0 / (temperatures + ZERO_CELSIUS) - 1.0 / (reference + ZERO_CELSIUS)),
        dtype=np.float64,
    )  # fmt: skip
