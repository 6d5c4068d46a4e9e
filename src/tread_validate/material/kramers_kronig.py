"""Do storage and loss modulus belong to one linear, causal material?

Any sum of exponentials obeys the Kramers-Kronig relations, so the loss modulus alone, represented by one, predicts the
storage modulus up to a constant (as linear Kramers-Kronig tests of impedance data do).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .collocation import Collocation
from .rich import FEW, REFINEMENTS, closer, rich_times, scatter
from .sign_control import non_negative

Array = NDArray[np.float64]

RIDGE = 1e-3
LARGEST_MISMATCH = 0.05
DISPERSION_RANGE = (0.9, 1.1)


@dataclass(frozen=True)
class KramersKronig:
    """Consistency of storage with loss modulus.

    Attributes
    ----------
    mismatch : float
        Root mean square of E' predicted from the loss modulus, with the constant that fits best, over E' measured,
        less 1; the noise between neighbouring points taken off.
    noise : float
        Relative standard deviation of E' between neighbouring points.
    dispersion_ratio : float
        Measured rise of E' over the rise that E'' implies; 1 for a linear causal material.
    ratio_deviation : float
        Its standard deviation from the noise: a narrow band does not hold the ratio well.
    """

    mismatch: float
    noise: float
    dispersion_ratio: float
    ratio_deviation: float

    @property
    def consistent(self) -> bool:
        """Mismatch at most 5 % and twice the noise, dispersion ratio within 0.9..1.1 and twice its deviation."""
        low, high = DISPERSION_RANGE
        apart = max(low - self.dispersion_ratio, self.dispersion_ratio - high)
        return self.mismatch <= LARGEST_MISMATCH + 2.0 * self.noise and apart <= 2.0 * self.ratio_deviation


def kramers_kronig(angular_frequency: Array, storage_modulus: Array, loss_modulus: Array) -> KramersKronig:
    """Predict E' from E'' (Pa) at w in rad/s, all (m,), and compare.

    What lies outside the measured band reaches into it: terms at times up to 30-fold beyond both ends stand for it,
    with a weak preference for few. Points of any width in decades are taken as they were measured.
    """
    w = np.asarray(angular_frequency, dtype=np.float64)
    order = np.argsort(w, kind="stable")
    times = rich_times(w)
    spectrum = _spectrum(w, loss_modulus, times, order)
    for _ in range(REFINEMENTS):
        if int(np.sum(spectrum > 0)) * FEW > times.size:
            break
        times = closer(times, spectrum > 0)
        spectrum = _spectrum(w, loss_modulus, times, order)
    x = w[:, None] * times
    rise = (x * x / (1.0 + x * x)) @ spectrum
    constant = float(np.sum((storage_modulus - rise) / storage_modulus**2) / np.sum(1.0 / storage_modulus**2))
    predicted = constant + rise
    rows = np.column_stack([np.ones(w.size), rise]) / storage_modulus[:, None]
    ratio = float(np.linalg.lstsq(rows, np.ones(w.size), rcond=None)[0][1])
    away = predicted / storage_modulus - 1.0
    noise = scatter(w, away, 2.0).noise
    mismatch = float(np.sqrt(max(float(np.mean(away**2)) - noise**2, 0.0)))
    # the constant and the ratio are a line through E': its slope's deviation, and the mean error of E'' beside it
    spread = float(np.linalg.inv(rows.T @ rows)[1, 1]) ** 0.5
    lost = scatter(w, ((x / (1.0 + x * x)) @ spectrum) / loss_modulus - 1.0, 2.0).noise
    deviation = float(np.hypot(noise * spread, 2.0 * lost / np.sqrt(w.size)))
    return KramersKronig(mismatch, noise, ratio, deviation)


def _spectrum(w: Array, loss: Array, times: Array, order: NDArray[np.intp]) -> Array:
    """Return the moduli >= 0 of `times` that give the loss modulus."""
    x = w[:, None] * times
    here = np.interp(-np.log(times), np.log(w[order]), loss[order])  # what each term would lose at its own frequency
    ridge = np.diag(RIDGE / here)
    matrix = np.vstack([x / (1.0 + x * x) / loss[:, None], ridge])
    return non_negative(Collocation(matrix, np.concatenate([np.ones(w.size), np.zeros(times.size)])))
