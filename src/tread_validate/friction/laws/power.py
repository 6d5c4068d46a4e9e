"""A power of the slip speed: the simplest law that falls (or rises) with speed on a logarithmic plot."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, FiniteFloat

from ...errors import InputError
from ...fields import Positive
from ...kernels import kernel
from ...units import MM
from ..law import SLIP_SPEED, Coefficient, FrictionEntry, FrictionLaw, LawForm
from ..table_file import FrictionData

Array = NDArray[np.float64]


@kernel()
def power_kernel(
    parameters: Array, pressures: Array, slip_speeds: Array, table: Array, pressure: float, slip_speed: float
) -> float:
    """Return mu0 (v/v0)^n: parameters mu0, v0 (m/s), n and the least slip speed (m/s) that v is held at."""
    return float(parameters[0] * (max(abs(slip_speed), parameters[3]) / parameters[1]) ** parameters[2])


FORTRAN = """\
c
c     Kinetic friction coefficient as a power of the slip speed:
c       mu = mu0 (v/v0)**n
c     props(1) static coefficient
c     props(2) mu0, props(3) v0 (mm/s), props(4) n
c     props(5) least slip speed, mm/s: a falling law diverges as v
c              goes to 0 and is evaluated at no less than this
c
      function fricmu(nProps, props, press, speed)
      include 'vaba_param.inc'
      dimension props(nProps)
      v = max(abs(speed), props(5))
      fricmu = props(2)*(v/props(3))**props(4)
c     the contact pressure (MPa) does not enter
      if (press .lt. -1.d30) fricmu = 0.d0
      return
      end
"""

CODE = 3
POWER = LawForm(
    "power",
    CODE,
    {
        "reference_coefficient": "1",
        "reference_slip_speed": SLIP_SPEED,
        "exponent": "1",
        "least_slip_speed": SLIP_SPEED,
    },
    power_kernel,
    FORTRAN,
    proportional=1,
)


class Power(FrictionEntry):
    """mu = mu0 (v/v0)^n, whatever the pressure."""

    example: ClassVar[Mapping[str, Any]] = {
        "reference_coefficient": 0.8, "reference_slip_speed_mm_s": 100.0, "exponent": -0.1,
    }  # fmt: skip

    kind: Literal["power"]
    reference_coefficient: Coefficient = Field(description="mu0, the kinetic coefficient at v0")
    reference_slip_speed_mm_s: Positive = Field(description="v0")
    exponent: Annotated[FiniteFloat, Field(ge=-1, le=1)] = Field(description="n, below 0 for a falling law")
    least_slip_speed_mm_s: Positive = Field(1.0, description="the law is evaluated at no less slip speed than this")

    def law(self, root: Path) -> FrictionLaw:
        """Return the law in SI."""
        return power_law(
            self.reference_coefficient,
            self.reference_slip_speed_mm_s * MM,
            self.exponent,
            self.least_slip_speed_mm_s * MM,
            self.static_coefficient,
        )

    @classmethod
    def fit(cls, data: FrictionData, static_coefficient: float = 0.9) -> FrictionLaw:
        """Return the law of least squares in log mu against log v; v0 is the measurements' geometric mean speed."""
        x, y = np.log(data.slip_speed), np.log(data.coefficient)
        around = x - x.mean()
        if not around.any():
            raise InputError(data.source, f"one slip speed only, {data.speeds[0]:.4g} m/s", "two or more slip speeds")
        slope = float(around @ y / (around @ around))
        mu0, v0 = float(np.exp(y.mean())), float(np.exp(x.mean()))
        return power_law(mu0, v0, slope, float(data.speeds[0]), static_coefficient)


def power_law(
    reference_coefficient: float,
    reference_slip_speed: float,
    exponent: float,
    least_slip_speed: float = 1e-3,
    static_coefficient: float = 0.9,
) -> FrictionLaw:
    """Return mu0 (v/v0)^n at no less than the least slip speed; speeds in m/s."""
    values = (reference_coefficient, reference_slip_speed, exponent, least_slip_speed)
    return FrictionLaw(POWER, static_coefficient, {k: float(v) for k, v in zip(POWER.units, values, strict=True)})
