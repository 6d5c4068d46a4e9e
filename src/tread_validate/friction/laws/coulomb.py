"""A constant kinetic coefficient."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import ConfigDict, Field, model_validator

from ...kernels import kernel
from ..law import Coefficient, FrictionEntry, FrictionLaw, LawForm
from ..table_file import FrictionData

Array = NDArray[np.float64]


@kernel()
def coulomb_kernel(
    parameters: Array, pressures: Array, slip_speeds: Array, table: Array, pressure: float, slip_speed: float
) -> float:
    """Return the kinetic coefficient, parameter 0."""
    return float(parameters[0])


FORTRAN = """\
c
c     Kinetic friction coefficient: a constant.
c     props(1) static coefficient, props(2) kinetic coefficient
c
      function fricmu(nProps, props, press, speed)
      include 'vaba_param.inc'
      dimension props(nProps)
      fricmu = props(2)
c     neither pressure (MPa) nor slip speed (mm/s) enters
      if (press .lt. -1.d30 .and. speed .lt. -1.d30) fricmu = 0.d0
      return
      end
"""

CODE = 0
COULOMB = LawForm("coulomb", CODE, {"kinetic_coefficient": "1"}, coulomb_kernel, FORTRAN, 1, limit="kinetic")


def _may_lack_static(schema: dict[str, Any]) -> None:
    schema["required"].remove("static_coefficient")


class Coulomb(FrictionEntry):
    """A constant kinetic coefficient."""

    model_config = ConfigDict(json_schema_extra=_may_lack_static)

    example: ClassVar[Mapping[str, Any]] = {"kinetic_coefficient": 0.5}

    kind: Literal["coulomb"]
    static_coefficient: Coefficient = Field(description="the kinetic coefficient where it is left out")
    kinetic_coefficient: Coefficient

    @model_validator(mode="before")
    @classmethod
    def _one_coefficient(cls, data: Any) -> Any:
        """Take the kinetic coefficient for the static one where that is not given: one number is one number."""
        if isinstance(data, dict) and "static_coefficient" not in data and "kinetic_coefficient" in data:
            return data | {"static_coefficient": data["kinetic_coefficient"]}
        return data

    def law(self, root: Path) -> FrictionLaw:
        """Return the law."""
        return coulomb_law(self.kinetic_coefficient, self.static_coefficient)

    @classmethod
    def fit(cls, data: FrictionData, static_coefficient: float = 0.9) -> FrictionLaw:
        """Return the law of the mean coefficient."""
        return coulomb_law(float(np.mean(data.coefficient)), static_coefficient)


def coulomb_law(kinetic_coefficient: float, static_coefficient: float) -> FrictionLaw:
    """Return the law of a constant kinetic coefficient."""
    return FrictionLaw(COULOMB, static_coefficient, {"kinetic_coefficient": float(kinetic_coefficient)})
