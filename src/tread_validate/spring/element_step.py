"""One element from sub-step to sub-step: stick, slip, stick again, release.

Between two nodes of the record the solver takes sub-steps of the node step over a power of two; an event (slip begins,
slip ends, release) is narrowed down to the node step over 4096.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..kernels import kernel
from .element_record import (
    DEFLECTION,
    DELTA,
    FRICTION,
    GONE,
    INTEGRALS,
    PRESSURE,
    SHEAR,
    SLIP,
    SLIP_SPEED,
    SLIPPING,
    STICK,
    TOUCHING,
    ElementState,
    accumulate,
)  # fmt: skip
from .inputs import KernelLaw, Memory, Motion, Rubber
from .kinematics import mount_point, sliding, sticking
from .memory import LEVELS, STAGE, TICKS
from .slip import kinetic, slip_stage

Array = NDArray[np.float64]

MOST_EVENTS = 12
"""Changes between stick and slip in one node step; after that many an element sticks until the next node."""
JUMP = 1e-6
"""Slip speed (m/s) left by a jump of the path's curvature that is no zero crossing."""


@kernel(reorder=True)
def _remember(weights: Array, memory: Array, rate0: float, rate1: float, increment: float, fresh: Array) -> float:
    """Write the memory after a step to `fresh` and return its sum."""
    total = 0.0
    for i in range(memory.size):
        value = weights[0, i] * memory[i] + weights[1, i] * rate0 + weights[2, i] * rate1 + weights[3, i] * increment
        fresh[i] = value
        total += value
    return total


@kernel(reorder=True)
def _fading(weights: Array, memory: Array) -> float:
    """Return what is left of the memory after a step without input."""
    total = 0.0
    for i in range(memory.size):
        total += weights[0, i] * memory[i]
    return total


@kernel()
def _stick_acceleration(motion: Motion, arc: float, c: float, dt: float) -> float:
    """Return the acceleration of lambda while C sticks at `c` (m/s2), from the next `dt` seconds."""
    along = motion.road_speed * (motion.road_curvature if motion.road_curvature > 0.0 else 1.0)
    now = sticking(motion, mount_point(motion, arc), c)[3]
    return (sticking(motion, mount_point(motion, arc + motion.speed * dt), c + along * dt)[3] - now) / dt


@kernel()
def advance(
    motion: Motion,
    rubber: Rubber,
    law: KernelLaw,
    memory: Memory,
    height: float,
    arc_at_zero: float,
    first_tick: int,
    corners: NDArray[np.int64],
    tolerance: float,
    state: ElementState,
    record: Array,
) -> int:
    """Follow an element that touches from `first_tick` to its release or the record's last node; see `run_element`.

    Returns the tick reached. Loads and stores its state once: sub-steps work on scalars.
    """
    n = rubber.moduli.size
    nodes = record.shape[0]
    dt_node = memory.step
    dt_tick = dt_node / TICKS
    modulus, shear_ratio, mass = rubber.long_term_modulus, rubber.shear_ratio, rubber.mass
    radial, longitudinal, integrals = state.radial, state.longitudinal, state.integrals
    fresh_radial, fresh_longitudinal = np.empty(n), np.empty(n)
    form_r, form_l = np.empty(4), np.empty(4)
    u, u_rate, deflection, deflection_rate, delta = (
        state.numbers[0],
        state.numbers[1],
        state.numbers[2],
        state.numbers[3],
        state.numbers[4],
    )
    c, p, q, slip_speed, direction = (
        state.numbers[5],
        state.numbers[6],
        state.numbers[7],
        state.numbers[8],
        state.numbers[9],
    )
    mode, level, events = state.codes[0], state.codes[1], state.codes[2]
    tick, corner = first_tick, 0
    while corner < corners.size and corners[corner] <= tick:
        corner += 1
    while mode != GONE:
        node_end = (tick // TICKS + 1) * TICKS
        if node_end >= nodes * TICKS:
            break
        stop = node_end
        if corner < corners.size and corners[corner] < stop:
            stop = corners[corner]
        while (TICKS >> level) > stop - tick:
            level += 1
        ticks = TICKS >> level
        dt = ticks * dt_tick
        arc = arc_at_zero + motion.speed * (tick + ticks) * dt_tick
        at = mount_point(motion, arc)
        weights = memory.weights[level]
        last_chance = level == LEVELS - 1
        was_slipping = 1.0 if mode == SLIP else 0.0
        if mode == STICK:
            c_new = c + motion.road_speed * (motion.road_curvature if motion.road_curvature > 0.0 else 1.0) * dt
            delta_new, deflection_new, delta_rate, deflection_rate_new = sticking(motion, at, c_new)
            u_new, u_rate_new = height - delta_new, -delta_rate
            p_new = modulus * u_new + _remember(weights[0], radial, u_rate, u_rate_new, u_new - u, fresh_radial)
            q_new = modulus * deflection_new + _remember(
                weights[0],
                longitudinal,
                deflection_rate,
                deflection_rate_new,
                deflection_new - deflection,
                fresh_longitudinal,
            )
            p_new /= height
            q_new *= shear_ratio / height
            slip_new = 0.0
            released = not p_new > 0.0
            breaks = False
            push = q_new
            if not released and abs(q_new) > law.static_coefficient * p_new:
                # what friction must give for C to stay on the road; no slip starts that the law in slip would stop
                push = q_new + mass * _stick_acceleration(motion, arc, c_new, dt_tick)
                breaks = abs(push) > kinetic(law, p_new, 0.0) * p_new
            if (released or breaks) and not last_chance and events < MOST_EVENTS:
                level += 1
                continue
            if released:
                mode = GONE
            elif breaks and events < MOST_EVENTS:
                mode, direction = SLIP, 1.0 if push > 0.0 else -1.0
                events += 1
            grows = True
        else:
            half = STAGE * dt
            at_stage = mount_point(motion, arc - motion.speed * (1.0 - STAGE) * dt)
            form_r[0], form_l[0] = _fading(weights[1], radial), _fading(weights[1], longitudinal)
            sums = memory.sums[level, 1]
            form_r[0] += sums[0] * u_rate
            form_l[0] += sums[0] * deflection_rate
            form_r[1], form_r[2], form_r[3] = sums[1], sums[2], u
            form_l[1], form_l[2], form_l[3] = sums[1], sums[2], deflection
            first = slip_stage(
                motion,
                rubber,
                law,
                at_stage,
                height,
                direction,
                half,
                deflection,
                mass * deflection_rate,
                deflection_rate,
                form_r,
                form_l,
            )
            form_r[0], form_l[0] = _fading(weights[0], radial), _fading(weights[0], longitudinal)
            sums = memory.sums[level, 0]
            form_r[0] += sums[0] * u_rate
            form_l[0] += sums[0] * deflection_rate
            form_r[1], form_r[2] = sums[1], sums[2]
            form_l[1], form_l[2] = sums[1], sums[2]
            explicit = (1.0 - STAGE) * dt
            second = slip_stage(
                motion,
                rubber,
                law,
                at,
                height,
                direction,
                half,
                deflection + explicit * first[1],
                mass * deflection_rate + explicit * (mass * (first[1] - deflection_rate) / half),
                first[1],
                form_r,
                form_l,
            )
            _ok, deflection_rate_new, deflection_new, p_new, q_new, slip_new, u_rate_new, delta_new, _push = second
            u_new = height - delta_new
            error = half * abs(second[1] - first[1])
            released = not p_new > 0.0
            ends = slip_new < 0.0
            unsound = not (first[0] and second[0]) or error > tolerance
            if (unsound or released or ends) and not last_chance:
                level += 1
                continue
            _remember(weights[0], radial, u_rate, u_rate_new, u_new - u, fresh_radial)
            _remember(
                weights[0],
                longitudinal,
                deflection_rate,
                deflection_rate_new,
                deflection_new - deflection,
                fresh_longitudinal,
            )
            c_new = sliding(motion, at, deflection_new)[1]
            if released:
                mode = GONE
            elif ends:
                events += 1
                past_corner = corner < corners.size and tick + ticks >= corners[corner]
                push = q_new + mass * _stick_acceleration(motion, arc, c_new, dt_tick)
                held = abs(q_new) <= law.static_coefficient * p_new or abs(push) <= kinetic(law, p_new, 0.0) * p_new
                if past_corner and abs(slip_new) > JUMP:
                    # the sticking rate has jumped past lambda': the element slips the other way, it does not stop
                    direction, slip_new = -direction, -slip_new
                elif held or events >= MOST_EVENTS:
                    mode = STICK
                    _d, _l, delta_rate, deflection_rate_new = sticking(motion, at, c_new)
                    u_rate_new, slip_new = -delta_rate, 0.0
                else:
                    direction, slip_new = 1.0 if push > 0.0 else -1.0, 0.0
            grows = error < 0.25 * tolerance
        if mode == GONE:
            # the force reaches zero within this last sub-step
            accumulate(integrals, dt, p, q, 0.0, q, was_slipping)
            p, q, slip_speed = 0.0, 0.0, 0.0
        else:
            accumulate(integrals, dt, p, q, p_new, q_new, was_slipping)
            p, q, slip_speed = p_new, q_new, slip_new
            u, u_rate, deflection, deflection_rate, delta, c = (
                u_new,
                u_rate_new,
                deflection_new,
                deflection_rate_new,
                delta_new,
                c_new,
            )
            for i in range(n):
                radial[i], longitudinal[i] = fresh_radial[i], fresh_longitudinal[i]
        tick += ticks
        if corner < corners.size and tick >= corners[corner]:
            corner += 1
        if grows and level > 0:
            level -= 1
        if tick % TICKS == 0:
            k = tick // TICKS
            events = 0
            record[k, PRESSURE], record[k, SHEAR] = p, q
            for j in range(8):
                record[k, INTEGRALS + j] = integrals[j]
            if mode != GONE:
                record[k, TOUCHING], record[k, SLIPPING] = 1.0, 1.0 if mode == SLIP else 0.0
                record[k, DELTA], record[k, DEFLECTION], record[k, SLIP_SPEED] = delta, deflection, slip_speed
                record[k, FRICTION] = q
                if mode == SLIP:
                    record[k, FRICTION] = direction * kinetic(law, p, slip_speed) * p
    numbers = state.numbers
    numbers[0], numbers[1], numbers[2], numbers[3], numbers[4] = u, u_rate, deflection, deflection_rate, delta
    numbers[5], numbers[6], numbers[7], numbers[8], numbers[9] = c, p, q, slip_speed, direction
    state.codes[0], state.codes[1], state.codes[2] = mode, level, events
    return tick
