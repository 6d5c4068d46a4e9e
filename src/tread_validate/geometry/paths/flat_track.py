"""A flat track: a block pressed on a plane that moves under it, as on a linear friction tester."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field

from ...fields import Positive
from ...units import IN_MM, IN_MS, MS
from ..block import block_profile
from ..columns import Columns
from ..line import DOWN_AND_UP, EMPTY_TABLE
from ..path import Path
from ..path_entry import Conditions, Family, PathEntry, Sketch, check_interference
from ..road import Road

Array = NDArray[np.float64]


@dataclass(frozen=True)
class DownAndUp:
    """A mount that goes straight down on the road and up again; the arc is the travel of the road.

    Down by D sin(pi a / (2 pressed)), held, up by D cos of the same; before and after at the speed that it has there:
    the velocity is continuous everywhere.

    Attributes
    ----------
    height, depth : float, m
        Height of the mount at the first contact, and how far it goes down from there.
    pressed, released, left : float, m
        Travel of the road at the end of the approach, at the start of the retreat, at its end; 0 at the first contact.
    """

    height: float
    depth: float
    pressed: float
    released: float
    left: float
    code: int = DOWN_AND_UP
    speed_ratio: float = 0.0
    ring_radius: float | None = None

    @property
    def parameters(self) -> Array:
        """Height, depth, the three travels."""
        return np.array([self.height, self.depth, self.pressed, self.released, self.left])

    @property
    def table(self) -> Array:
        """Not read for this kind of line; the compiled code takes a table for every kind."""
        return EMPTY_TABLE

    @property
    def corners(self) -> tuple[float, ...]:
        """Where the acceleration jumps."""
        return (self.pressed, self.released, self.left)

    def mount(self, arc: ArrayLike) -> tuple[Array, Array, Array]:
        """Return x, y (m) and theta (rad) at the arcs (m)."""
        arc = np.asarray(arc, dtype=np.float64)
        down, up = self._phases(arc)
        depth = self.depth * np.where(
            arc < self.released, np.sin(np.clip(down, 0.0, 0.5 * np.pi)), np.cos(np.minimum(up, 0.5 * np.pi))
        )
        # beyond the ends at the speed of the end
        depth = np.where(
            arc < 0.0, self.depth * down, np.where(arc > self.left, self.depth * (0.5 * np.pi - up), depth)
        )
        return np.zeros(arc.shape), self.height - depth, np.zeros(arc.shape)

    def rate(self, arc: ArrayLike) -> tuple[Array, Array]:
        """Return d x / d arc and d y / d arc at the arcs."""
        arc = np.asarray(arc, dtype=np.float64)
        down, up = self._phases(arc)
        sinking = np.where(down < 0.0, 1.0, np.cos(np.clip(down, 0.0, 0.5 * np.pi))) * 0.5 * np.pi / self.pressed
        rising = np.sin(np.clip(up, 0.0, 0.5 * np.pi)) * 0.5 * np.pi / (self.left - self.released)
        return np.zeros(arc.shape), self.depth * np.where(arc < self.released, -sinking, rising)

    def curvature(self, arc: ArrayLike) -> Array:
        """Return d theta / d arc at the arcs, 1/m: the mount does not turn."""
        return np.zeros(np.shape(arc))

    def _phases(self, arc: Array) -> tuple[Array, Array]:
        """Return the phases of approach and retreat, pi/2 at the end of each."""
        down = 0.5 * np.pi * arc / self.pressed
        up = 0.5 * np.pi * (arc - self.released) / (self.left - self.released)
        return down, up


class FlatTrack(PathEntry):
    """A block pressed on a moving plane: down, held, up; the run's speed is the plane's."""

    family: ClassVar[Family] = "track"
    rolls: ClassVar[bool] = False

    example: ClassVar[Mapping[str, Any]] = {"approach_ms": 2.0, "hold_ms": 5.0, "retreat_ms": 2.0}

    kind: Literal["flat_track"]
    approach_ms: Positive = Field(description="from the first contact to the full depth, along a quarter of a sine")
    hold_ms: Positive = Field(description="at the full depth")
    retreat_ms: Positive = Field(description="from the full depth until the stress-free block would be clear")

    def build(self, run: Conditions) -> Path:
        """Return the path; the arc is the travel of the plane."""
        check_interference(run)
        profile = block_profile(run.block)
        pressed, released, left = (
            MS * time * run.speed
            for time in (
                self.approach_ms,
                self.approach_ms + self.hold_ms,
                self.approach_ms + self.hold_ms + self.retreat_ms,
            )
        )
        return Path(
            line=DownAndUp(run.height, run.interference, pressed, released, left),
            road=Road(),
            columns=Columns(run.height, profile.extent, math.inf, together=True),
            profile=profile,
            speed=run.speed,
            interference=run.interference,
            first_contact_arc=0.0,
            contact_duration=left / run.speed,
            finest_time=1e-5 * min(self.approach_ms, self.retreat_ms),
        )

    def sketch(self, path: Path) -> Sketch:
        """Return the height of the block's face over the plane against time."""
        time = np.linspace(-0.1, 1.1, 481) * path.contact_duration
        face = path.free_face(0.5 * path.columns.extent, time)[1]
        return Sketch(
            "time, ms",
            "height over the road, mm",
            {"face": (IN_MS * time, IN_MM * face), "road": (IN_MS * time, 0 * face)},
        )
