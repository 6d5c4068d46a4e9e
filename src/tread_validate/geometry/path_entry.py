"""What every kind of path has: its entry in a study, and what a run must be for it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any, ClassVar, Literal, Protocol, get_args

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..fields import Sourced
from ..units import IN_MM
from .path import Path
from .trace import LevelledTrace
from .tread_block import Block

Array = NDArray[np.float64]
Family = Literal["rig", "belt", "track"]
FAMILIES: tuple[Family, ...] = get_args(Family)


class Conditions(Protocol):
    """What a path needs to know of a run, in SI; a `Case` has it."""

    @property
    def case_id(self) -> str:
        """Names the run in an error."""

    @property
    def block(self) -> Block:
        """The block."""

    @property
    def path(self) -> PathEntry:
        """The path."""

    @property
    def height(self) -> float:
        """Height of the block, m."""

    @property
    def interference(self) -> float:
        """Largest compression, m."""

    @property
    def speed(self) -> float:
        """Rate of the arc, m/s."""

    @property
    def root(self) -> FilePath:
        """Folder that file names are relative to."""


@dataclass(frozen=True)
class Uncertain:
    """A key of a path that is assumed, with the range that it may lie in, for a sensitivity study."""

    key: str
    label: str
    low: float
    high: float
    unit: str = "mm"


@dataclass(frozen=True)
class Sketch:
    """Curves that show a path, for a figure.

    Attributes
    ----------
    x_label, y_label : str
        With units.
    curves : mapping of label to (x, y) arrays
        The first is the mount.
    """

    x_label: str
    y_label: str
    curves: dict[str, tuple[Array, Array]]


@dataclass(frozen=True)
class Ridge:
    """A smoothed ridge of a measured belt: place and height, (n,) arrays in m; whether it is the one that is used."""

    name: str
    x: Array
    height: Array
    used: bool


class PathEntry(Sourced, ABC):
    """A path as a study gives it.

    Attributes
    ----------
    family : str
        ``rig``, ``belt`` or ``track``: what tables and reports group by.
    on_tyre : bool
        Whether the block is one of a tyre's, whose passes add up to the tyre's forces.
    gives_coefficients : bool
        Whether peak forces over speeds and temperatures are regressed on it (a_v and a_theta), and measured on it.
    pulls : bool
        Whether the road pulls on the block by more than the models' own error of the tangential force.
    rolls : bool
        Whether the block moves with the road, so that a creep ratio has a meaning.
    mount_is_rigid : bool
        Whether the mount turns as one rigid ring; else each row of it follows the path.
    is_measured : bool
        Whether the path comes from a measured shape.
    uncertain : tuple of Uncertain
        Keys that the paper does not print, or that were read off a figure.
    example : mapping
        Keys, beside kind, origin and source, of one such path; tests of all paths take it.
    """

    family: ClassVar[Family]
    on_tyre: ClassVar[bool] = False
    gives_coefficients: ClassVar[bool] = False
    pulls: ClassVar[bool] = True
    rolls: ClassVar[bool] = True
    mount_is_rigid: ClassVar[bool] = False
    is_measured: ClassVar[bool] = False
    uncertain: ClassVar[tuple[Uncertain, ...]] = ()
    example: ClassVar[Mapping[str, Any]]

    kind: str

    @abstractmethod
    def build(self, run: Conditions) -> Path:
        """Return the path of a run.

        Raises `InputError` where the block cannot touch the road, is pressed too deep, or a data file will not do.
        """

    def surface_speed(self, rpm: float) -> float | None:
        """Return the surface speed in m/s at a number of revolutions per minute; None where nothing turns."""
        return None

    def revolutions(self, speed: float) -> float | None:
        """Return the number of revolutions per minute at a surface speed in m/s; None where nothing turns."""
        return None

    def tallest_block(self) -> tuple[float, str] | None:
        """Return the height in mm that a block must stay under, and in words what sets it; None without a limit."""
        return None

    def varies(self, *keys: str) -> bool:
        """Whether all these are keys of the path that the paper does not fix."""
        return set(keys) <= {item.key for item in self.uncertain}

    def value(self, key: str) -> float:
        """Return the value of a key of the path, in the key's unit."""
        return float(getattr(self, key))

    def wheel_radii(self) -> tuple[float, float] | None:
        """Return the radii in mm of the wheel with the block and of that which is the road; None without wheels."""
        return None

    def belt_file(self, root: FilePath) -> FilePath | None:
        """Return the belt file that a measured path comes from; None where it comes from raw heights, or none."""
        return None

    def ridges(self, root: FilePath) -> tuple[Ridge, ...]:
        """Return the smoothed ridges that a measured path comes from; none of any other."""
        return ()

    def raw_ridges(self, root: FilePath) -> tuple[LevelledTrace, ...]:
        """Return the levelled heights that a measured path comes from, where its file holds such; none else."""
        return ()

    def sketch(self, path: Path) -> Sketch:
        """Return the mount's line and the road, in mm."""
        half = 0.6 * path.speed * path.contact_duration
        arc = np.linspace(-half, half, 401)
        x, y, _ = path.mount(arc)
        road = np.linspace(float(x.min()), float(x.max()), 401)
        fall = np.zeros(road.size)
        if not path.road.is_plane:
            fall = np.sqrt(np.maximum(path.road.radius**2 - road**2, 0.0)) - path.road.radius
        return Sketch("x, mm", "y, mm", {"mount": (IN_MM * x, IN_MM * y), "road": (IN_MM * road, IN_MM * fall)})


def check_interference(run: Conditions) -> None:
    """Raise `InputError` unless 0 < interference < height."""
    if not run.interference > 0.0:
        raise InputError(
            f"case {run.case_id}: interference", f"{run.interference:g} m", "more than 0, or the block never touches"
        )
    if not run.interference < run.height:
        raise InputError(
            f"case {run.case_id}: interference", f"{run.interference:g} m", f"less than its height {run.height:g} m"
        )


def path_of(run: Conditions) -> Path:
    """Return the path of a case; raises `InputError` where the block cannot touch or is too deep."""
    return run.path.build(run)
