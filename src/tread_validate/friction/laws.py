"""Friction laws: a constant, the form of Huemer et al., and a measured table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError
from ..study import Coulomb, Friction, Huemer, HuemerFile
from ..units import KPA, MM
from .kernel import COULOMB, HUEMER, TABLE, kinetic_array

Array = NDArray[np.float64]
Kind = Literal["coulomb", "huemer", "table"]
KernelArguments = tuple[int, Array, Array, Array, Array]

CODES: Mapping[str, int] = MappingProxyType({"coulomb": COULOMB, "huemer": HUEMER, "table": TABLE})
HUEMER_CONSTANTS = ("alpha", "beta", "n", "m", "a", "b", "c", "least_pressure", "least_slip_speed")


def _none() -> Array:
    return np.zeros(0)


@dataclass(frozen=True)
class FrictionLaw:
    """Kinetic friction coefficient as a function of contact pressure and slip speed, and the static coefficient.

    Attributes
    ----------
    kind : str
        ``coulomb``, ``huemer`` or ``table``.
    static_coefficient : float, > 0
        Limit of the tangential over the normal force while sticking.
    constants : mapping of str to float
        By name, in the kernel's order. Huemer: p in MPa, v in m/s, the two floors in Pa and m/s.
    pressures, slip_speeds, table : (i,), (j,), (i, j) arrays
        Grid in Pa and m/s and coefficient at its nodes; empty unless `kind` is ``table``.
    """

    kind: Kind
    static_coefficient: float
    constants: Mapping[str, float]
    pressures: Array = field(default_factory=_none)
    slip_speeds: Array = field(default_factory=_none)
    table: Array = field(default_factory=lambda: np.zeros((0, 0)))

    @property
    def code(self) -> int:
        """The kernel's number for the kind of law."""
        return CODES[self.kind]

    @property
    def parameters(self) -> Array:
        """The constants as an array, for the kernel."""
        return np.array(list(self.constants.values()), dtype=np.float64)

    @property
    def kernel_arguments(self) -> KernelArguments:
        """The leading arguments of `kinetic_kernel`; pressure in Pa and slip speed in m/s follow."""
        return self.code, self.parameters, self.pressures, self.slip_speeds, self.table

    def kinetic(self, pressure: ArrayLike, slip_speed: ArrayLike) -> Array:
        """Return the kinetic coefficient at `pressure` in Pa and `slip_speed` in m/s (shapes that broadcast).

        The Huemer form is evaluated at no less than its least pressure and slip speed, where it would diverge or
        vanish; a table holds its end values outside its range.
        """
        p, v = np.broadcast_arrays(np.asarray(pressure, dtype=np.float64), np.asarray(slip_speed, dtype=np.float64))
        flat = kinetic_array(*self.kernel_arguments, np.ascontiguousarray(p).ravel(), np.ascontiguousarray(v).ravel())
        return np.asarray(flat.reshape(p.shape), dtype=np.float64)


def coulomb_law(kinetic_coefficient: float, static_coefficient: float) -> FrictionLaw:
    """Return the law of a constant kinetic coefficient."""
    return FrictionLaw("coulomb", static_coefficient, {"kinetic_coefficient": float(kinetic_coefficient)})


def huemer_law(
    alpha: float,
    beta: float,
    n: float,
    m: float,
    a: float,
    b: float,
    c: float,
    least_pressure: float = 10e3,
    least_slip_speed: float = 1e-3,
    static_coefficient: float = 0.9,
    where: str = "friction law",
) -> FrictionLaw:
    """Return mu = (alpha |p|^(n-1) + beta) / (a + b |v|^(-1/m) + c |v|^(-2/m)), p in MPa and v in m/s.

    Huemer et al., Eng. Comput. 18 (2001) 417-436. The floors are in Pa and m/s. Raises `InputError` for constants
    whose denominator is not positive at every slip speed, or whose numerator is negative somewhere up to 100 MPa.
    """
    u = np.geomspace(1e3, max(least_slip_speed, 1e-9), 2001) ** (-1.0 / m)
    below = a + b * u + c * u * u
    if not np.all(below > 0):
        slow = float(u[np.argmin(below)] ** -m)
        raise InputError(where, f"a denominator of {np.min(below):.3g} at {slow:.3g} m/s", "a, b, c that keep it > 0")
    p = np.geomspace(least_pressure, max(100e6, 10 * least_pressure), 201) * 1e-6
    above = alpha * p ** (n - 1.0) + beta
    if not np.all(above >= 0):
        raise InputError(
            where, f"a negative coefficient at {p[np.argmin(above)]:.3g} MPa", "alpha, beta, n that keep it >= 0"
        )
    values = (alpha, beta, n, m, a, b, c, least_pressure, least_slip_speed)
    return FrictionLaw(
        "huemer", static_coefficient, {k: float(v) for k, v in zip(HUEMER_CONSTANTS, values, strict=True)}
    )


def table_law(pressures: Array, slip_speeds: Array, table: Array, static_coefficient: float) -> FrictionLaw:
    """Return the law that interpolates a full grid: linear in log p and log v, end values held outside.

    Linear interpolation in each direction keeps the table's monotony and never overshoots it. One row or one column
    stands for all pressures or speeds. Raises `InputError` for a grid that is not positive and increasing.
    """
    p, v, mu = (np.array(values, dtype=np.float64) for values in (pressures, slip_speeds, table))
    for name, grid in (("pressure", p), ("slip speed", v)):
        if grid.size < 1 or not np.all(np.isfinite(grid) & (grid > 0)) or not np.all(np.diff(grid) > 0):
            raise InputError(f"friction table: {name}", grid, "positive values in increasing order")
    if mu.shape != (p.size, v.size) or not np.all(np.isfinite(mu) & (mu >= 0)):
        raise InputError("friction table", f"coefficients of shape {mu.shape}", f"{p.size} x {v.size} numbers >= 0")
    # the kernel works on cells: a lone level is doubled
    if p.size == 1:
        p, mu = np.array([p[0], 2.0 * p[0]]), np.vstack([mu, mu])
    if v.size == 1:
        v, mu = np.array([v[0], 2.0 * v[0]]), np.hstack([mu, mu])
    return FrictionLaw("table", static_coefficient, {}, p, v, np.ascontiguousarray(mu))


def law(friction: Friction, root: Path | str | None = None) -> FrictionLaw:
    """Return the law of a study's friction entry.

    A file name in it is relative to `root` (the study's root; the working directory where it is None). Raises
    `InputError` for a file that is missing or wrong and for constants that make no law.
    """
    if isinstance(friction, Coulomb):
        return coulomb_law(friction.kinetic_coefficient, friction.static_coefficient)
    if isinstance(friction, Huemer):
        return huemer_law(
            friction.alpha,
            friction.beta,
            friction.n,
            friction.m,
            friction.a,
            friction.b,
            friction.c,
            friction.least_pressure_kPa * KPA,
            friction.least_slip_speed_mm_s * MM,
            friction.static_coefficient,
        )
    from .law_file import read_huemer
    from .table_file import read_table_law

    path = (Path(root) if root is not None else Path()) / friction.file
    if isinstance(friction, HuemerFile):
        return read_huemer(path, friction.static_coefficient)
    return read_table_law(path, friction.static_coefficient)
