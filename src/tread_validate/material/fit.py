"""Fitting a Prony series to storage and loss moduli over a band."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .collocation import Collocation, collocate
from .exact import least_squares
from .prony import PronySeries
from .sign_control import non_negative, sign_control

Array = NDArray[np.float64]
Method = Literal["sign_control", "non_negative"]


@dataclass(frozen=True)
class PronyFit:
    """A fitted series and how well it fits.

    Attributes
    ----------
    series : PronySeries
    storage_residual, loss_residual : (m,) arrays
        (fit - datum) / datum at each frequency.
    objective : float
        Sum of squared weighted relative errors at the fit.
    check_objective : float
        The same where sign control came to rest, in floating point; the fit is the minimum itself.
    """

    series: PronySeries
    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    storage_residual: Array
    loss_residual: Array
    objective: float
    check_objective: float
    method: Method

    @property
    def storage_rms(self) -> float:
        """Root mean square relative error of E'."""
        return float(np.sqrt(np.mean(self.storage_residual**2)))

    @property
    def loss_rms(self) -> float:
        """Root mean square relative error of E''."""
        return float(np.sqrt(np.mean(self.loss_residual**2)))

    @property
    def excess(self) -> float:
        """Objective of sign control over that of the minimum, less 1."""
        return self.check_objective / max(self.objective, 1e-300) - 1.0


def fit_prony(
    angular_frequency: Array,
    storage_modulus: Array,
    loss_modulus: Array,
    times: Array,
    reference_temperature: float,
    loss_weight: float = 1.0,
    method: Method = "sign_control",
) -> PronyFit:
    """Fit E_inf and one modulus for each of `times` (s) to moduli in Pa at w in rad/s, all (m,).

    ``sign_control`` goes on from where sign control rests to the minimum, correctly rounded on every machine;
    ``non_negative`` is the same minimum in floating point, for searches that need it many times.

    Raises `InputError` where the data are fewer than the coefficients or not all > 0.
    """
    w = np.asarray(angular_frequency, dtype=np.float64)
    storage, loss = np.asarray(storage_modulus, dtype=np.float64), np.asarray(loss_modulus, dtype=np.float64)
    if 2 * w.size < times.size + 1:
        raise InputError(
            "Prony fit", f"{w.size} frequencies", f"at least {(times.size + 2) // 2} for {times.size} terms"
        )
    for name, values in (("storage modulus", storage), ("loss modulus", loss), ("frequency", w)):
        if not np.all(np.isfinite(values) & (values > 0)):
            row = int(np.argmin(np.isfinite(values) & (values > 0)))
            raise InputError(f"Prony fit: {name}, point {row + 1}", values[row], "a number > 0")
    system = collocate(w, storage, loss, times, loss_weight)
    if method == "sign_control":
        size = np.hypot(storage, loss)
        check = sign_control(system, float(size[np.argmax(w)]), float(size[np.argmin(w)]))
        coefficients = least_squares(system.matrix, system.target, check > 0)
    else:
        check = coefficients = non_negative(system)
    return _fit(coefficients, system, w, storage, loss, times, reference_temperature, check, method)


def _fit(
    coefficients: Array,
    system: Collocation,
    w: Array,
    storage: Array,
    loss: Array,
    times: Array,
    reference_temperature: float,
    check: Array,
    method: Method,
) -> PronyFit:
    if not coefficients[0] > 0:
        # the slowest term then carries the long-term modulus: no solid without a little of it
        slowest = int(np.flatnonzero(coefficients[1:] > 0)[-1]) + 1
        coefficients = coefficients.copy()
        coefficients[0] = 1e-6 * coefficients[slowest]
    series = PronySeries(float(coefficients[0]), coefficients[1:], times, reference_temperature)
    return PronyFit(
        series=series,
        angular_frequency=w,
        storage_modulus=storage,
        loss_modulus=loss,
        storage_residual=series.storage_modulus(w) / storage - 1.0,
        loss_residual=series.loss_modulus(w) / loss - 1.0,
        objective=system.objective(coefficients),
        check_objective=system.objective(check),
        method=method,
    )
