"""Which way is up and which way the block travels, in a deck that may stand any way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError

Floats = NDArray[np.float64]
DIRECTIONS = ("+x", "-x", "+y", "-y", "+z", "-z")


@dataclass(frozen=True)
class Axes:
    """The global axes along which forces count.

    Attributes
    ----------
    normal : str
        ``+y`` and the like: out of the road, so that N > 0 presses.
    travel : str
        The way the block goes: T > 0 holds it back.
    """

    normal: str
    travel: str

    def __post_init__(self) -> None:
        for name, value in (("normal", self.normal), ("travel", self.travel)):
            if value not in DIRECTIONS:
                raise InputError(name, value, " or ".join(DIRECTIONS))
        if self.normal[1] == self.travel[1]:
            raise InputError("travel", self.travel, f"a direction across the normal, {self.normal}")

    @property
    def normal_vector(self) -> Floats:
        """Unit vector of `normal`, (3,)."""
        return _unit(self.normal)

    @property
    def travel_vector(self) -> Floats:
        """Unit vector of `travel`, (3,)."""
        return _unit(self.travel)


def _unit(direction: str) -> Floats:
    vector = np.zeros(3)
    vector["xyz".index(direction[1])] = 1.0 if direction[0] == "+" else -1.0
    return vector


def found_axes(normal_forces: Floats) -> Axes:
    """Return the axes of a run from the road's normal forces on the body, (n, 3).

    The normal is the global axis nearest to their sum (+y where nothing touches); travel is +x, or +y on a road that
    faces x.
    """
    total = normal_forces.sum(axis=0)
    if not np.abs(total).max(initial=0.0) > 0.0:
        return Axes("+y", "+x")
    axis = int(np.argmax(np.abs(total)))
    normal = ("+" if total[axis] > 0.0 else "-") + "xyz"[axis]
    return Axes(normal, "+x" if axis else "+y")
