"""Levelling and smoothing one ridge trace: a flat patch between two edges, a curved belt on either side.

The smoothed line is y(x) = offset + tilt x + the double integral of a second derivative that is zero between the two
edges and piecewise linear outside, with knots at a fixed spacing from each edge. It may jump at the edge, so
smoothing does not round the edge off, and nothing of the noise is left inside the patch. Outside, the curvature is
held smooth by a Gaussian prior on its second differences: without it a jump inside the flank could stand for the edge.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..units import MM

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

KNOT_SPACING = 12e-3  # m
SLOPE = 0.6  # 1/m: prior standard deviation of the change of curvature over 12 mm
BENDING = 0.5  # 1/m: prior standard deviation of the second difference of curvature over 12 mm
CONCAVE_PENALTY = 1e3
SCAN = np.arange(-15, 16, 3) * MM  # m, about the first guess of an edge
SPIKE_LIMIT = 4.5  # robust standard deviations from the smoothed line
FEWEST_PATCH_POINTS = 10


@dataclass(frozen=True)
class PatchFit:
    """A trace as flat patch and curved flanks.

    Attributes
    ----------
    edges : (float, float), m
        Leading and trailing edge in the coordinate of the data.
    coefficients : (k,) array
        Offset (m), tilt, then second derivatives (1/m) at the knots of the leading and of the trailing flank.
    knot_spacing : float, m
    used : (n,) bool array
        Points that were not set aside as spikes or gaps.
    noise : float, m
        Standard deviation of the points used about the line.
    covariance : (k + 2, k + 2) array
        Of edges, then coefficients.
    """

    edges: tuple[float, float]
    coefficients: Array
    knot_spacing: float
    span: tuple[float, float]
    used: Mask
    noise: float
    covariance: Array

    @property
    def patch_length(self) -> float:
        """Distance of the edges, m."""
        return self.edges[1] - self.edges[0]

    @property
    def patch_length_deviation(self) -> float:
        """Standard deviation of the patch length, m."""
        c = self.covariance
        return float(np.sqrt(max(c[0, 0] + c[1, 1] - 2.0 * c[0, 1], 0.0)))

    @property
    def edge_curvatures(self) -> tuple[float, float]:
        """Curvature just outside the leading and the trailing edge, 1/m."""
        leading = 2 + _knots(self.edges[0] - self.span[0], self.knot_spacing)
        return float(self.coefficients[2]), float(self.coefficients[leading])

    @property
    def edge_curvature_deviations(self) -> tuple[float, float]:
        """Standard deviations of the two edge curvatures, 1/m."""
        leading = 4 + _knots(self.edges[0] - self.span[0], self.knot_spacing)
        return float(np.sqrt(self.covariance[4, 4])), float(np.sqrt(self.covariance[leading, leading]))

    def height(self, x: Array) -> Array:
        """Return the levelled smoothed height above the patch in m, 0 inside it, at x in m."""
        matrix = design(x, self.edges, self.span, self.knot_spacing)
        return np.asarray(matrix[:, 2:] @ self.coefficients[2:], dtype=np.float64)

    def level(self, x: Array, y: Array) -> Array:
        """Return measured heights in m less offset and tilt of the patch."""
        return np.asarray(y - self.coefficients[0] - self.coefficients[1] * x, dtype=np.float64)


def _knots(reach: float, spacing: float) -> int:
    """Return the number of knots of a flank of length `reach`, the one at the edge included."""
    return max(int(np.ceil(reach / spacing)), 1) + 1


def _flank(distance: Array, knots: int, spacing: float) -> Array:
    """Return the double integrals of the hat functions at 0, spacing, 2 spacing ... at `distance` from the edge."""
    d = np.maximum(distance, 0.0)
    beyond = np.maximum(d[:, None] - spacing * np.arange(-1, knots + 1), 0.0)
    ramps = beyond * beyond * beyond / (6.0 * spacing)
    hats = ramps[:, :-2] - 2.0 * ramps[:, 1:-1] + ramps[:, 2:]
    # the first hat has only its outer half: 1 at the edge, falling to 0 at the first knot
    hats[:, 0] = 0.5 * d * d - ramps[:, 1] + ramps[:, 2]
    return np.asarray(hats, dtype=np.float64)


def design(x: Array, edges: tuple[float, float], span: tuple[float, float], spacing: float) -> Array:
    """Return the columns offset, tilt, leading knots, trailing knots of the line at x in m."""
    leading = _flank(edges[0] - x, _knots(edges[0] - span[0], spacing), spacing)
    trailing = _flank(x - edges[1], _knots(span[1] - edges[1], spacing), spacing)
    return np.hstack([np.ones((x.size, 1)), x[:, None], leading, trailing])


def prior(edges: tuple[float, float], span: tuple[float, float], spacing: float) -> Array:
    """Return the rows of the prior: first and second differences of the flanks' knots over their deviations."""
    return _prior((_knots(edges[0] - span[0], spacing), _knots(span[1] - edges[1], spacing)), spacing)


@lru_cache(maxsize=64)
def _prior(knots: tuple[int, int], spacing: float) -> Array:
    per_knot = spacing / KNOT_SPACING
    stencils = (
        np.array([-1.0, 1.0]) / (SLOPE * per_knot),
        np.array([1.0, -2.0, 1.0]) / (BENDING * per_knot**1.5),
    )
    rows: list[Array] = []
    for start, count in ((2, knots[0]), (2 + knots[0], knots[1])):
        for stencil in stencils:
            for k in range(count - stencil.size + 1):
                row = np.zeros(2 + sum(knots))
                row[start + k : start + k + stencil.size] = stencil
                rows.append(row)
    return np.array(rows)


@dataclass(frozen=True)
class _Problem:
    """Heights to be fitted, with the noise that weighs them against the prior."""

    x: Array
    y: Array
    span: tuple[float, float]
    spacing: float
    noise: float

    def system(self, edges: tuple[float, float]) -> tuple[Array, Array]:
        """Return the matrix and right side of the fit, every row over its standard deviation."""
        data = design(self.x, edges, self.span, self.spacing) / self.noise
        rows = prior(edges, self.span, self.spacing)
        return np.vstack([data, rows]), np.concatenate([self.y / self.noise, np.zeros(rows.shape[0])])

    def solve(self, edges: tuple[float, float]) -> tuple[Array, float]:
        """Return the coefficients at given edges and the misfit there."""
        matrix, right = self.system(edges)
        scale = np.linalg.norm(matrix, axis=0)
        coefficients = np.linalg.lstsq(matrix / scale, right, rcond=None)[0] / scale
        residual = right - matrix @ coefficients
        return coefficients, float(residual @ residual)

    def best_edges(self, start: tuple[float, float]) -> tuple[float, float]:
        """Return the edges of least misfit: a scan of each about `start`, then Nelder and Mead's method."""
        from scipy.optimize import minimize

        def misfit(edges: Array) -> float:
            first, last = self.span
            if not first + self.spacing < edges[0] < edges[1] - self.spacing < last - 2.0 * self.spacing:
                return 1e12
            found, value = self.solve((float(edges[0]), float(edges[1])))
            leading, trailing = found[2], found[2 + _knots(float(edges[0]) - first, self.spacing)]
            # a belt cannot bend towards the road where it leaves it
            return value + CONCAVE_PENALTY * float(min(leading, 0.0) ** 2 + min(trailing, 0.0) ** 2)

        for side in (0, 1):
            offsets = np.zeros((len(SCAN), 2))
            offsets[:, side] = SCAN
            candidates = np.array(start) + offsets
            nearest = candidates[int(np.argmin([misfit(edges) for edges in candidates]))]
            start = float(nearest[0]), float(nearest[1])
        simplex = np.array([start, (start[0] + 2e-3, start[1]), (start[0], start[1] - 2e-3)])
        found = minimize(
            misfit,
            np.array(start),
            method="Nelder-Mead",
            options={"initial_simplex": simplex, "xatol": 1e-6, "fatol": 1e-4},
        )
        return float(found.x[0]), float(found.x[1])

    def covariance(self, edges: tuple[float, float], coefficients: Array) -> Array:
        """Return the covariance of edges and coefficients, of the problem made linear at the solution."""
        matrix, _ = self.system(edges)
        derivative = []
        for side in (0, 1):
            for h in (1e-6, -1e-6):
                moved = [edges[0], edges[1]]
                moved[side] += h
                other, _ = self.system((moved[0], moved[1]))
                if other.shape == matrix.shape:  # the nudge did not add a knot
                    derivative.append((other - matrix) @ coefficients / h)
                    break
        jacobian = np.column_stack([*derivative, matrix])
        scale = np.linalg.norm(jacobian, axis=0)
        inverse = np.linalg.pinv((jacobian / scale).T @ (jacobian / scale), rcond=1e-14)
        return np.asarray(inverse / np.outer(scale, scale), dtype=np.float64)


def _noise_of(y: Array) -> float:
    """Return the standard deviation of the noise in evenly spaced heights, from their third differences."""
    third = np.abs(np.diff(y, 3))
    third = third[np.isfinite(third)]
    # heights in steps of the resolution have a median in steps too: use it only to set spikes aside
    kept = third[third <= 5.0 * np.median(third)]
    return max(float(np.sqrt(np.mean(kept**2) / 20.0)), 1e-8)


def fit_patch(
    x: Array,
    y: Array,
    where: str,
    knot_spacing: float = KNOT_SPACING,
    keep_spikes: bool = False,
    near: tuple[float, float] | None = None,
) -> PatchFit:
    """Fit patch and flanks to heights `y` in m (NaN: gap, positive away from the road) at `x` in m, both (n,).

    The edges minimise the squared residual. Spikes (beyond 4.5 robust standard deviations) are set aside and the fit
    repeated until none is left, unless `keep_spikes`. The search starts from edges `near`, where given. Raises
    `InputError` where there is no flat patch to be found.
    """
    measured = np.isfinite(y)
    used = measured.copy()
    span = float(x[measured][0]), float(x[measured][-1])
    noise = _noise_of(y)
    edges = near if near is not None else _first_guess(x[used], y[used], where)
    for _ in range(20):
        problem = _Problem(x[used], y[used], span, knot_spacing, noise)
        edges = problem.best_edges(edges)
        coefficients, _ = problem.solve(edges)
        residual = y - design(x, edges, span, knot_spacing) @ coefficients
        deviation = 1.4826 * float(np.median(np.abs(residual[used])))
        spikes = measured & (np.abs(residual) > SPIKE_LIMIT * max(deviation, 1e-8))
        if keep_spikes or np.array_equal(measured & ~spikes, used):
            break
        used = measured & ~spikes
    inside = int(np.sum(used & (x > edges[0]) & (x < edges[1])))
    if inside < FEWEST_PATCH_POINTS:
        raise InputError(where, f"{inside} points on a flat patch", f"at least {FEWEST_PATCH_POINTS}")
    found = float(np.sqrt(np.mean(residual[used] ** 2)))
    covariance = problem.covariance(edges, coefficients)
    return PatchFit(edges, coefficients, knot_spacing, span, used, found, covariance)


def _first_guess(x: Array, y: Array, where: str) -> tuple[float, float]:
    """Return rough edges: among lines through any stretch, the longest that the heights stay close to."""
    best: tuple[float, float] | None = None
    step = max(x.size // 60, 1)
    starts = np.arange(0, x.size - FEWEST_PATCH_POINTS, step)
    limit = 15e-6 + 0.5 * float(np.median(np.abs(np.diff(y, 2))))
    for first in starts:
        for last in range(x.size - 1, first + FEWEST_PATCH_POINTS, -step):
            if best is not None and x[last] - x[first] <= best[1] - best[0]:
                break
            xs, ys = x[first : last + 1], y[first : last + 1]
            xc = xs - xs.mean()
            residual = ys - ys.mean() - xc * (xc @ ys) / (xc @ xc)
            if np.sqrt(np.mean(residual**2)) < limit:
                best = float(x[first]), float(x[last])
                break
    if best is None:
        raise InputError(where, "no straight stretch", "heights of a loaded belt with a flat patch")
    return best
