"""A measured table of friction coefficient against pressure and slip speed, interpolated."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from ...errors import InputError
from ...fields import FileName
from ...kernels import kernel
from ...provenance import sha256_file
from ..law import FrictionEntry, FrictionLaw, LawForm
from ..table_file import FrictionData, read_friction_table, table_of

Array = NDArray[np.float64]


@kernel()
def table_kernel(
    parameters: Array, pressures: Array, slip_speeds: Array, table: Array, pressure: float, slip_speed: float
) -> float:
    """Return the coefficient between the nodes of the grid, linear in log p and log v, end values held outside."""
    i, fi = _cell(pressures, abs(pressure))
    j, fj = _cell(slip_speeds, abs(slip_speed))
    below = table[i, j] * (1.0 - fj) + table[i, j + 1] * fj
    above = table[i + 1, j] * (1.0 - fj) + table[i + 1, j + 1] * fj
    return float(below * (1.0 - fi) + above * fi)


@kernel()
def _cell(grid: Array, value: float) -> tuple[int, float]:
    """Return the cell of `grid` that holds `value` and the place in it, 0..1, in the logarithm; ends are held."""
    last = grid.size - 1
    if value <= grid[0]:
        return 0, 0.0
    if value >= grid[last]:
        return last - 1, 1.0
    i = 0
    while value > grid[i + 1]:
        i += 1
    return i, math.log(value / grid[i]) / math.log(grid[i + 1] / grid[i])


FORTRAN = """\
c
c     Kinetic friction coefficient from a table, linear in log p and
c     log v, end values held outside it.
c     props(1)  static coefficient
c     props(2)  number of contact pressures, np
c     props(3)  number of slip speeds, nv
c     then np contact pressures (MPa) and nv slip speeds (mm/s), both
c     increasing, and np rows of nv coefficients, one row a pressure
c
      function fricmu(nProps, props, press, speed)
      include 'vaba_param.inc'
      dimension props(nProps)
      np = nint(props(2))
      nv = nint(props(3))
      call fricel(np, props(4), abs(press), i, fi)
      call fricel(nv, props(4 + np), abs(speed), j, fj)
      k = 3 + np + nv + (i - 1)*nv + j
      below = props(k)*(1.d0 - fj) + props(k + 1)*fj
      above = props(k + nv)*(1.d0 - fj) + props(k + nv + 1)*fj
      fricmu = below*(1.d0 - fi) + above*fi
      return
      end
c
c     Cell of an increasing grid that holds a value, and the place in
c     it, 0 to 1, in the logarithm
c
      subroutine fricel(n, grid, value, i, f)
      include 'vaba_param.inc'
      dimension grid(n)
      if (value .le. grid(1)) then
         i = 1
         f = 0.d0
      else if (value .ge. grid(n)) then
         i = n - 1
         f = 1.d0
      else
         i = 1
   10    if (value .gt. grid(i+1)) then
            i = i + 1
            goto 10
         end if
         f = log(value/grid(i))/log(grid(i+1)/grid(i))
      end if
      return
      end
"""

CODE = 2
TABLE = LawForm("table", CODE, {}, table_kernel, FORTRAN, 0)


class FrictionTable(FrictionEntry):
    """A measured table of friction coefficient against pressure and slip speed, interpolated."""

    example: ClassVar[Mapping[str, Any]] = {"file": "friction.csv"}

    kind: Literal["table"]
    file: FileName

    def law(self, root: Path) -> FrictionLaw:
        """Return the law that interpolates the table; one pressure or one speed stands for all."""
        path = root / self.file
        return _read(path, self.static_coefficient, sha256_file(path) if path.is_file() else "")

    @classmethod
    def fit(cls, data: FrictionData, static_coefficient: float = 0.9) -> FrictionLaw:
        """Return the law that interpolates the measurements' means."""
        return table_law(data.pressures, data.speeds, table_of(data), static_coefficient)

    def measurements(self, root: Path) -> FrictionData:
        """Return the table's rows."""
        return read_friction_table(root / self.file)


def table_law(pressures: Array, slip_speeds: Array, table: Array, static_coefficient: float) -> FrictionLaw:
    """Return the law that interpolates a full grid: linear in log p and log v, end values held outside.

    Linear interpolation in each direction keeps the table's monotony and never overshoots it. One row or one column
    stands for all pressures or speeds. Raises `InputError` for a grid that is not positive and increasing.
    """
    p, v, mu = (np.array(values, dtype=np.float64) for values in (pressures, slip_speeds, table))
    for name, grid in (("pressure", p), ("slip speed", v)):
        if grid.size < 1 or not np.all(np.isfinite(grid) & (grid > 0)) or not np.all(np.diff(grid) > 0):
            raise InputError(f"friction table: {name}", grid, "positive values in increasing order")
    if mu.shape != (p.size, v.size) or not np.all(np.isfinite(mu) & (mu >= 0)):
        raise InputError("friction table", f"coefficients of shape {mu.shape}", f"{p.size} x {v.size} numbers >= 0")
    # the kernel works on cells: a lone level is doubled
    if p.size == 1:
        p, mu = np.array([p[0], 2.0 * p[0]]), np.vstack([mu, mu])
    if v.size == 1:
        v, mu = np.array([v[0], 2.0 * v[0]]), np.hstack([mu, mu])
    return FrictionLaw(TABLE, static_coefficient, {}, p, v, np.ascontiguousarray(mu))


@lru_cache(maxsize=32)
def _read(path: Path, static_coefficient: float, digest: str) -> FrictionLaw:
    """Read once per content: `digest` is there for the cache."""
    return FrictionTable.fit(read_friction_table(path), static_coefficient)
