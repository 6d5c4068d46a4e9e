"""The fractional Zener solid: the law behind the synthetic surrogate compound."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .exact import power, quarter_turn_part


def fractional_zener(
    angular_frequency: ArrayLike,
    long_term_modulus: float,
    modulus_rise: float,
    corner_frequency: float,
    exponent: float,
) -> NDArray[np.complex128]:
    """Return E*(w) = E_inf + dE (i w/w_c)^a / (1 + (i w/w_c)^a), complex, in the unit of the moduli.

    `angular_frequency` and `corner_frequency` in rad/s, > 0; `exponent` a in 0..1 (1 is the standard linear solid).
    """
    r = power(np.asarray(angular_frequency, dtype=np.float64) / corner_frequency, exponent)
    cosine, sine = quarter_turn_part(exponent)
    size = 1.0 + 2.0 * r * cosine + r * r  # |1 + u|^2 with u = r (cosine + i sine)
    modulus = np.empty(r.shape, dtype=np.complex128)
    modulus.real = long_term_modulus + modulus_rise * (r * r + r * cosine) / size
    modulus.imag = modulus_rise * r * sine / size
    return modulus
