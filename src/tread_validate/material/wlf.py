"""Time-temperature superposition after Williams, Landel and Ferry (J. Am. Chem. Soc. 77 (1955) 3701-3707)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..study import Wlf
from .exact import power_of_ten


def pole(wlf: Wlf) -> float:
    """Return the temperature Ts - C2, degC, at and below which the WLF law has no meaning."""
    return wlf.pole


def log_shift_factor(temperature: ArrayLike, wlf: Wlf) -> NDArray[np.float64]:
    """Return log10 a_T = -C1 (T - Ts) / (C2 + T - Ts); `temperature` in degC, any shape.

    Raises `InputError` for a temperature at or below Ts - C2, the pole of the law.
    """
    values = np.asarray(temperature, dtype=np.float64)
    if not np.all(values > pole(wlf)):
        raise InputError("temperature", f"{np.min(values):g} degC", f"above the WLF pole Ts - C2 = {pole(wlf):g} degC")
    above = values - wlf.reference_temperature_degC
    return np.asarray(-wlf.c1 * above / (wlf.c2_K + above), dtype=np.float64)


def shift_factor(temperature: ArrayLike, wlf: Wlf) -> NDArray[np.float64]:
    """Return a_T = tau(T) / tau(Ts), dimensionless, > 0; `temperature` in degC, any shape."""
    return power_of_ten(log_shift_factor(temperature, wlf))


def referred_to(wlf: Wlf, reference: float) -> tuple[float, float]:
    """Return (C1', C2') of the same law referred to `reference` in degC: C2' = C2 + T0 - Ts, C1' = C1 C2 / C2'.

    With the constants 8.86 and 101.6 K at 10 degC, data referred to 22 degC have 7.9241 and 113.6 K.
    """
    if reference <= pole(wlf):
        raise InputError("reference temperature", f"{reference:g} degC", f"above the WLF pole at {pole(wlf):g} degC")
    c2 = wlf.c2_K + reference - wlf.reference_temperature_degC
    return wlf.c1 * wlf.c2_K / c2, c2
