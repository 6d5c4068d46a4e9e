"""A tread block as a state that a host advances: for belts that give way, vibrating tyres, driving simulations."""

from __future__ import annotations

import copy
import importlib
import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..model_names import current_name
from ..study import Case

Array = NDArray[np.float64]

MODELS: Mapping[str, str] = MappingProxyType({
    "paper": "element_block:block_of",
    "condensed": "condensed.face_pass:block_of",
    "condensed_coarse": "condensed.face_pass:coarse_block_of",
})  # fmt: skip
"""Models that can be stepped, and what makes their state."""


class State(Protocol):
    """What a model gives a host."""

    mount_points: Array

    def start(self, position: Array, angle: float, mount: Array | None) -> None:
        """Forget the past; the block is stress-free at this pose."""

    def step(
        self, dt: float, position: Array, angle: float, road_speed: float, mount: Array | None
    ) -> tuple[float, float]:
        """Advance by `dt` to a pose; return N and T."""

    def copy(self) -> State:
        """Return the block with a state of its own."""


class TreadBlock:
    """A tread block between a mount that a host moves and a rigid road.

    >>> block = TreadBlock(case)                      # block, compound, temperature, friction and road of the case
    >>> block.start(position=(0.0, 9e-3), angle=0.0)  # 1 mm clear of the road: the block is 8 mm high
    >>> normal, tangential = block.step(1e-5, (1.7e-4, 8.9e-3), 0.0, road_speed=16.7)

    Parameters
    ----------
    case : Case
        Its path gives the road (plane, or the rig's big wheel) and, for a conforming block, the stress-free shape;
        its interference, speed and creep are the host's business.
    model : str
        One of `MODELS`.

    Attributes
    ----------
    mount_points : (k,) array, m
        Places along the block, from the middle, positive in the direction of travel, at which a bending mount is
        given to `step`.

    Notes
    -----
    Axes: x in the direction of travel, y up, origin on the road (the big wheel's top); the mount moves from -x to +x.
    The time step is the host's: a face is followed best when it travels half an element (height/16) or less a step
    while the contact's edge moves; springs of `paper` find touch, slip and release within a step. Between steps the
    mount moves evenly.
    """

    def __init__(self, case: Case, model: str = "condensed") -> None:
        model = current_name(model)
        if model not in MODELS:
            raise InputError("tread block: model", model, f"one of {', '.join(MODELS)}")
        module, _, function = MODELS[model].partition(":")
        self._state: State = getattr(importlib.import_module(f"{__package__}.{module}"), function)(case)
        self.mount_points = self._state.mount_points

    def start(self, position: Sequence[float], angle: float, mount: Any = None) -> None:
        """Put the block, stress-free, at a pose (as in `step`); a block must be clear of the road there."""
        self._state.start(self._place(position), self._number("angle", angle), self._mount(mount))

    def step(
        self, dt: float, position: Sequence[float], angle: float, road_speed: float, mount: Any = None
    ) -> tuple[float, float]:
        """Advance the block by `dt` and return the forces of the road on it at the end of the step.

        Parameters
        ----------
        dt : float, s
            More than 0.
        position : (x, y), m
            Mount above the middle of the block at the end of the step.
        angle : float, rad
            Slope of the mount there.
        road_speed : float, m/s
            Of the road's surface towards +x, over the step.
        mount : (k, 2) or (k, 3) array, m, optional
            Positions of the mount at `mount_points` and its slope there (rad; `paper` takes differences where it is
            not given); without it the mount is rigid.

        Returns
        -------
        normal, tangential : float, N
            N upwards; T positive towards -x, the leading edge of the contact.

        Raises
        ------
        InputError
            For a number that is not finite, dt <= 0, a mount of another shape, or a step before `start`.
        """
        if not dt > 0.0 or not math.isfinite(dt):
            raise InputError("tread block: dt", dt, "more than 0 s")
        speed = self._number("road_speed", road_speed)
        return self._state.step(dt, self._place(position), self._number("angle", angle), speed, self._mount(mount))

    def copy(self) -> TreadBlock:
        """Return a block in the same state that goes its own way: to try a step and take it back."""
        twin = copy.copy(self)
        twin._state = self._state.copy()
        return twin

    @staticmethod
    def _place(position: Sequence[float]) -> Array:
        place = np.asarray(position, dtype=np.float64)
        if place.shape != (2,) or not np.all(np.isfinite(place)):
            raise InputError("tread block: position", position, "two finite numbers, m")
        return place

    @staticmethod
    def _number(name: str, value: float) -> float:
        if not math.isfinite(value):
            raise InputError(f"tread block: {name}", value, "a finite number")
        return float(value)

    def _mount(self, mount: Any) -> Array | None:
        if mount is None:
            return None
        places = np.asarray(mount, dtype=np.float64)
        sizes = ((self.mount_points.size, 2), (self.mount_points.size, 3))
        if places.shape not in sizes or not np.all(np.isfinite(places)):
            raise InputError("tread block: mount", places.shape, f"{self.mount_points.size} finite positions (x, y), m")
        return places
