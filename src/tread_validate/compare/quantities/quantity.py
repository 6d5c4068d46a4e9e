"""What a row of the catalogue says: a scalar of a pass, or a score of a pair of histories."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from .values import Compute, Spread

ErrorType = Literal["relative", "absolute", "score"]
Column = Literal["normal", "tangential", "slip"]
Scale = Literal["itself", "peak_normal_force", "normal_impulse", "contact_duration", "one"]

FORCE_TOLERANCE = 0.10

# A noise is what another processor may do to a number, not what a change of the code may: bounds that no noise of a
# deterministic model exceeds. A declaration beyond them is a mistake and is refused.
MOST_RELATIVE = 1e-3
MOST_ABSOLUTE = {"N": 1e-2, "N s": 1e-4, "s": 1e-4, "1": 5e-3}


@dataclass(frozen=True)
class Noise:
    """How far a number may move before it counts as moved: `relative` times the number plus `absolute` in its unit."""

    relative: float
    absolute: float

    def __post_init__(self) -> None:
        for value in (self.relative, self.absolute):
            if not (math.isfinite(value) and value >= 0.0):
                raise ValueError(f"noise: got {value}, expected a finite number >= 0")
        if self.relative > MOST_RELATIVE:
            raise ValueError(f"noise: got {self.relative:g} relative, expected at most {MOST_RELATIVE:g}")

    def width(self, value: float | None) -> float:
        """Return the width about `value`, to four digits, in its unit."""
        return float(f"{self.relative * abs(value or 0.0) + self.absolute:.4g}")


@dataclass(frozen=True)
class Quantity:
    """One scalar of a run.

    Attributes
    ----------
    name, unit : str
        Name without unit; SI unit, ``1`` for a pure number.
    label, symbol : str
        As the report prints it.
    compute : callable
        From a `Contact` to the scalar, in `unit`.
    spread : callable
        What a relative uncertainty of all forces makes of it.
    noise : Noise
        How far another processor may move it.
    scale : str
        What the tolerance is a share of: the reference itself, another scalar of the reference, or ``one``.
    tolerance : float
        Largest error that is good enough by default, as a share of the scale.
    reason : str
        Why.
    floor : float or None
        Error in `unit` that is good enough however small the reference is; such a quantity is judged in its unit, any
        other of scale ``itself`` relatively.
    needs : str
        The column of a history that it is computed from: a model may leave out all but the normal force.
    measured : bool
        Whether a rig could measure it.
    flag : bool
        Whether it is yes (1) or no (0), which no mesh error blurs.
    """

    name: str
    unit: str
    label: str
    symbol: str
    compute: Compute
    spread: Spread
    noise: Noise
    scale: Scale
    tolerance: float
    reason: str
    floor: float | None = None
    needs: Column = "normal"
    measured: bool = True
    flag: bool = False

    def __post_init__(self) -> None:
        most = 0.5 if self.flag else MOST_ABSOLUTE[self.unit]
        if self.noise.absolute > most:
            raise ValueError(f"{self.name}: got a noise of {self.noise.absolute:g} {self.unit}, expected <= {most:g}")

    @property
    def error_type(self) -> ErrorType:
        """``relative`` to the reference, or ``absolute`` in the quantity's unit."""
        return "relative" if self.scale == "itself" and self.floor is None else "absolute"

    @property
    def column(self) -> str:
        """Name with its unit, as the tables' headers have it."""
        return f"{self.name}_{self.unit.replace(' ', '_')}" if self.unit != "1" else self.name


@dataclass(frozen=True)
class HistoryMetric:
    """One score of a pair of histories: how its error is expressed and what passes.

    `sensitivity` is the largest change of the score per unit of relative amplitude error of the reference, to first
    order; `noise` is in the error's unit; `floor` in N makes the error of a tangential history one in
    newtons.
    """

    name: str
    label: str
    error_type: ErrorType
    tolerance: float
    reason: str
    sensitivity: float
    noise: Noise
    floor: float | None = None
