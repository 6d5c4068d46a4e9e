"""Fewer terms: relaxation times moved to where they serve best, and terms taken out one by one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .collocation import collocate, relaxation_times
from .fit import PronyFit, fit_prony
from .sign_control import non_negative

Array = NDArray[np.float64]

NEAREST = 1e-3  # least distance of two relaxation times, in ln tau
REACH = 30.0  # a relaxation time stays within this factor of the data's band


def refine_times(fit: PronyFit, loss_weight: float = 1.0) -> PronyFit:
    """Return the fit with its relaxation times moved to lower the objective, the number of terms kept.

    Variable projection: for any times the moduli are the exact non-negative solution, so only ln tau is searched (trust
    region within bounds, 30-fold beyond the band), with Kaufman's Jacobian (BIT 15 (1975) 49-57,
    doi:10.1007/BF01932995). Never worse than the fit it starts from.
    """
    w, storage, loss = fit.angular_frequency, fit.storage_modulus, fit.loss_modulus

    def residual(log_times: Array) -> Array:
        system = collocate(w, storage, loss, np.exp(log_times), loss_weight)
        return system.residual(non_negative(system))

    def jacobian(log_times: Array) -> Array:
        times = np.exp(log_times)
        system = collocate(w, storage, loss, times, loss_weight)
        coefficients = non_negative(system)
        x = w[:, None] * times
        bend = x / (1.0 + x * x) ** 2
        slope = (
            np.vstack([2.0 * x * bend / storage[:, None], loss_weight * (1.0 - x * x) * bend / loss[:, None]])
            * coefficients[1:]
        )
        active = system.matrix[:, coefficients > 0]
        plane = np.linalg.qr(active / np.linalg.norm(active, axis=0))[0]
        return np.asarray(slope - plane @ (plane.T @ slope), dtype=np.float64)

    low, high = np.log(1.0 / (REACH * w.max())), np.log(REACH / w.min())
    start = np.clip(np.log(fit.series.relaxation_times), low + 1e-6, high - 1e-6)
    from scipy.optimize import least_squares

    found = least_squares(residual, start, jac=jacobian, bounds=(low, high), max_nfev=100, xtol=1e-8, ftol=1e-8)
    times = settled(np.exp(_apart(np.sort(found.x))))
    refined = fit_prony(w, storage, loss, times, fit.series.reference_temperature, loss_weight, method="non_negative")
    return refined if refined.objective < fit.objective else fit


def settled(times: Array) -> Array:
    """Return times with six digits: what a search leaves is known no better."""
    return np.array([float(f"{time:.5e}") for time in times.tolist()])


def _apart(log_times: Array) -> Array:
    """Return sorted log times no closer than `NEAREST`."""
    moved = log_times.copy()
    for i in range(1, moved.size):
        moved[i] = max(moved[i], moved[i - 1] + NEAREST)
    return moved


def prune(fit: PronyFit, largest_error: float, loss_weight: float = 1.0) -> PronyFit:
    """Return the fit with the fewest terms whose RMS relative errors of E' and of E'' are both <= `largest_error`.

    Two searches, the better of which is taken: terms are taken out of the given fit one at a time (each time the one
    that is missed least, moduli refitted), and evenly spaced series are built up from one term with their times
    refined. Neither proves that no smaller series exists.

    Raises `InputError` where the full series itself is worse than `largest_error`.
    """
    if max(fit.storage_rms, fit.loss_rms) > largest_error:
        found = f"{100 * fit.storage_rms:.2f} % in E' and {100 * fit.loss_rms:.2f} % in E'' with every term"
        raise InputError("pruning", found, f"a full series within the error asked, {100 * largest_error:g} %")
    taken_out = _backward(fit, largest_error, loss_weight)
    most = taken_out.series.moduli.size - 1
    return _forward(fit, largest_error, most, loss_weight) or taken_out


def _backward(fit: PronyFit, largest_error: float, loss_weight: float) -> PronyFit:
    best = _without(fit, fit.series.moduli <= 0, loss_weight)
    while best.series.moduli.size > 1:
        trials = [
            _without(best, np.arange(best.series.moduli.size) == k, loss_weight) for k in range(best.series.moduli.size)
        ]
        least = min(trials, key=lambda trial: trial.objective)
        if max(least.storage_rms, least.loss_rms) > largest_error:
            least = refine_times(least, loss_weight)
            if max(least.storage_rms, least.loss_rms) > largest_error:
                break
        best = least
    return best


def _forward(fit: PronyFit, largest_error: float, most: int, loss_weight: float) -> PronyFit | None:
    w = fit.angular_frequency
    for terms in range(1, most + 1):
        times = relaxation_times((float(w.min()), float(w.max())), terms, 0.5, 0.5)
        even = fit_prony(w, fit.storage_modulus, fit.loss_modulus, times, fit.series.reference_temperature, loss_weight)
        refined = refine_times(even, loss_weight)
        if max(refined.storage_rms, refined.loss_rms) <= largest_error:
            return refined
    return None


def _without(fit: PronyFit, removed: NDArray[np.bool_], loss_weight: float) -> PronyFit:
    return fit_prony(
        fit.angular_frequency,
        fit.storage_modulus,
        fit.loss_modulus,
        fit.series.relaxation_times[~removed],
        fit.series.reference_temperature,
        loss_weight,
        method="non_negative",
    )
