"""A loaded belt's traces: from ridge heights to levelled lines with patch length and edge radius."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..units import IN_MM
from .trace_curvature import three_point_curvature
from .trace_fit import KNOT_SPACING, PatchFit, fit_patch

Array = NDArray[np.float64]

PITCH_TOLERANCE = 1e-3  # of the pitch


@dataclass(frozen=True)
class RidgeHeights:
    """Heights of longitudinal ridges as measured.

    Attributes
    ----------
    position : (n,) array, m
        At constant pitch, increasing.
    heights : mapping of ridge name to (n,) array, m
        Positive away from the road; NaN is a gap. Tilt and offset are arbitrary.
    source : str
        File that they come from.
    """

    position: Array
    heights: Mapping[str, Array]
    source: str

    @property
    def pitch(self) -> float:
        """Distance of neighbouring points, m."""
        return float((self.position[-1] - self.position[0]) / (self.position.size - 1))


@dataclass(frozen=True)
class Estimate:
    """A value with the half-width of its 95 % interval, in the unit of the value."""

    value: float
    half_width: float


@dataclass(frozen=True)
class LevelledTrace:
    """One ridge, levelled, smoothed and centred on the patch.

    Attributes
    ----------
    name : str
    x, height : (n,) arrays, m
        Smoothed line at constant pitch; height is 0 on the flat patch and positive away from the road.
    measured_x, measured_height : (m,) arrays, m
        Measured points in the same frame, tilt and offset removed, NaN at gaps.
    measured_curvature : (m,) array, 1/m
        Circle through each measured point and its two neighbours, nothing smoothed.
    curvature : (n,) array, 1/m
        The same of the smoothed line.
    spikes : (k,) array, m
        Positions x of points that were set aside.
    edges : (float, float), m
        Leading and trailing edge of the patch.
    patch_length, edge_radius : Estimate, m
        The simplified profile's l and R_d, from the mean of both edges' curvatures.
    noise : float, m
        Standard deviation of the measured points used about the smoothed line.
    edge_shift : float, m
        Largest move of an edge by setting the spikes aside.
    """

    name: str
    x: Array
    height: Array
    measured_x: Array
    measured_height: Array
    measured_curvature: Array
    curvature: Array
    spikes: Array
    edges: tuple[float, float]
    patch_length: Estimate
    edge_radius: Estimate
    noise: float
    edge_shift: float


def level(ridges: RidgeHeights) -> tuple[LevelledTrace, ...]:
    """Return every ridge levelled and smoothed, in one frame whose x = 0 is the mean middle of their patches.

    Raises `InputError` for an unequal pitch, too few points, a ridge without a flat patch or one that bends towards
    the road outside it.
    """
    _check(ridges)
    fits = {name: fit_patch(ridges.position, y, f"{ridges.source}: {name}") for name, y in ridges.heights.items()}
    centre = float(np.mean([0.5 * sum(fit.edges) for fit in fits.values()]))
    return tuple(_levelled(ridges, name, fit, centre) for name, fit in fits.items())


def smoothed_line(ridges: RidgeHeights, name: str) -> tuple[Array, Array]:
    """Return place and height in m of one ridge as `level` does, without the estimates; both (n,)."""
    _check(ridges)
    fits = {other: fit_patch(ridges.position, y, f"{ridges.source}: {other}") for other, y in ridges.heights.items()}
    centre = float(np.mean([0.5 * sum(fit.edges) for fit in fits.values()]))
    return _line(fits[name], ridges.pitch, centre, f"{ridges.source}: {name}")


def _line(fit: PatchFit, pitch: float, centre: float, where: str) -> tuple[Array, Array]:
    first, last = (int(np.trunc((end - centre) / pitch)) for end in fit.span)
    x = np.asarray(np.arange(first, last + 1) * pitch, dtype=np.float64)
    height = fit.height(x + centre)
    if min(height[0], height[-1]) < 0:
        expected = "heights positive away from the road (--invert turns them)"
        raise InputError(where, "a line that bends towards the road outside the patch", expected)
    return x, height


def _levelled(ridges: RidgeHeights, name: str, fit: PatchFit, centre: float) -> LevelledTrace:
    position, raw = ridges.position, ridges.heights[name]
    where = f"{ridges.source}: {name}"
    x, height = _line(fit, ridges.pitch, centre, where)
    levelled = fit.level(position, raw)
    used_gap = np.isfinite(raw) & ~fit.used
    shift = 0.0
    if used_gap.any():
        kept = fit_patch(position, raw, where, keep_spikes=True, near=fit.edges).edges
        shift = max(abs(kept[0] - fit.edges[0]), abs(kept[1] - fit.edges[1]))
    return LevelledTrace(
        name=name,
        x=x,
        height=height,
        measured_x=position - centre,
        measured_height=levelled,
        measured_curvature=three_point_curvature(position, levelled),
        curvature=three_point_curvature(x, height),
        spikes=position[used_gap] - centre,
        edges=(fit.edges[0] - centre, fit.edges[1] - centre),
        patch_length=_patch_length(ridges, name, fit),
        edge_radius=_edge_radius(fit),
        noise=fit.noise,
        edge_shift=shift,
    )


def _patch_length(ridges: RidgeHeights, name: str, fit: PatchFit) -> Estimate:
    """Statistical 95 % interval, widened by what another knot spacing changes."""
    others = [
        fit_patch(ridges.position, ridges.heights[name], name, factor * KNOT_SPACING, near=fit.edges).patch_length
        for factor in (2.0 / 3.0, 4.0 / 3.0)
    ]
    model = max(abs(other - fit.patch_length) for other in others)
    return Estimate(fit.patch_length, float(np.hypot(1.96 * fit.patch_length_deviation, model)))


def _edge_radius(fit: PatchFit) -> Estimate:
    curvature = 0.5 * sum(fit.edge_curvatures)
    deviation = 0.5 * float(np.hypot(*fit.edge_curvature_deviations))
    return Estimate(1.0 / curvature, 1.96 * deviation / curvature**2)


def _check(ridges: RidgeHeights) -> None:
    steps = np.diff(ridges.position)
    pitch = float(np.median(steps)) if steps.size else 0.0
    if ridges.position.size < 30:
        raise InputError(ridges.source, f"{ridges.position.size} points", "at least 30")
    wrong = np.abs(steps - pitch) > PITCH_TOLERANCE * pitch
    if not pitch > 0 or wrong.any():
        row = int(np.argmax(wrong))
        found = f"a step of {steps[row] * IN_MM:.4g} mm at point {row + 2}"
        raise InputError(ridges.source, found, f"the constant pitch of {pitch * IN_MM:.4g} mm (leave gaps empty)")
    for name, heights in ridges.heights.items():
        if np.isfinite(heights).sum() < 30:
            raise InputError(f"{ridges.source}: {name}", f"{np.isfinite(heights).sum()} heights", "at least 30")
        bends = np.diff(heights, 2)
        if not np.nanmax(np.abs(bends), initial=0.0) > 1e-12:
            raise InputError(f"{ridges.source}: {name}", "a straight line", "a flat patch between two bends")
