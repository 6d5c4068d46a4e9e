"""The linear system of a Prony fit: relaxation times, and rows that are each a relative error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .exact import geometric

Array = NDArray[np.float64]


def relaxation_times(band: tuple[float, float], terms: int, low_margin: float = 5.0, high_margin: float = 5.0) -> Array:
    """Return `terms` log-evenly spaced times in s, from 2 pi/(g1 w_max) to 2 pi g2/w_min (band in rad/s).

    g1 is `high_margin`, g2 `low_margin`; both 5 as Bradshaw and Brinson recommend (doi:10.1023/A:1009772018066). A
    single term sits at the geometric mean.
    """
    shortest = 2.0 * np.pi / (high_margin * band[1])
    longest = 2.0 * np.pi * low_margin / band[0]
    if not 0 < shortest < longest:
        raise InputError("relaxation times", f"{shortest:g} s to {longest:g} s", "a band that holds at least one time")
    if terms == 1:
        return np.array([np.sqrt(shortest * longest)])
    return geometric(shortest, longest, terms)


@dataclass(frozen=True)
class Collocation:
    """matrix @ [E_inf, E_1 .. E_n] / scale = 1, one row for each storage and one for each loss modulus.

    Attributes
    ----------
    matrix : (2 m, n + 1) array
        Row divided by its datum and multiplied by its weight, so that a residual is a weighted relative error.
    target : (2 m,) array
        The weights.
    """

    matrix: Array
    target: Array

    def residual(self, coefficients: Array) -> Array:
        """Return the weighted relative errors, (2 m,)."""
        return np.asarray(self.matrix @ coefficients - self.target, dtype=np.float64)

    def objective(self, coefficients: Array) -> float:
        """Return the sum of the squared weighted relative errors."""
        residual = self.residual(coefficients)
        return float(residual @ residual)


def collocate(
    angular_frequency: Array,
    storage_modulus: Array,
    loss_modulus: Array,
    times: Array,
    loss_weight: float = 1.0,
) -> Collocation:
    """Return the system for data at w in rad/s, (m,); `loss_weight` multiplies the relative errors of E''.

    Rows are divided by the datum, so data must be > 0.
    """
    x = np.asarray(angular_frequency)[:, None] * times
    ones = np.ones((x.shape[0], 1))
    storage = np.hstack([ones, x * x / (1.0 + x * x)]) / np.asarray(storage_modulus)[:, None]
    loss = loss_weight * np.hstack([0.0 * ones, x / (1.0 + x * x)]) / np.asarray(loss_modulus)[:, None]
    target = np.concatenate([np.ones(x.shape[0]), np.full(x.shape[0], loss_weight)])
    return Collocation(np.vstack([storage, loss]), target)
