"""A Prony series: the relaxation modulus of a linear viscoelastic solid as a sum of exponentials.

Eq. (2) of the paper, and Eq. (3) for its storage and loss moduli.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..study import TimeShift
from .time_shift import relative_shift


@dataclass(frozen=True)
class PronySeries:
    """E(t) = E_inf + sum_i E_i exp(-t/tau_i) in uniaxial tension.

    Attributes
    ----------
    long_term_modulus : float, Pa, > 0
    moduli : (n,) array, Pa, >= 0
    relaxation_times : (n,) array, s, > 0, strictly increasing
    reference_temperature : float, degC
        Temperature that the relaxation times refer to.
    """

    long_term_modulus: float
    moduli: NDArray[np.float64]
    relaxation_times: NDArray[np.float64]
    reference_temperature: float

    def __post_init__(self) -> None:
        for name in ("moduli", "relaxation_times"):
            values = np.array(getattr(self, name), dtype=np.float64).reshape(-1)
            values.flags.writeable = False
            object.__setattr__(self, name, values)
        if self.moduli.shape != self.relaxation_times.shape:
            found = f"{self.moduli.size} moduli and {self.relaxation_times.size} relaxation times"
            raise InputError("Prony series", found, "as many of one as of the other")
        if not (np.isfinite(self.long_term_modulus) and self.long_term_modulus > 0):
            raise InputError("Prony series: long-term modulus", f"{self.long_term_modulus} Pa", "a number > 0")
        if not np.all(np.isfinite(self.moduli) & (self.moduli >= 0)):
            raise InputError("Prony series: moduli", f"{np.min(self.moduli)} Pa", "numbers >= 0")
        times = self.relaxation_times
        if not np.all(np.isfinite(times) & (times > 0)) or not np.all(np.diff(times) > 0):
            raise InputError("Prony series: relaxation times", times, "numbers > 0 in increasing order")

    @property
    def instantaneous_modulus(self) -> float:
        """E_0 = E_inf + sum E_i, Pa."""
        return math.fsum([self.long_term_modulus, *self.moduli.tolist()])

    def relaxation_modulus(self, time: ArrayLike) -> NDArray[np.float64]:
        """Return E(t) in Pa at `time` in s (any shape, >= 0)."""
        t = np.asarray(time, dtype=np.float64)
        decay = np.exp(-t[..., None] / self.relaxation_times)
        return np.asarray(self.long_term_modulus + decay @ self.moduli, dtype=np.float64)

    def storage_modulus(self, angular_frequency: ArrayLike) -> NDArray[np.float64]:
        """Return E'(w) = E_inf + sum E_i x^2/(1+x^2), x = w tau_i, in Pa at w in rad/s (any shape, >= 0)."""
        x2 = (np.asarray(angular_frequency, dtype=np.float64)[..., None] * self.relaxation_times) ** 2
        return np.asarray(self.long_term_modulus + (x2 / (1.0 + x2)) @ self.moduli, dtype=np.float64)

    def loss_modulus(self, angular_frequency: ArrayLike) -> NDArray[np.float64]:
        """Return E''(w) = sum E_i x/(1+x^2), x = w tau_i, in Pa at w in rad/s (any shape, >= 0)."""
        x = np.asarray(angular_frequency, dtype=np.float64)[..., None] * self.relaxation_times
        return np.asarray((x / (1.0 + x * x)) @ self.moduli, dtype=np.float64)

    def at_temperature(self, temperature: float, law: TimeShift) -> PronySeries:
        """Return the series at another temperature in degC: tau_i(T) = tau_i a_T(T)/a_T(reference), moduli as they are.

        Raises `InputError` where `law` has no meaning: at or below a WLF pole, outside a table.
        """
        shift = float(relative_shift(temperature, self.reference_temperature, law))
        return replace(self, relaxation_times=self.relaxation_times * shift, reference_temperature=float(temperature))
