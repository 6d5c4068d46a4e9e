"""What an element remembers, and its record, node by node: columns, and the integrals that it keeps."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..kernels import kernel
from .memory import TICKS

Array = NDArray[np.float64]

# columns of the record
PRESSURE, SHEAR, TOUCHING, SLIPPING = 0, 1, 2, 3
"""Pa, Pa (positive like lambda), 0 or 1, 0 or 1."""
INTEGRALS = 4
"""Columns 4..7: time integrals of columns 0..3; 8..11: integrals of those."""
DELTA, DEFLECTION, SLIP_SPEED, FRICTION = 12, 13, 14, 15
"""Radial and longitudinal length (m), slip speed (m/s, >= 0), traction of the road on the
rubber (Pa, positive like lambda; with slip it differs from the spring's by the lumped mass's inertia)."""
COLUMNS = 16

STICK, SLIP, GONE = 0, 1, 2


class ElementState(NamedTuple):
    """What an element remembers; every array is changed in place.

    Attributes
    ----------
    radial, longitudinal : (n,) arrays, Pa m
        Fading memory of each Prony term.
    numbers : (10,) array
        u (m) and its rate, longitudinal length (m) and its rate, radial length (m), place on the road, p, q (Pa), slip
        speed (m/s), direction of slip.
    codes : (3,) array of int
        Mode, level of the sub-step, changes between stick and slip since the last node.
    integrals : (8,) array
        As in the record.
    """

    radial: Array
    longitudinal: Array
    numbers: Array
    codes: NDArray[np.int64]
    integrals: Array


@kernel()
def accumulate(integrals: Array, dt: float, p0: float, q0: float, p1: float, q1: float, slips: float) -> None:
    """Add one sub-step with linear p and q to the integrals and their integrals."""
    half, third, sixth = 0.5 * dt, dt * dt / 3.0, dt * dt / 6.0
    integrals[4] += dt * integrals[0] + third * p0 + sixth * p1
    integrals[5] += dt * integrals[1] + third * q0 + sixth * q1
    integrals[6] += dt * integrals[2] + half * dt
    integrals[7] += dt * integrals[3] + half * dt * slips
    integrals[0] += half * (p0 + p1)
    integrals[1] += half * (q0 + q1)
    integrals[2] += dt
    integrals[3] += dt * slips


@kernel()
def rest(integrals: Array, tick: int, dt: float, record: Array) -> None:
    """Fill the integrals of the nodes after the release."""
    first = tick // TICKS if tick % TICKS == 0 else tick // TICKS + 1
    for k in range(first, record.shape[0]):
        waited = k * dt - tick * (dt / TICKS)
        for j in range(4):
            record[k, INTEGRALS + j] = integrals[j]
            record[k, INTEGRALS + 4 + j] = integrals[4 + j] + waited * integrals[j]
