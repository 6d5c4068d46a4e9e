"""What a number can mean: the range of every quantity that is read from a command line or a file.

The unit at the end of a name (``interference_mm``, ``--reference-degC``) says what the number is; a name of its own
goes before its unit. The ranges are wide: they keep out what no tyre, rubber or rig can be, not what is unusual.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .errors import InputError, one_line


class Bound(NamedTuple):
    """A range: `least` <= value <= `most`, or `least` < value where the range is `open`."""

    least: float
    most: float
    unit: str = ""
    open: bool = False

    def holds(self, value: float) -> bool:
        """Whether a finite value lies in the range; nan and infinities do not."""
        return (
            math.isfinite(value) and (self.least < value if self.open else self.least <= value) and value <= self.most
        )

    def __str__(self) -> str:
        unit = f" {self.unit}" if self.unit else ""
        first = f"more than {self.least:g}" if self.open else f"{self.least:g}"
        return f"a number from {first} to {self.most:g}{unit}"


def _size(most: float, unit: str = "") -> Bound:
    return Bound(0.0, most, unit, open=True)


def _either_way(most: float, unit: str = "") -> Bound:
    return Bound(-most, most, unit)


UNITS = {
    "degC": Bound(-150.0, 400.0, "degC"),
    "K": _either_way(1e4, "K"),
    "mm": _either_way(1e5, "mm"),
    "m": _either_way(1e4, "m"),
    "N": _either_way(1e6, "N"),
    "Pa": _either_way(1e12, "Pa"),
    "kPa": _either_way(1e9, "kPa"),
    "MPa": _either_way(1e6, "MPa"),
    "s": _either_way(1e20, "s"),
    "rad_s": Bound(0.0, 1e20, "rad/s"),
    "Hz": Bound(0.0, 1e20, "Hz"),
    "m_s": _either_way(1e3, "m/s"),
    "mm_s": _either_way(1e6, "mm/s"),
    "rpm": _either_way(1e5, "rpm"),
    "kg_m3": Bound(1.0, 3e4, "kg/m3"),
    "kg_m2": _size(1e6, "kg/m2"),
    "percent": _either_way(100.0, "%"),
    "deg": _either_way(1e9, "deg"),
    "rad": _either_way(1e9, "rad"),
    "V": _either_way(1e6, "V"),
    "1_m": _either_way(1e5, "1/m"),
}

NAMES = {
    "c1": Bound(1e-3, 1e3),
    "c2_K": Bound(1e-3, 1e4, "K"),
    "interference_mm": Bound(1e-6, 50.0, "mm"),
    "diameter_mm": Bound(1.0, 1e4, "mm"),
    "length_mm": _size(1e3, "mm"),
    "width_mm": _size(1e3, "mm"),
    "height_mm": _size(1e3, "mm"),
    "element_size_mm": Bound(1e-3, 100.0, "mm"),
    "relaxation_time_s": _size(1e20, "s"),
    "time_s": _either_way(1e9, "s"),
    "time_limit_s": _size(1e7, "s"),
    "cutoff_Hz": Bound(0.1, 1e6, "Hz"),
    "highest_frequency_Hz": Bound(1.0, 1e5, "Hz"),
    "static_coefficient": Bound(0.0, 5.0),
    "kinetic_coefficient": Bound(0.0, 5.0),
    "slipping_fraction": Bound(0.0, 1.0),
    "alpha": _either_way(1e3),
    "beta": _either_way(1e3),
    "a": _either_way(1e6),
    "b": _either_way(1e6),
    "c": _either_way(1e6),
    "n": _size(100.0),
    "m": _size(1e3),
    "margin": _size(1e6),
    "strain_percent": _size(500.0, "%"),
    "activation_energy_kJ_mol": Bound(0.1, 1e4, "kJ/mol"),
    "loss_weight": Bound(0.0, 1e3),
    "prune_percent": Bound(0.0, 100.0, "%", open=True),
    "noise_percent": Bound(0.0, 20.0, "%"),
    "cell_percent": Bound(0.0, 20.0, "%"),
    "poissons_ratio": Bound(0.0, 0.49999, open=True),
    "share": Bound(0.0, 1.0),
    "confidence": Bound(0.5, 0.999),
}


def bound_of(name: str) -> Bound | None:
    """Return the range of the quantity that a name stands for, by the name or by the unit at its end; None: unknown."""
    words = name.strip().replace("-", "_").strip("_").split("_")
    for table in (NAMES, UNITS):
        for start in range(len(words)):
            found = table.get("_".join(words[start:]))
            compound = start > 0 and words[start - 1] in UNITS  # N_m: newton a metre is no length
            if found is not None and not compound and (start == 0 or table is UNITS or len(words[-1]) > 1):
                return found
    return None


def bounded(value: float, name: str, where: object = None) -> float:
    """Return a value that lies in the range of the quantity called `name`, or raise `InputError`.

    A quantity of unknown range must be finite.
    """
    bound = bound_of(name)
    if bound is None:
        if not math.isfinite(value):
            raise InputError(where or name, value, "a finite number")
    elif not bound.holds(value):
        raise InputError(where or name, one_line(f"{value:g}"), str(bound))
    return value


def first_beyond(values: NDArray[np.float64], name: str) -> tuple[int, str] | None:
    """Return row and range of the first value out of the range of a column called `name`; NaN is a gap, and passes."""
    bound = bound_of(name)
    if bound is None:
        return None
    below = values <= bound.least if bound.open else values < bound.least
    wrong = below | (values > bound.most)
    return (int(np.argmax(wrong)), str(bound)) if wrong.any() else None
