"""What the compiled kernels take: plain tuples of numbers and arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Motion(NamedTuple):
    """Path of the mount and motion of the road.

    Attributes
    ----------
    code, parameters, table : int, (k,) array, (n, 4) array
        The mount line, see `tread_validate.geometry.line`.
    speed : float, m/s
        Rate of the arc.
    speed_ratio : float
        Speed of the mount along its line over `speed`.
    road_curvature : float, 1/m
        0 for the plane, else 1/R2.
    road_speed : float, m/s
        Speed of the road's surface: ``speed (1 + creep_ratio)``.
    """

    code: int
    parameters: Array
    table: Array
    speed: float
    speed_ratio: float
    road_curvature: float
    road_speed: float


class Rubber(NamedTuple):
    """The springs of one element per unit of its face's area.

    Attributes
    ----------
    long_term_modulus : float, Pa
    moduli, relaxation_times : (n,) arrays, Pa and s
        At the temperature of the run.
    shear_ratio : float
        G/E = 1/(2 (1 + nu)).
    mass : float, kg/m2
        Lumped mass per area, m n/A_s = M/(2 A_s).
    """

    long_term_modulus: float
    moduli: Array
    relaxation_times: Array
    shear_ratio: float
    mass: float


class KernelLaw(NamedTuple):
    """The friction law, as `tread_validate.friction.kinetic_kernel` takes it, and the static coefficient."""

    static_coefficient: float
    code: int
    parameters: Array
    pressures: Array
    slip_speeds: Array
    table: Array


class Memory(NamedTuple):
    """Weights of the hereditary recursion for steps dt, dt/2, dt/4, ... and for the inner stage of each.

    Attributes
    ----------
    step : float, s
        Step between nodes.
    weights : (levels, 2, 4, n) array
        For each level the whole step (0) and the part `STAGE` of it (1): decay (1), weight of the rate at the step's
        start (Pa s), of the rate at its end (Pa s), of the increment (Pa).
    sums : (levels, 2, 3) array
        Sums of the last three over the terms.
    """

    step: float
    weights: Array
    sums: Array
