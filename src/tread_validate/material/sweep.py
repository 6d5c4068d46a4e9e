"""One isothermal frequency sweep."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


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
