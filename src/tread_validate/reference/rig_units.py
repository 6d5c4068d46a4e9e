"""Units of a rig record's channels, from a heading, a unit row or a channel's property."""

from __future__ import annotations

import math

from ..errors import InputError
from ..instrument.quantities import Unit
from ..instrument.recognise import split_heading
from ..units import KILO, MEGA, MILLI, MS, US

FORCE = {"n": Unit(1.0), "kn": Unit(KILO), "mn": Unit(MILLI), "dan": Unit(10.0), "lbf": Unit(4.4482216152605),
         "kgf": Unit(9.80665), "newton": Unit(1.0), "newtons": Unit(1.0)}  # fmt: skip
TIME_UNITS = {"s": Unit(1.0), "ms": Unit(MS), "us": Unit(US), "µs": Unit(US), "sec": Unit(1.0), "min": Unit(60.0)}
VOLT = {"v": Unit(1.0), "mv": Unit(MILLI), "volt": Unit(1.0), "volts": Unit(1.0), "-": Unit(1.0), "ttl": Unit(1.0)}
ANGLES = {"rad": Unit(1.0), "deg": Unit(math.pi / 180), "°": Unit(math.pi / 180), "degree": Unit(math.pi / 180),
          "degrees": Unit(math.pi / 180), "rev": Unit(2 * math.pi)}  # fmt: skip
OF = {"time_s": TIME_UNITS, "normal_force_N": FORCE, "tangential_force_N": FORCE, "trigger_V": VOLT,
      "wheel_angle_rad": ANGLES, "wheel_angle_deg": ANGLES}  # fmt: skip
DEFAULT = {"time_s": "s", "normal_force_N": "N", "tangential_force_N": "N", "trigger_V": "V", "wheel_angle_rad": "rad",
           "wheel_angle_deg": "deg"}  # fmt: skip


def channel_factor(name: str, unit: str, where: str) -> float:
    """Return what turns a channel's numbers into the unit of its `name`'s quantity in SI; "" is the name's own unit.

    Raises `InputError` for a unit that is no unit of the quantity.
    """
    said = unit.strip() or DEFAULT[name]
    known = OF[name]
    if name in ("normal_force_N", "tangential_force_N") and said in ("MN", "meganewton"):
        return MEGA
    if said.lower() not in known:
        raise InputError(where, f"the unit '{unit}'", f"a unit of {name} ({', '.join(list(known)[:4])}, ...)")
    return known[said.lower()].factor


def stem(heading: str, name: str) -> tuple[str, str]:
    """Return a heading without its unit, and the unit: ``Fz [kN]``, ``normal_force_kN``."""
    bare, unit = split_heading(heading, OF[name])
    return bare.strip().removesuffix("_"), unit


def is_channel(heading: str, name: str, wanted: str) -> bool:
    """Whether a heading is the channel `wanted`: as it stands, or without its unit."""
    bare, _ = stem(heading, name)
    if heading.strip() == wanted or bare == wanted:
        return True
    return wanted == name and bare == stem(name, name)[0]
