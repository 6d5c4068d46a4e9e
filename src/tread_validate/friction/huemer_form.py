"""The form of Huemer et al., Eng. Comput. 18 (2001) 417-436, Eq. (5) of the paper: kernel, Fortran, constants in SI."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..kernels import kernel
from ..units import IN_MPA, MPA
from .law import PRESSURE, SLIP_SPEED, FrictionLaw, LawForm

Array = NDArray[np.float64]

FITTED = ("alpha", "beta", "n", "m", "a", "b", "c")


@kernel()
def huemer_kernel(
    parameters: Array, pressures: Array, slip_speeds: Array, table: Array, pressure: float, slip_speed: float
) -> float:
    """Return (alpha |p|^(n-1) + beta)/(a + b |v|^(-1/m) + c |v|^(-2/m)), no lower than at its floors.

    Parameters 0-6 are alpha, beta, n, m, a, b, c (p in MPa, v in m/s), 7 the least pressure in Pa and 8 the least slip
    speed in m/s.
    """
    p = max(abs(pressure), parameters[7]) * IN_MPA
    v = max(abs(slip_speed), parameters[8])
    u = v ** (-1.0 / parameters[3])
    above = parameters[0] * p ** (parameters[2] - 1.0) + parameters[1]
    return float(above / (parameters[4] + parameters[5] * u + parameters[6] * u * u))


FORTRAN = """\
c
c     Kinetic friction coefficient after Huemer et al., Eng. Comput.
c     18 (2001) 417-436:
c       mu = (alpha p**(n-1) + beta)
c            / (a + b v**(-1/m) + c v**(-2/m)),  p in MPa, v in m/s
c     props(1)      static coefficient
c     props(2..8)   alpha, beta, n, m, a, b, c
c     props(9)      least contact pressure, MPa
c     props(10)     least slip speed, mm/s
c     The form diverges as p goes to 0 and vanishes as v goes to 0:
c     it is evaluated at no less than props(9) and props(10).
c
      function fricmu(nProps, props, press, speed)
      include 'vaba_param.inc'
      dimension props(nProps)
      p = max(abs(press), props(9))
      v = max(abs(speed), props(10))*1.d-3
      u = v**(-1.d0/props(5))
      above = props(2)*p**(props(4) - 1.d0) + props(3)
      below = props(6) + props(7)*u + props(8)*u*u
      fricmu = above/below
      return
      end
"""

CODE = 1
HUEMER = LawForm(
    "huemer",
    CODE,
    {
        "alpha": "MPa^(1-n)",
        "beta": "1",
        "n": "1",
        "m": "1",
        "a": "1",
        "b": "(m/s)^(1/m)",
        "c": "(m/s)^(2/m)",
        "least_pressure": PRESSURE,
        "least_slip_speed": SLIP_SPEED,
    },
    huemer_kernel,
    FORTRAN,
    proportional=2,
)


def huemer_law(
    alpha: float,
    beta: float,
    n: float,
    m: float,
    a: float,
    b: float,
    c: float,
    least_pressure: float = 10e3,
    least_slip_speed: float = 1e-3,
    static_coefficient: float = 0.9,
    where: str = "friction law",
) -> FrictionLaw:
    """Return mu = (alpha |p|^(n-1) + beta) / (a + b |v|^(-1/m) + c |v|^(-2/m)), p in MPa and v in m/s.

    Huemer et al., Eng. Comput. 18 (2001) 417-436. The floors are in Pa and m/s. Raises `InputError` for constants
    whose denominator is not positive at every slip speed, or whose numerator is negative somewhere up to 100 MPa.
    """
    u = np.geomspace(1e3, max(least_slip_speed, 1e-9), 2001) ** (-1.0 / m)
    below = a + b * u + c * u * u
    if not np.all(below > 0):
        slow = float(u[np.argmin(below)] ** -m)
        raise InputError(where, f"a denominator of {np.min(below):.3g} at {slow:.3g} m/s", "a, b, c that keep it > 0")
    p = np.geomspace(least_pressure, max(100 * MPA, 10 * least_pressure), 201) * IN_MPA
    above = alpha * p ** (n - 1.0) + beta
    if not np.all(above >= 0):
        raise InputError(
            where, f"a negative coefficient at {p[np.argmin(above)]:.3g} MPa", "alpha, beta, n that keep it >= 0"
        )
    values = (alpha, beta, n, m, a, b, c, least_pressure, least_slip_speed)
    return FrictionLaw(HUEMER, static_coefficient, {k: float(v) for k, v in zip(HUEMER.units, values, strict=True)})
