"""Mount lines: the curve that the mount point of a column follows in the axle frame, against the arc travelled.

Every line gives x, y and theta at an arc; theta is the slope of the line, so that the tangent is
(cos theta, sin theta) and the column's neutral line points along (sin theta, -cos theta), towards the road.
`code`, `parameters` and `table` say the same thing to compiled kernels.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
EMPTY_TABLE = np.zeros((1, 4))
ARC_FLAT_ARC, WHEEL, TABULATED, DOWN_AND_UP = 0, 1, 2, 3  # codes of lines, never used twice


class MountLine(Protocol):
    """A curve with an arc rate; see the module's text."""

    @property
    def code(self) -> int:
        """By which compiled kernels know the line: `ARC_FLAT_ARC`, `WHEEL`, `TABULATED`, `DOWN_AND_UP`, ..."""

    @property
    def parameters(self) -> Array:
        """Numbers that the compiled kernels need, by code."""

    @property
    def table(self) -> Array:
        """Table (n, 4) of x, y, theta, curvature at equal arc steps of a `TABULATED` line, else a dummy."""

    @property
    def speed_ratio(self) -> float:
        """Speed of the mount along its line over the arc rate (below 1 on the rig's ring)."""

    @property
    def ring_radius(self) -> float | None:
        """Radius of the rigid ring that the mount is, m; None where each row of it follows the line."""

    @property
    def corners(self) -> tuple[float, ...]:
        """Arcs at which the curvature jumps, m."""

    def mount(self, arc: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x, y (m) and theta (rad) at the arcs (m)."""

    def curvature(self, arc: ArrayLike) -> Array:
        """Return d theta / d arc at the arcs, 1/m."""

    def rate(self, arc: ArrayLike) -> tuple[Array, Array]:
        """Return d x / d arc and d y / d arc at the arcs."""


class _Tangential:
    """A line along which the mount moves, as every line of a rolling block is."""

    @property
    def ring_radius(self) -> float | None:
        """None: each row of the mount follows the line."""
        return None

    def rate(self: MountLine, arc: ArrayLike) -> tuple[Array, Array]:
        """Return d x / d arc and d y / d arc at the arcs."""
        theta = self.mount(arc)[2]
        return self.speed_ratio * np.cos(theta), self.speed_ratio * np.sin(theta)


@dataclass(frozen=True)
class ArcFlatArc(_Tangential):
    """A flat patch of given length between two arcs, symmetrical about arc 0 = x 0 (Fig. 15 of the paper).

    Attributes
    ----------
    patch_length, edge_radius : float, m
    patch_height : float, m
        Height of the mount over the road in the patch.
    """

    patch_length: float
    edge_radius: float
    patch_height: float
    code: int = ARC_FLAT_ARC
    speed_ratio: float = 1.0

    @property
    def parameters(self) -> Array:
        """Half the patch length, edge radius, patch height."""
        return np.array([0.5 * self.patch_length, self.edge_radius, self.patch_height])

    @property
    def table(self) -> Array:
        """Not read for this kind of line; the compiled code takes a table for every kind."""
        return EMPTY_TABLE

    @property
    def corners(self) -> tuple[float, ...]:
        """The two ends of the flat patch."""
        return (-0.5 * self.patch_length, 0.5 * self.patch_length)

    def mount(self, arc: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x, y (m) and theta (rad) at the arcs (m)."""
        arc = np.asarray(arc, dtype=np.float64)
        flat = np.clip(arc, -0.5 * self.patch_length, 0.5 * self.patch_length)
        theta = (arc - flat) / self.edge_radius
        x = flat + self.edge_radius * np.sin(theta)
        y = self.patch_height + 2.0 * self.edge_radius * np.sin(0.5 * theta) ** 2
        return x, y, theta

    def curvature(self, arc: ArrayLike) -> Array:
        """Return d theta / d arc at the arcs, 1/m."""
        return np.where(np.abs(np.asarray(arc)) < 0.5 * self.patch_length, 0.0, 1.0 / self.edge_radius)


@dataclass(frozen=True)
class WheelLine(_Tangential):
    """The ring on which the rig's block is mounted; the arc is counted on the tread surface.

    Attributes
    ----------
    surface_radius : float, m
        Radius of the tread surface; theta = arc / surface_radius.
    mount_radius : float, m
        Radius of the ring.
    axle_height : float, m
        Height of the axle over the highest point of the big wheel.
    """

    surface_radius: float
    mount_radius: float
    axle_height: float
    code: int = WHEEL

    @property
    def parameters(self) -> Array:
        """Surface radius, mount radius, axle height."""
        return np.array([self.surface_radius, self.mount_radius, self.axle_height])

    @property
    def table(self) -> Array:
        """Not read for this kind of line; the compiled code takes a table for every kind."""
        return EMPTY_TABLE

    @property
    def ring_radius(self) -> float:
        """Radius of the ring, m."""
        return self.mount_radius

    @property
    def speed_ratio(self) -> float:
        """Ring speed over surface speed."""
        return self.mount_radius / self.surface_radius

    @property
    def corners(self) -> tuple[float, ...]:
        """None: a circle is smooth."""
        return ()

    def mount(self, arc: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x, y (m) and theta (rad) at the arcs (m)."""
        theta = np.asarray(arc, dtype=np.float64) / self.surface_radius
        return self.mount_radius * np.sin(theta), self.axle_height - self.mount_radius * np.cos(theta), theta

    def curvature(self, arc: ArrayLike) -> Array:
        """Return d theta / d arc at the arcs, 1/m."""
        return np.full(np.shape(arc), 1.0 / self.surface_radius)


@dataclass(frozen=True)
class TabulatedLine(_Tangential):
    """A line given at equal arc steps, with cubic Hermite interpolation; beyond its ends it goes on as circles.

    Attributes
    ----------
    first_arc, step : float, m
        Arc of the first row and the distance between rows.
    table : (n, 4) array
        x (m), y (m), theta (rad), d theta/d arc (1/m).
    """

    first_arc: float
    step: float
    table: Array = field(repr=False)
    code: int = TABULATED
    speed_ratio: float = 1.0

    @property
    def parameters(self) -> Array:
        """First arc, step, a filler."""
        return np.array([self.first_arc, self.step, 0.0])

    @property
    def corners(self) -> tuple[float, ...]:
        """None: the table is smooth."""
        return ()

    @property
    def last_arc(self) -> float:
        """Arc of the last row, m."""
        return self.first_arc + self.step * (len(self.table) - 1)

    def mount(self, arc: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x, y (m) and theta (rad) at the arcs (m)."""
        left, right, weight, beyond = self._interval(arc)
        h00 = (1.0 + 2.0 * weight) * (1.0 - weight) ** 2
        h10 = weight * (1.0 - weight) ** 2 * self.step
        h01 = weight**2 * (3.0 - 2.0 * weight)
        h11 = weight**2 * (weight - 1.0) * self.step
        x = h00 * left[0] + h10 * np.cos(left[2]) + h01 * right[0] + h11 * np.cos(right[2])
        y = h00 * left[1] + h10 * np.sin(left[2]) + h01 * right[1] + h11 * np.sin(right[2])
        theta = h00 * left[2] + h10 * left[3] + h01 * right[2] + h11 * right[3]
        end = np.where(beyond < 0.0, left[3], right[3])
        half = 0.5 * beyond * end
        chord = beyond * np.sinc(half / np.pi)
        return x + chord * np.cos(theta + half), y + chord * np.sin(theta + half), theta + 2.0 * half

    def curvature(self, arc: ArrayLike) -> Array:
        """Return d theta / d arc at the arcs, 1/m."""
        left, right, weight, beyond = self._interval(arc)
        slope = 6.0 * weight * (1.0 - weight) * (right[2] - left[2]) / self.step
        inside = slope + (1.0 - weight) * (1.0 - 3.0 * weight) * left[3] + weight * (3.0 * weight - 2.0) * right[3]
        return np.asarray(np.where(beyond < 0.0, left[3], np.where(beyond > 0.0, right[3], inside)), dtype=np.float64)

    def _interval(self, arc: ArrayLike) -> tuple[Array, Array, Array, Array]:
        arc = np.asarray(arc, dtype=np.float64)
        inside = np.clip(arc, self.first_arc, self.last_arc)
        place = (inside - self.first_arc) / self.step
        index = np.minimum(place.astype(np.intp), len(self.table) - 2)
        columns = self.table.T
        return columns[:, index], columns[:, index + 1], place - index, arc - inside
