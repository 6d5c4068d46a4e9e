"""Scores of one history against another on a common clock."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SpragueGeers:
    """Magnitude, phase and comprehensive error (fractions)."""

    magnitude: float
    phase: float
    comprehensive: float


def relative_rms(reference: Array, predicted: Array) -> float:
    """Return RMSE over the largest magnitude of the reference; raises `InputError` where the reference is zero."""
    scale = _scale(reference)
    return float(np.sqrt(np.mean((predicted - reference) ** 2)) / scale)


def sprague_geers(time: Array, reference: Array, predicted: Array) -> SpragueGeers:
    """Return the Sprague-Geers errors of a predicted history c against a reference m.

    M = sqrt(int c^2 / int m^2) - 1, P = arccos(int m c / sqrt(int m^2 int c^2)) / pi, C = sqrt(M^2 + P^2).
    Sprague and Geers, Commun. Numer. Meth. Eng. 20 (2004) 467-473, doi:10.1002/cnm.665. A prediction that is zero
    everywhere has no phase: `InputError`.
    """
    _scale(reference)
    mm = np.trapezoid(reference * reference, time)
    cc = np.trapezoid(predicted * predicted, time)
    mc = np.trapezoid(reference * predicted, time)
    if cc <= 0.0:
        raise InputError("prediction", "zero everywhere", "a force: a zero history has no phase")
    magnitude = float(np.sqrt(cc / mm) - 1.0)
    phase = float(np.arccos(np.clip(mc / np.sqrt(mm * cc), -1.0, 1.0)) / np.pi)
    return SpragueGeers(magnitude, phase, float(np.hypot(magnitude, phase)))


def _scale(reference: Array) -> float:
    scale = float(np.max(np.abs(reference)))
    if scale <= 0.0:
        raise InputError("reference", "zero everywhere", "a force to be relative to")
    return scale
