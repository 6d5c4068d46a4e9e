"""What every friction law has: its entry in a study, its form, and the law with its constants in SI.

A law is one module of `laws`: a `FrictionEntry` with the keys of the study, a `LawForm` with the constants' units, the
compiled kernel and the Fortran of VFRIC. `kernel` chooses among the kernels by the form's code.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Field, FiniteFloat

from ..fields import Sourced
from ..units import DECK_LENGTH, DECK_STRESS

if TYPE_CHECKING:
    from .table_file import FrictionData

Array = NDArray[np.float64]
KernelArguments = tuple[int, Array, Array, Array, Array]
Kernel = Callable[[Array, Array, Array, Array, float, float], float]
Coefficient = Annotated[FiniteFloat, Field(ge=0, le=5)]

PRESSURE, SLIP_SPEED = "Pa", "m/s"
DECK_FACTORS = {PRESSURE: DECK_STRESS, SLIP_SPEED: DECK_LENGTH}
"""SI to the deck's units; a constant in any other unit goes into the deck as it is."""


@dataclass(frozen=True)
class LawForm:
    """The form of a law, without its numbers.

    Attributes
    ----------
    name : str
        ``coulomb``, ``huemer``, ...
    code : int
        By which the compiled dispatch and its callers know the form; never used twice.
    units : mapping of str to str
        Unit of each constant, in the order of the kernel's parameters and of VFRIC's properties.
    kernel : compiled function
        (parameters, pressures, slip speeds, table, pressure, slip speed) -> kinetic coefficient, SI.
    fortran : str
        The function ``fricmu(nProps, props, press, speed)`` in fixed form, with its comments: the kernel's arithmetic,
        written a second time and tested against it.
    proportional : int
        How many of the leading constants the coefficient is proportional to, all together; a table is so whole.
    limit : str
        ``static`` or ``kinetic``: the coefficient that stands for the law where only one can be given.
    """

    name: str
    code: int
    units: Mapping[str, str]
    kernel: Kernel
    fortran: str
    proportional: int
    limit: Literal["static", "kinetic"] = "static"


def _none() -> Array:
    return np.zeros(0)


@dataclass(frozen=True)
class FrictionLaw:
    """Kinetic friction coefficient as a function of contact pressure and slip speed, and the static coefficient.

    Attributes
    ----------
    form : LawForm
    static_coefficient : float, >= 0
        Limit of the tangential over the normal force while sticking.
    constants : mapping of str to float
        By name, in the order and the units of the form.
    pressures, slip_speeds, table : (i,), (j,), (i, j) arrays
        Grid in Pa and m/s and coefficient at its nodes; empty for a law that is a formula.
    """

    form: LawForm
    static_coefficient: float
    constants: Mapping[str, float]
    pressures: Array = field(default_factory=_none)
    slip_speeds: Array = field(default_factory=_none)
    table: Array = field(default_factory=lambda: np.zeros((0, 0)))

    @property
    def kind(self) -> str:
        """Name of the form."""
        return self.form.name

    @cached_property
    def parameters(self) -> Array:
        """The constants as an array, for the kernel."""
        return np.array(list(self.constants.values()), dtype=np.float64)

    @property
    def kernel_arguments(self) -> KernelArguments:
        """The leading arguments of `kinetic_kernel`; pressure in Pa and slip speed in m/s follow."""
        return self.form.code, self.parameters, self.pressures, self.slip_speeds, self.table

    @property
    def constant_coefficient(self) -> float:
        """The coefficient that stands for the law where only one can be given, as in built-in friction."""
        return self.constants["kinetic_coefficient"] if self.form.limit == "kinetic" else self.static_coefficient

    @property
    def deck_properties(self) -> tuple[float, ...]:
        """The properties of VFRIC in the deck's units: the static coefficient, the constants, the table if any."""
        own = [value * DECK_FACTORS.get(self.form.units[name], 1.0) for name, value in self.constants.items()]
        if self.table.size:
            own += [float(self.pressures.size), float(self.slip_speeds.size)]
            own += [float(value) * DECK_STRESS for value in self.pressures]
            own += [float(value) * DECK_LENGTH for value in self.slip_speeds]
            own += [float(value) for value in self.table.ravel()]
        return (self.static_coefficient, *own)

    def kinetic(self, pressure: ArrayLike, slip_speed: ArrayLike) -> Array:
        """Return the kinetic coefficient at `pressure` in Pa and `slip_speed` in m/s (shapes that broadcast).

        A form is evaluated at no less than its least pressure and slip speed, where it would diverge or vanish; a table
        holds its end values outside its range.
        """
        p, v = np.broadcast_arrays(np.asarray(pressure, dtype=np.float64), np.asarray(slip_speed, dtype=np.float64))
        own = (self.parameters, self.pressures, self.slip_speeds, self.table)
        flat = [self.form.kernel(*own, a, b) for a, b in zip(p.ravel().tolist(), v.ravel().tolist(), strict=True)]
        return np.array(flat, dtype=np.float64).reshape(p.shape)


class FrictionEntry(Sourced, ABC):
    """A friction law as a study gives it.

    `example` holds the keys, beside kind, origin and source, of one such law; tests of all laws take it.
    """

    example: ClassVar[Mapping[str, Any]]

    kind: str
    static_coefficient: Coefficient = Field(0.9, description="limit of tangential over normal force while sticking")

    @abstractmethod
    def law(self, root: Path) -> FrictionLaw:
        """Return the law; a file name is relative to `root`.

        Raises `InputError` for a file that is missing or wrong and for constants that make no law.
        """

    @classmethod
    def fit(cls, data: FrictionData, static_coefficient: float = 0.9) -> FrictionLaw | None:
        """Return the law of this kind that is nearest to measurements; None for a kind that is not fitted.

        Raises `InputError` for measurements that cannot determine it.
        """
        return None

    def measurements(self, root: Path) -> FrictionData | None:
        """Return the measurements behind the law, None where it has none."""
        return None
