"""Prony series as recursions: shift by temperature, merge what is slower than the run, coefficients of a step.

A term g exp(-t/tau) under a strain that is linear over a step obeys h <- exp(-dt/tau) h + g (tau/dt)(1 - exp(-dt/tau))
de exactly (Taylor, Pister and Goudreau, doi:10.1002/nme.1620020106). The slow terms of a run, many or few, are replaced
together with the long-term modulus by the Gauss quadrature of their spectrum, which keeps twice as many moments as it
has terms, all weights positive: the shortest whose relaxation modulus is found to lie within `TOLERANCE` of the
instantaneous one at every time of the run.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh_tridiagonal

from .material import Material

Floats = NDArray[np.float64]
TOLERANCE = 1e-6
"""Largest error of the relaxation modulus, of the instantaneous one."""
LOOKS = 500
"""Times, evenly spaced in their logarithm, at which it is looked for: an error is as smooth as its exponentials."""


@dataclass(frozen=True)
class Relaxation:
    """A normalised relaxation spectrum at one temperature.

    Attributes
    ----------
    shear, bulk : float
        Instantaneous moduli.
    long_term : (2,)
        What of the deviator (0) and of the volume (1) never relaxes.
    weights : (n, 2)
        Weights of the terms; each column with `long_term` sums to 1.
    times : (n,)
        Relaxation times at this temperature.
    damping : float
        Stiffness-proportional damping, s.
    neo_hookean : bool
        Whether stress follows from the neo-Hookean law, else from strain linearly.
    """

    shear: float
    bulk: float
    long_term: Floats
    weights: Floats
    times: Floats
    damping: float = 0.0
    neo_hookean: bool = False

    def modulus(self, time: Floats) -> Floats:
        """Return the normalised shear relaxation modulus at `time`, shape of `time`."""
        return np.asarray(
            self.long_term[0] + np.exp(-np.multiply.outer(time, 1.0 / self.times)) @ self.weights[:, 0],
            dtype=np.float64,
        )


def relaxation_of(material: Material, temperature: float, duration: float) -> Relaxation:
    """Return the spectrum of a material at `temperature` for a run of `duration`.

    Parameters
    ----------
    material : Material
    temperature : float
        degC; of no effect without ``*TRS``.
    duration : float
        Length of the whole run; nothing later than this is asked for.
    """
    shear, bulk = material.shear_and_bulk()
    g, k, tau = material.prony[:, 0], material.prony[:, 1], material.prony[:, 2] * material.shift(temperature)
    order = np.argsort(tau)
    weights = np.column_stack([g, k])[order]
    times = tau[order]
    long_term = 1.0 - weights.sum(axis=0)
    if times.size and np.array_equal(weights[:, 0], weights[:, 1]):
        weights, times, long_term = _merge_slow(weights[:, 0], times, float(long_term[0]), duration)
    return Relaxation(shear, bulk, long_term, weights, times, material.damping, material.neo_hookean)


def _merge_slow(weights: Floats, times: Floats, long_term: float, duration: float) -> tuple[Floats, Floats, Floats]:
    """Replace the slow end by the shortest quadrature within `TOLERANCE`, if that saves terms."""
    time = np.append(0.0, np.geomspace(1e-3 * min(float(times[0]), duration), duration, LOOKS))
    fading = np.exp(-np.multiply.outer(1.0 / times, time))
    best, kept, rates = times.size, weights, np.zeros(0)
    for first in range(times.size):
        nodes, measure = np.append(1.0 / times[first:], 0.0), np.append(weights[first:], long_term)
        wanted = (weights[first:, None] * fading[first:]).sum(axis=0) + long_term
        for points in range(1, best - first):
            found, merged = gauss_rule(nodes, measure, points)
            error = (merged[:, None] * np.exp(-np.multiply.outer(found, time))).sum(axis=0) - wanted
            if np.abs(error).max() <= TOLERANCE:
                best, kept, rates = first + points, np.append(weights[:first], merged), found
                break
    if best == times.size:
        return np.column_stack([weights, weights]), times, np.array([long_term, long_term])
    slow = 1.0 / np.maximum(rates, 1e-12 / duration)
    return np.column_stack([kept, kept]), np.append(times[: best - rates.size], slow), np.zeros(2)


def gauss_rule(nodes: Floats, weights: Floats, points: int) -> tuple[Floats, Floats]:
    """Return the Gauss quadrature with `points` nodes of a discrete positive measure.

    Lanczos on diag(nodes) started from sqrt(weights), then the eigenvalues of the tridiagonal matrix (Golub and Welsch,
    doi:10.1090/S0025-5718-69-99647-1). Exact for polynomials up to degree 2 points - 1.
    """
    scale = float(nodes.max())
    total = float(weights.sum())
    basis = np.zeros((points, nodes.size))
    diagonal = np.zeros(points)
    beside = np.zeros(points - 1)
    vector = np.sqrt(weights / total)
    for i in range(points):
        basis[i] = vector
        image = nodes / scale * vector
        diagonal[i] = (image * vector).sum()
        for _ in range(2):
            for known in basis[: i + 1]:
                image = image - (known * image).sum() * known
        if i + 1 < points:
            beside[i] = np.sqrt((image * image).sum())
            vector = image / beside[i]
    values, vectors = eigh_tridiagonal(
        diagonal, beside, lapack_driver="stev"
    )  # no BLAS: the same bits on any processor
    return np.maximum(values, 0.0) * scale, total * vectors[0] ** 2


def step_coefficients(times: Floats, weights: Floats, dt: float) -> tuple[Floats, Floats]:
    """Return decay (n,) and gain (n, 2) of the recursion for a step `dt`: Eq. (1) of the paper, term by term."""
    ratio = dt / times
    decay = np.exp(-ratio)
    mean = -np.expm1(-ratio) / ratio
    return decay, weights * mean[:, None]
