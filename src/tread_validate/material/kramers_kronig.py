"""Do storage and loss modulus belong to one linear, causal material?

Any sum of exponentials obeys the Kramers-Kronig relations, so the loss modulus alone, represented by one, predicts the
storage modulus up to a constant (as linear Kramers-Kronig tests of impedance data do).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

Array = NDArray[np.float64]

TERMS_PER_DECADE = 4
MARGIN = 30.0  # relaxation times reach this factor beyond both ends of the data
LARGEST_MISMATCH = 0.05
DISPERSION_RANGE = (0.9, 1.1)


@dataclass(frozen=True)
class KramersKronig:
    """Consistency of storage with loss modulus.

    Attributes
    ----------
    predicted_storage_modulus : (m,) array, Pa
        From the loss modulus, with the constant that fits best.
    mismatch : float
        Root mean square of predicted over measured E', less 1.
    dispersion_ratio : float
        Measured rise of E' over the rise that E'' implies; 1 for a linear causal material.
    """

    predicted_storage_modulus: Array
    mismatch: float
    dispersion_ratio: float

    @property
    def consistent(self) -> bool:
        """Mismatch at most 5 % and dispersion ratio within 0.9..1.1."""
        low, high = DISPERSION_RANGE
        return self.mismatch <= LARGEST_MISMATCH and low <= self.dispersion_ratio <= high


def kramers_kronig(angular_frequency: Array, storage_modulus: Array, loss_modulus: Array) -> KramersKronig:
    """Predict E' from E'' (Pa) at w in rad/s, all (m,), and compare.

    What lies outside the measured band reaches into it: terms at times up to 30-fold beyond both ends stand for it,
    with a weak preference for few.
    """
    w = np.asarray(angular_frequency, dtype=np.float64)
    low, high = 1.0 / (w.max() * MARGIN), MARGIN / w.min()
    times = np.geomspace(low, high, max(round(TERMS_PER_DECADE * np.log10(high / low)), 4))
    x = w[:, None] * times
    loss_rows = x / (1.0 + x * x) / loss_modulus[:, None]
    # E' is used only for its two free numbers, after the loss modulus has fixed the spectrum
    ridge = 1e-3 * np.eye(times.size) / float(np.max(loss_modulus))
    spectrum, _ = nnls(np.vstack([loss_rows, ridge]), np.concatenate([np.ones(w.size), np.zeros(times.size)]))
    rise = (x * x / (1.0 + x * x)) @ spectrum
    constant = float(np.sum((storage_modulus - rise) / storage_modulus**2) / np.sum(1.0 / storage_modulus**2))
    predicted = constant + rise
    rows = np.column_stack([np.ones(w.size), rise]) / storage_modulus[:, None]
    ratio = float(np.linalg.lstsq(rows, np.ones(w.size), rcond=None)[0][1])
    mismatch = float(np.sqrt(np.mean((predicted / storage_modulus - 1.0) ** 2)))
    return KramersKronig(predicted, mismatch, ratio)
