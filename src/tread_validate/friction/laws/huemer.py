"""The form of Huemer et al. with its constants written out; the paper's Eq. (5)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Literal

from pydantic import Field, FiniteFloat

from ...fields import Positive
from ...units import KPA, MM
from ..huemer_form import FORTRAN, HUEMER, huemer_kernel, huemer_law
from ..law import FrictionEntry, FrictionLaw
from ..table_file import FrictionData

__all__ = ["FORTRAN", "HUEMER", "Huemer", "huemer_kernel", "huemer_law"]


class Huemer(FrictionEntry):
    """mu = (alpha |p|^(n-1) + beta) / (a + b |v|^(-1/m) + c |v|^(-2/m)), p in MPa, v in m/s.

    Huemer et al., Eng. Comput. 18 (2001) 417-436.
    """

    example: ClassVar[Mapping[str, Any]] = {
        "alpha": 0.8,
        "beta": 0.1,
        "n": 0.9,
        "m": 10.0,
        "a": 3.7,
        "b": -4.5,
        "c": 1.8,
    }

    kind: Literal["huemer"]
    alpha: FiniteFloat
    beta: FiniteFloat
    n: Positive
    m: Positive
    a: FiniteFloat
    b: FiniteFloat
    c: FiniteFloat
    least_pressure_kPa: Positive = Field(10.0, description="the law is evaluated at no less pressure than this")
    least_slip_speed_mm_s: Positive = Field(1.0, description="and at no less slip speed than this")

    def law(self, root: Path) -> FrictionLaw:
        """Return the law in SI."""
        return self.with_static(self.static_coefficient, "friction law")

    @classmethod
    def fit(cls, data: FrictionData, static_coefficient: float = 0.9) -> FrictionLaw:
        """Return the law of least squares; `fit.fit_friction` gives its intervals and warnings too."""
        from ..fit import fit_friction  # SciPy's optimisers, which a study without a fit does not need

        return fit_friction(data, static_coefficient=static_coefficient).law

    def with_static(self, static_coefficient: float, where: str) -> FrictionLaw:
        """Return the law in SI with another static coefficient; `where` names it in an error."""
        return huemer_law(
            self.alpha,
            self.beta,
            self.n,
            self.m,
            self.a,
            self.b,
            self.c,
            self.least_pressure_kPa * KPA,
            self.least_slip_speed_mm_s * MM,
            static_coefficient,
            where,
        )
