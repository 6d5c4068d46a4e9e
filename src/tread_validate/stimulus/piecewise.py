"""Exact integrals of functions that are linear between samples and zero outside them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

CHUNK = 2_000_000  # complex numbers held at once
SERIES_BELOW = 1e-2  # argument below which the closed form of j1 loses digits


def integral(time: NDArray[np.float64], value: NDArray[np.float64]) -> float:
    """Return the integral of the function over all time, in unit of `value` times s."""
    return float(np.sum(0.5 * np.diff(time) * (value[1:] + value[:-1])))


def transform(
    time: NDArray[np.float64], value: NDArray[np.float64], angular_frequency: NDArray[np.float64]
) -> NDArray[np.complex128]:
    """Return the Fourier transform, int f(t) exp(-i w t) dt, at the given angular frequencies.

    Parameters
    ----------
    time, value : (n,) arrays, s and any unit
        Samples of f, linear between them; f is zero before the first and after the last.
    angular_frequency : (m,) array, rad/s

    Returns
    -------
    (m,) complex array, unit of `value` times s.

    Notes
    -----
    A segment with middle c, half length h, mean a and half rise b adds 2 h exp(-i w c) (a j0(w h) - i b j1(w h)), with
    j0, j1 the spherical Bessel functions: no difference of nearly equal terms at any frequency.
    """
    middle = 0.5 * (time[1:] + time[:-1])
    half = 0.5 * np.diff(time)
    mean = 0.5 * (value[1:] + value[:-1])
    rise = 0.5 * np.diff(value)
    result = np.empty(angular_frequency.shape, dtype=np.complex128)
    rows = max(1, CHUNK // middle.size)
    for first in range(0, angular_frequency.size, rows):
        w = angular_frequency[first : first + rows, np.newaxis]
        x = w * half
        weight = mean * np.sinc(x / np.pi) - 1j * rise * _j1(x)
        result[first : first + rows] = (2.0 * half * np.exp(-1j * w * middle) * weight).sum(axis=1)
    return result


def _j1(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the spherical Bessel function of order one."""
    small = np.abs(x) < SERIES_BELOW
    safe = np.where(small, 1.0, x)
    series = x / 3.0 * (1.0 - x * x / 10.0 * (1.0 - x * x / 28.0))
    return np.where(small, series, (np.sin(safe) - safe * np.cos(safe)) / (safe * safe))
