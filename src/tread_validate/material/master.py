"""Master curve: isothermal sweeps shifted to one temperature, and WLF constants fitted to it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..study import Wlf
from .exact import power_of_ten
from .sweep import Sweep
from .wlf import referred_to

Array = NDArray[np.float64]
VerticalShift = Literal["none", "fitted"]

KNOTS_PER_DECADE = 1.0
RIDGE = 1e-3
POLISHES = 12
HEIGHT_DIGITS = 6  # of a vertical factor near 1
ROUNDS = 3  # of weights that set outliers aside
LEAST_SCALE = 5e-4  # in ln E: what no instrument resolves is not an outlier


@dataclass(frozen=True)
class MasterCurve:
    """Moduli of all sweeps against reduced frequency, in order of frequency.

    Attributes
    ----------
    angular_frequency : (m,) array, rad/s
        w a_T at the reference temperature.
    storage_modulus, loss_modulus : (m,) arrays, Pa
        As measured, times the vertical shift.
    sweep : (m,) array of int
        Number of the sweep each point is from.
    line : (m,) array of int
        Line of the source file.
    reference_temperature : float, degC
    temperatures, shift_factors, vertical_factors : (k,) arrays
        Of each sweep: degC, a_T relative to the reference temperature, factor on the moduli.
    """

    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    sweep: NDArray[np.int64]
    line: NDArray[np.int64]
    reference_temperature: float
    temperatures: Array
    shift_factors: Array
    vertical_factors: Array

    @property
    def moduli(self) -> tuple[Array, Array]:
        """E' and E'' in Pa, (m,) each."""
        return self.storage_modulus, self.loss_modulus


def shift(
    sweeps: tuple[Sweep, ...],
    log_factors: Array,
    reference_temperature: float,
    vertical: Array | None = None,
) -> MasterCurve:
    """Return the master curve at `reference_temperature` in degC; `vertical` multiplies the moduli of each sweep.

    `log_factors` (k,) are log10 a_T of each sweep, 0 at the reference temperature.
    """
    temperatures = np.array([sweep.temperature for sweep in sweeps])
    factors = power_of_ten(log_factors)
    heights = np.ones(len(sweeps)) if vertical is None else vertical
    w = np.concatenate([s.angular_frequency * a for s, a in zip(sweeps, factors, strict=True)])
    number = np.concatenate([np.full(s.line.size, k) for k, s in enumerate(sweeps)])
    order = np.argsort(w, kind="stable")

    def gather(parts: list[Array]) -> Array:
        return np.concatenate([part * b for part, b in zip(parts, heights, strict=True)])[order]

    return MasterCurve(
        angular_frequency=w[order],
        storage_modulus=gather([s.storage_modulus for s in sweeps]),
        loss_modulus=gather([s.loss_modulus for s in sweeps]),
        sweep=number[order].astype(np.int64),
        line=np.concatenate([s.line for s in sweeps])[order],
        reference_temperature=reference_temperature,
        temperatures=temperatures,
        shift_factors=factors,
        vertical_factors=heights,
    )


@dataclass(frozen=True)
class WlfFit:
    """WLF constants that make the sweeps overlap best.

    Attributes
    ----------
    wlf : Wlf
        Referred to the reference temperature.
    covariance : (2, 2) array
        Of C1 and C2 (K).
    vertical_factors : (k,) array
    misfit : float
        Root mean square distance of the points from one smooth curve, relative.
    """

    wlf: Wlf
    covariance: Array
    vertical_factors: Array
    misfit: float

    @property
    def deviations(self) -> tuple[float, float]:
        """Standard deviations of C1 and of C2 (K)."""
        return float(np.sqrt(self.covariance[0, 0])), float(np.sqrt(self.covariance[1, 1]))


def fit_wlf(
    sweeps: tuple[Sweep, ...], start: Wlf, reference_temperature: float, vertical: VerticalShift = "none"
) -> WlfFit:
    """Fit C1 and C2 referred to `reference_temperature` (degC), and a vertical factor per sweep if asked.

    Log E' and log E'' of all sweeps are each one cubic spline of log reduced frequency, one knot a decade; C1 and C2
    minimise the robustly weighted squares about it. The spline and the vertical factors are linear and eliminated at
    each step. Raises `InputError` for fewer than three temperatures.
    """
    from scipy.optimize import least_squares

    temperatures = np.array([sweep.temperature for sweep in sweeps])
    if np.unique(np.round(temperatures)).size < 3:
        raise InputError("WLF fit", f"{np.unique(np.round(temperatures)).size} temperature(s)", "at least 3")
    pieces = _Overlap(sweeps, reference_temperature, vertical)
    lowest = reference_temperature - float(temperatures.min())
    c1, c2 = referred_to(start, reference_temperature)

    def wlf_of(q: Array) -> tuple[float, float]:
        return float(q[0]), float(max(lowest, 0.0) + np.exp(q[1]))

    def residual(q: Array) -> Array:
        return pieces.residual(*wlf_of(q))[0]

    begin = np.array([c1, np.log(max(c2 - max(lowest, 0.0), 1.0))])
    for _ in range(ROUNDS):
        found = least_squares(residual, begin, x_scale=[1.0, 0.1], xtol=1e-10, ftol=1e-10)
        begin = _polished(residual, found.x)
        c1, c2 = wlf_of(begin)
        pieces.reweigh(c1, c2)
    final, heights, parameters = pieces.residual(c1, c2)
    steps = [(1e-4, 0.0), (0.0, 1e-3)]
    jacobian = np.column_stack(
        [
            (pieces.residual(c1 + h1, c2 + h2)[0] - pieces.residual(c1 - h1, c2 - h2)[0]) / (2 * (h1 + h2))
            for h1, h2 in steps
        ]
    )
    variance = float(final @ final) / max(final.size - parameters - 2, 1)
    covariance: Array = np.asarray(variance * np.linalg.pinv(jacobian.T @ jacobian), dtype=np.float64)
    c1, c2 = (_determined(value, float(np.sqrt(covariance[k, k]))) for k, value in enumerate((c1, c2)))
    fitted = Wlf(c1=c1, c2_K=c2, reference_temperature_degC=reference_temperature)
    return WlfFit(fitted, covariance, np.round(heights, HEIGHT_DIGITS), float(np.sqrt(np.mean(final**2))))


def _determined(value: float, deviation: float) -> float:
    """Return the value rounded to a thousandth of its deviation: no digit that a library's kernel decides."""
    return round(value, 3 - math.floor(math.log10(max(deviation, 1e-6 * abs(value)))))


def _polished(residual: Callable[[Array], Array], q: Array) -> Array:
    """Return the minimum near `q` to round-off: where a search stops depends on the processor, the minimum does not."""
    size = np.array([1e-4, 1e-4])
    before = np.inf
    for _ in range(POLISHES):
        jacobian = np.column_stack(
            [(residual(q + step) - residual(q - step)) / (2.0 * step.sum()) for step in np.diag(size)]
        )
        step = np.linalg.solve(jacobian.T @ jacobian, jacobian.T @ residual(q))
        length = float(np.max(np.abs(step)))
        if not length < before:
            break  # round-off, or a minimum that the data do not determine
        q, before = q - step, length
    return q


class _Overlap:
    """How far the shifted sweeps are from one smooth curve."""

    def __init__(self, sweeps: tuple[Sweep, ...], reference: float, vertical: VerticalShift) -> None:
        self.above = np.concatenate([np.full(s.line.size, s.temperature - reference) for s in sweeps])
        self.log_w = np.concatenate([np.log10(s.angular_frequency) for s in sweeps])
        self.number = np.concatenate([np.full(s.line.size, k) for k, s in enumerate(sweeps)])
        self.log_moduli = [
            np.concatenate([np.log(s.storage_modulus) for s in sweeps]),
            np.concatenate([np.log(s.loss_modulus) for s in sweeps]),
        ]
        self.weights = [np.ones(self.log_w.size), np.ones(self.log_w.size)]
        self.unweighted = np.zeros(2 * self.log_w.size)
        self.count = len(sweeps)
        self.vertical = vertical
        self.intervals = 0  # set by the first constants tried, so that the problem stays smooth in them
        self.anchor = int(np.argmin([abs(s.temperature - reference) for s in sweeps]))

    def reweigh(self, c1: float, c2: float) -> None:
        """Give each point its bisquare weight at six median distances from the curve under these constants."""
        self.residual(c1, c2)
        away = np.abs(self.unweighted).reshape(2, -1)
        for k, one in enumerate(away):
            scale = 6.0 * max(float(np.median(one)), LEAST_SCALE)
            self.weights[k] = np.clip(1.0 - (one / scale) ** 2, 0.0, None)

    def residual(self, c1: float, c2: float) -> tuple[Array, Array, int]:
        """Return weighted residuals of both moduli, the vertical factors, and how many linear parameters there are."""
        x = self.log_w - c1 * self.above / (c2 + self.above)
        if not self.intervals:
            self.intervals = max(int(np.ceil(np.ptp(x) * KNOTS_PER_DECADE)), 2)
        basis = _spline_basis(x, self.intervals)
        bend = np.diff(np.eye(basis.shape[1]), 2, axis=0) * RIDGE
        if self.vertical == "none":
            parts = []
            for y, weight in zip(self.log_moduli, self.weights, strict=True):
                matrix = np.vstack([basis * weight[:, None], bend])
                right = np.concatenate([y * weight, np.zeros(bend.shape[0])])
                c = np.linalg.lstsq(matrix, right, rcond=None)[0]
                parts.append(y - basis @ c)
            self.unweighted = np.concatenate(parts)
            return self.unweighted * np.concatenate(self.weights), np.ones(self.count), 2 * basis.shape[1]
        # log b of each sweep but the one nearest to the reference, common to both moduli
        moved = np.delete(np.equal.outer(self.number, np.arange(self.count)).astype(float), self.anchor, axis=1)
        k = basis.shape[1]
        zero = np.zeros((basis.shape[0], k))
        both = np.vstack([np.hstack([basis, zero, -moved]), np.hstack([zero, basis, -moved])])
        bends = np.zeros((2 * bend.shape[0], both.shape[1]))
        bends[: bend.shape[0], :k], bends[bend.shape[0] :, k : 2 * k] = bend, bend
        weight, y = np.concatenate(self.weights), np.concatenate(self.log_moduli)
        matrix = np.vstack([both * weight[:, None], bends])
        c = np.linalg.lstsq(matrix, np.concatenate([y * weight, np.zeros(bends.shape[0])]), rcond=None)[0]
        heights = np.insert(np.exp(c[2 * k :]), self.anchor, 1.0)
        self.unweighted = y - both @ c
        return self.unweighted * weight, heights, both.shape[1]


def _spline_basis(x: Array, intervals: int) -> Array:
    low, high = float(x.min()) - 1e-9, float(x.max()) + 1e-9
    knots = np.concatenate([[low] * 3, np.linspace(low, high, intervals + 1), [high] * 3])
    from scipy.interpolate import BSpline

    return np.asarray(BSpline.design_matrix(x, knots, 3).toarray(), dtype=np.float64)
