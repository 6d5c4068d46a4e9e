"""A block pass seen as geometry: where each column's mount point is at any time, where the road is, when they meet."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .block import WidthProfile
from .columns import Columns
from .line import MountLine
from .road import Road

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MountMotion:
    """Place and motion of mount points in the axle frame.

    Attributes
    ----------
    x, y : arrays, m
    theta : array, rad
        Slope of the mount line; 0 in the middle of the patch, negative before it, positive after it.
    velocity_x, velocity_y : arrays, m/s
    angular_velocity : array, rad/s
        d theta/dt.
    """

    x: Array
    y: Array
    theta: Array
    velocity_x: Array
    velocity_y: Array
    angular_velocity: Array


@dataclass(frozen=True)
class Path:
    """The motion of one block and its road. t = 0 is the first contact of the leading end, s = 0.

    The mount point of the column at s is at the arc ``first_contact_arc + speed t - columns.arc_offset(s)`` of `line`.

    Attributes
    ----------
    line : MountLine
    road : Road
    columns : Columns
    profile : WidthProfile
        Plan shape of the block.
    speed : float, m/s
        Rate at which the arc grows: surface speed on the rig, belt speed along the belt on the tyre.
    interference : float, m
        Largest compression.
    first_contact_arc : float, m
        Arc at which the leading end's free face meets the road.
    contact_duration : float, s
        From the first contact until the last column's free face leaves the road. The rubber may let go earlier (it
        relaxes) or slightly later (it is sheared): allow a margin.
    finest_time : float, s
        Tables of the motion need points at least this close; ``inf`` where the arc's own spacing will do.
    """

    line: MountLine
    road: Road
    columns: Columns
    profile: WidthProfile
    speed: float
    interference: float
    first_contact_arc: float
    contact_duration: float
    finest_time: float = math.inf

    def mount(self, arc: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x, y (m) and theta (rad) of the mount line at the arcs (m)."""
        return self.line.mount(arc)

    def column_arc(self, s: ArrayLike, t: ArrayLike) -> Array:
        """Return the arc of the columns at `s` (m) at the times `t` (s; before 0 too), broadcast, m."""
        return self.first_contact_arc + self.speed * np.asarray(t, dtype=np.float64) - self.columns.arc_offset(s)

    def at(self, s: ArrayLike, t: ArrayLike) -> MountMotion:
        """Return place and motion of the mount points of the columns at `s` (m) at the times `t` (s), broadcast."""
        arc = self.column_arc(s, t)
        x, y, theta = self.line.mount(arc)
        forward, up = self.line.rate(arc)
        x = x + self.columns.x_offset(s)
        return MountMotion(x, y, theta, self.speed * forward, self.speed * up, self.speed * self.line.curvature(arc))

    def free_face(self, s: ArrayLike, t: ArrayLike) -> tuple[Array, Array]:
        """Return x, y (m) of the stress-free face of the columns at `s` (m) at the times `t` (s), broadcast."""
        x, y, theta = self.line.mount(self.column_arc(s, t))
        height = self.columns.column_height(s)
        x = x + self.columns.x_offset(s)
        return x + height * np.sin(theta), y - height * np.cos(theta)

    def block_curvature(self) -> float:
        """Return the curvature (1/m) of the mount of a stress-free conforming block: that of its path at first contact.

        The mean over the block's length, for a trace curves by a little more here and a little less there.
        """
        arcs = self.first_contact_arc - self.columns.arc_offset(np.linspace(0.0, self.columns.extent, 101))
        curvature = self.line.curvature(arcs)
        return float(curvature[0]) if np.ptp(curvature) == 0.0 else float(np.mean(curvature))

    def indentation(self, s: ArrayLike, t: ArrayLike) -> Array:
        """Return how deep the stress-free face would stand in the road, m; negative where it is clear of it."""
        return -self.road.gap(*self.free_face(s, t))
