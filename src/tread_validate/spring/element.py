"""One element's pass through the contact: impact, stick, slip, stick again, release (section 4 of the paper).

Forces are per unit of face area: pressure p = F_r n/A_s and shear q = F_l n/A_s, so that one history serves elements
of any width.

The springs' forces are Eq. (10) of the paper with the stiffnesses of Eq. (8) over the area, E/h_t and G/h_t; the switch
between stick and slip is Eq. (12).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..kernels import kernel
from .element_record import DELTA, GONE, PRESSURE, STICK, TOUCHING, ElementState, rest
from .element_step import advance
from .inputs import KernelLaw, Memory, Motion, Rubber
from .kinematics import mount_point, sliding, sticking
from .memory import TICKS

Array = NDArray[np.float64]


@kernel()
def run_element(
    motion: Motion,
    rubber: Rubber,
    law: KernelLaw,
    memory: Memory,
    height: float,
    arc_at_zero: float,
    first_tick: int,
    corners: NDArray[np.int64],
    tolerance: float,
    record: Array,
) -> int:
    """Follow one element and write its record.

    Parameters
    ----------
    height : float, m
        Stress-free height of the element.
    arc_at_zero : float, m
        Arc of the element's mount point at t = 0.
    first_tick : int
        First contact, in node steps / 4096 from t = 0.
    corners : (n,) array
        Ticks, in order, that no sub-step may straddle (the path's curvature jumps there).
    tolerance : float, m
        Error of lambda allowed in a slip sub-step.
    record : (nodes, 16) array
        Row k is for t = k dt; zero on entry. See the column names above.

    Returns
    -------
    int
        Tick of the release; -1 if the element still touches at the last node.
    """
    state = ElementState(
        np.zeros(rubber.moduli.size),
        np.zeros(rubber.moduli.size),
        np.zeros(10),
        np.zeros(3, dtype=np.int64),
        np.zeros(8),
    )
    touch(motion, rubber, height, arc_at_zero + motion.speed * first_tick * (memory.step / TICKS), state)
    if first_tick % TICKS == 0:
        k = first_tick // TICKS
        record[k, PRESSURE], record[k, TOUCHING], record[k, DELTA] = state.numbers[6], 1.0, state.numbers[4]
    tick = advance(motion, rubber, law, memory, height, arc_at_zero, first_tick, corners, tolerance, state, record)
    if state.codes[0] != GONE:
        return -1
    rest(state.integrals, tick, memory.step, record)
    return tick


@kernel()
def touch(motion: Motion, rubber: Rubber, height: float, arc: float, state: ElementState) -> None:
    """Start an element that touches, unloaded, at an arc (m)."""
    at = mount_point(motion, arc)
    delta, c, _rate, _slope, _drift = sliding(motion, at, 0.0)
    _d, deflection, delta_rate, deflection_rate = sticking(motion, at, c)
    u, total = height - delta, 0.0
    for i in range(rubber.moduli.size):  # what the rounding of the first tick leaves
        state.radial[i], state.longitudinal[i] = rubber.moduli[i] * u, 0.0
        total += state.radial[i]
    p = (rubber.long_term_modulus * u + total) / height
    numbers = state.numbers
    numbers[0], numbers[1], numbers[2], numbers[3] = u, -delta_rate, deflection, deflection_rate
    numbers[4], numbers[5], numbers[6], numbers[7:] = delta, c, p, 0.0
    state.codes[:], state.integrals[:] = 0, 0.0
    state.codes[0] = STICK
