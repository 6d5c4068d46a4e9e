"""The numbers of a deck that have a name: what a user changes by hand, and what follows from it.

A change of speed runs the same motion faster or slower: every time is divided and every velocity multiplied by it. A
change of interference raises the road; the first contact then comes sooner by the time in which the gap under the
leading corner closes by as much, taken to second order in time, and the steps move with it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..friction import FrictionLaw
from ..geometry import Path
from ..study import Case
from ..units import DECK_LENGTH
from .form import Value, exact
from .keywords import number
from .placement import LEAD_IN, Placement

STEP = 1e-5  # s, of the differences that give the closing speed of the gap


@dataclass(frozen=True)
class Inputs:
    """Named numbers of a deck, in its units.

    Attributes
    ----------
    by_hand : tuple of Value
        Speed, interference, creep ratio, temperature, friction.
    derived : tuple of Value
        What follows, in an order in which each formula knows its names.
    friction : tuple of Value
        The constants of the law that VFRIC takes as its first properties, static coefficient first.
    """

    by_hand: tuple[Value, ...]
    derived: tuple[Value, ...]
    friction: tuple[Value, ...]

    def __getitem__(self, name: str) -> Value:
        return next(value for value in (*self.by_hand, *self.derived) if value.name == name)


def inputs_of(case: Case, path: Path, law: FrictionLaw, placement: Placement, pass_time: float) -> Inputs:
    """Return the named numbers of a case's deck."""
    friction = friction_values(law)
    what = "road, the press in proportion" if path.columns.together else "tread surface"
    speed = Value("speed", exact(path.speed * DECK_LENGTH), f"speed of the {what}, mm/s")
    interference = Value("interference", exact(case.interference * DECK_LENGTH), "largest compression of the block, mm")
    creep = Value("creep_ratio", exact(case.creep_ratio or 0.0), "road faster than the tread surface, share of speed")
    by_hand = (
        speed,
        interference,
        creep,
        Value("temperature", exact(case.temperature), "of the rubber, uniform, degC"),
        *friction,
    )
    return Inputs(by_hand, _derived(path, placement, pass_time, speed, interference, creep), friction)


def friction_values(law: FrictionLaw) -> tuple[Value, ...]:
    """Return the static coefficient and the law's constants in deck units, each with its meaning."""
    units = {"Pa": "MPa", "m/s": "mm/s", "1": "-"}
    names = list(law.form.units)[: len(law.constants)]
    values = [Value("friction_static", float(number(law.static_coefficient, 13)), "property 1: static coefficient, -")]
    for position, (name, number_) in enumerate(zip(names, law.deck_properties[1:], strict=False), start=2):
        unit = law.form.units[name]
        legend = f"property {position}: {name.replace('_', ' ')} of the {law.kind} law, {units.get(unit, unit)}"
        values.append(Value(f"friction_{name}", float(number(number_, 13)), legend))
    return tuple(values)


def _derived(
    path: Path, placement: Placement, pass_time: float, speed: Value, interference: Value, creep: Value
) -> tuple[Value, ...]:
    # few digits: second differences of coordinates have no more that every machine agrees on
    first, second = (number(value, digits) for value, digits in zip(closing_of_gap(path), (6, 4), strict=True))
    rate = speed.number * (1.0 + creep.number)
    radius = number(path.road.radius * DECK_LENGTH, 10)
    depth, duration = number(interference.number, 10), number(pass_time, 10)
    values = [
        Value("pace", 1.0, "speed over the one this deck was written for", f"speed/{number(speed.number, 10)}"),
        Value("stretch", 1.0, "factor on all times", "1./pace"),
        Value("lift", 0.0, "rise of the road over the one written for, mm", f"interference - {depth}"),
        Value(
            "sooner", 0.0, "first contact before the one written for, s, at its speed",
            f"(sqrt({first}*{first} + 2.*{second}*lift) - {first})/{second}",
        ),
        Value("approach_time", LEAD_IN, "lead-in without contact, s", f"({number(LEAD_IN)} - sooner)*stretch"),
        Value("pass_time", exact(pass_time), "first contact until clear, s", f"({duration} + 2.*sooner)*stretch"),
    ]  # fmt: skip
    if path.road.is_plane:
        values += [
            Value("road_rate", rate, "velocity of the road along x, mm/s", "speed*(1. + creep_ratio)"),
            Value("road_y", 0.0, "height of the road, mm", "lift"),
        ]
    else:
        below = path.road.radius * DECK_LENGTH
        values += [
            Value("road_rate", -rate / below, "big wheel about z, rad/s", f"-speed*(1. + creep_ratio)/{radius}"),
            Value("road_y", -below, "height of the big wheel's axle, mm", f"lift - {radius}"),
        ]  # fmt: skip
    if path.line.ring_radius is None:
        vx, vy = placement.velocity.tolist()
        values += [
            Value("start_x", float(number(vx)), "x velocity of the leading row at first, mm/s", f"{number(vx)}*pace"),
            Value("start_y", float(number(vy)), "y velocity of the leading row at first, mm/s", f"{number(vy)}*pace"),
        ]  # fmt: skip
    spin = number(placement.spin, 10)
    values.append(Value("block_rate", float(spin), "turn of the block about z at the start, rad/s", f"{spin}*pace"))
    return tuple(values)


def closing_of_gap(path: Path) -> tuple[float, float]:
    """Return how fast the gap under the leading corner closes at the first contact (mm/s), and how that slows (mm/s2).

    Around the first contact the gap is ``-closing t + bend t^2/2``.
    """
    t = STEP * np.array([-1.0, 0.0, 1.0])
    before, touch, after = (float(v) for v in -path.indentation(0.0, t) * DECK_LENGTH)
    closing = (before - after) / (2.0 * STEP)
    bend = (before - 2.0 * touch + after) / STEP**2
    if not math.isfinite(bend) or abs(bend) < 1e-3 * closing:
        bend = 1e-3 * closing
    return closing, bend
