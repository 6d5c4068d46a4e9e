"""What an instrument measures: the names and units under which exports write each quantity."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import NamedTuple

from ..units import GPA, KPA, MM, MPA


class Unit(NamedTuple):
    """value in SI = factor * number + offset."""

    factor: float
    offset: float = 0.0


PRESSURE = {"pa": Unit(1.0), "kpa": Unit(KPA), "mpa": Unit(MPA), "gpa": Unit(GPA), "n/mm2": Unit(MPA),
            "n/mm^2": Unit(MPA), "n/mm²": Unit(MPA), "psi": Unit(6894.757293168), "n/m2": Unit(1.0)}  # fmt: skip
FREQUENCY = {"hz": Unit(2 * math.pi), "rad/s": Unit(1.0), "khz": Unit(2e3 * math.pi), "rads": Unit(1.0),
             "rad/sec": Unit(1.0), "rad_s": Unit(1.0), "rad.s-1": Unit(1.0)}  # fmt: skip
TEMPERATURE = {name: Unit(1.0) for name in ("c", "°c", "degc", "deg c", "deg.c", "celsius", "ºc", "˚c")} | {
    name: Unit(1.0, -273.15) for name in ("k", "kelvin")} | {
    name: Unit(5.0 / 9.0, -160.0 / 9.0) for name in ("f", "°f", "degf", "fahrenheit")}  # fmt: skip
NONE = {"": Unit(1.0), "-": Unit(1.0), "1": Unit(1.0), "[-]": Unit(1.0)}
STRAIN = {"%": Unit(0.01), "percent": Unit(0.01), "-": Unit(1.0), "1": Unit(1.0), "m/m": Unit(1.0), "strain": Unit(1.0)}
SPEED = {"m/s": Unit(1.0), "m_s": Unit(1.0), "mm/s": Unit(MM), "mm_s": Unit(MM), "cm/s": Unit(1e-2),
         "km/h": Unit(1.0 / 3.6), "m/min": Unit(1.0 / 60.0)}  # fmt: skip
ANGLE = {"deg": Unit(math.pi / 180), "°": Unit(math.pi / 180), "rad": Unit(1.0)}
OTHER_UNITS = {"s", "min", "h", "n", "kn", "mm", "um", "µm", "m", "g", "v", "ms", "µs", "n/m", "pa.s", "pa·s", "mpa.s",
               "1/pa", "rpm", "m2/n", "j", "cm"}  # fmt: skip
UNIT_WORDS = {*PRESSURE, *FREQUENCY, *TEMPERATURE, *NONE, *STRAIN, *SPEED, *ANGLE, *OTHER_UNITS}


@dataclass(frozen=True)
class Measurand:
    """A quantity: key, words for it, names in exports (letters, digits and primes only), units, option of its unit."""

    key: str
    told: str
    names: tuple[str, ...]
    units: dict[str, Unit]
    option: str = ""


DMA = (
    Measurand(
        "temperature", "temperature",
        ("temperature", "temp", "t", "sampletemperature", "tsample", "ts", "samptemp", "temperatur",
         "probentemperatur"),
        TEMPERATURE, "--temperature-unit",
    ),
    Measurand(
        "frequency", "frequency",
        ("frequency", "freq", "f", "angularfrequency", "angfrequency", "angfreq", "omega", "ω", "w",
         "frequenz", "kreisfrequenz"),
        FREQUENCY, "--frequency-unit",
    ),
    Measurand(
        "storage", "E'",
        ("storagemodulus", "storage", "estor", "estorage", "e'", "eprime", "estore", "storagemod",
         "tensilestoragemodulus", "storagemoduluse'", "e'storagemodulus", "speichermodul",
         "speichermodule'"), PRESSURE, "--modulus-unit",
    ),
    Measurand(
        "loss", "E''",
        ("lossmodulus", "loss", "eloss", "e''", "eprimeprime", "edoubleprime", "lossmod", "tensilelossmodulus",
         "lossmoduluse''", "e''lossmodulus", "verlustmodul", "verlustmodule''"), PRESSURE, "--modulus-unit",
    ),
    Measurand(
        "complex", "|E*|",
        ("complexmodulus", "e*", "|e*|", "dynamicmodulus", "ecomplex", "absolutemodulus", "komplexermodul"),
        PRESSURE, "--modulus-unit",
    ),
    Measurand(
        "tan_delta", "tan delta",
        ("tandelta", "tand", "tanδ", "tan", "lossfactor", "tandel", "tan(delta)", "tan(d)", "tan(δ)",
         "verlustfaktor"), NONE,
    ),
    Measurand("phase", "delta", ("phase", "phaseangle", "delta", "δ", "lossangle", "phasenwinkel"), ANGLE,
             "--phase-unit"),
    Measurand("set", "sweep", ("set", "sweep", "sweepnumber", "sweepno"), NONE),
)  # fmt: skip
FRICTION = (
    Measurand("pressure", "pressure", ("pressure", "p", "contactpressure", "nominalpressure", "normalpressure"),
             PRESSURE, "--pressure-unit"),
    Measurand("slip_speed", "slip speed", ("slipspeed", "slidingspeed", "slidingvelocity", "slipvelocity", "velocity",
             "speed", "v"), SPEED, "--speed-unit"),
    Measurand("coefficient", "friction coefficient", ("frictioncoefficient", "coefficientoffriction", "cof", "mu", "µ",
             "μ", "friction"), {**NONE, "%": Unit(0.01)}, "--coefficient-unit"),
    Measurand("temperature", "temperature", ("temperature", "temp", "t", "rubbertemperature"), TEMPERATURE,
             "--temperature-unit"),
    Measurand("run", "run", ("run", "repeat", "repetition", "runnumber"), NONE),
)  # fmt: skip
STRAIN_SWEEP = (
    Measurand("strain", "strain", ("strain", "strainamplitude", "dynamicstrain", "amplitude", "ε", "e0"), STRAIN,
             "--strain-unit"),
    next(quantity for quantity in DMA if quantity.key == "storage"),
)  # fmt: skip
SHEAR = {"g'", "g''", "gstor", "gloss", "shearstoragemodulus", "shearlossmodulus", "g*", "gstorage", "storagemodulusg'"}


WRITTEN = {"pa": "Pa", "kpa": "kPa", "mpa": "MPa", "gpa": "GPa", "hz": "Hz", "rad/s": "rad/s", "degc": "degC", "k": "K",
           "degf": "degF", "m/s": "m/s", "mm/s": "mm/s", "deg": "deg", "rad": "rad", "%": "%"}  # fmt: skip


def choices(units: dict[str, Unit]) -> str:
    """Return the usual units among `units`, as they are written."""
    return ", ".join(WRITTEN[name] for name in units if name in WRITTEN) or "none"


def bare_name(name: str) -> str:
    """Return a column's name evened out: lower case, no blanks, dots or underscores, straight primes."""
    text = name.strip().strip('"').lower()
    for prime in ("′", "´", "`", "’", "‘"):
        text = text.replace(prime, "'")
    text = text.replace("″", "''").replace('"', "''").replace("ʺ", "''")
    return re.sub(r"[\s_.\-:#]+", "", text)
