"""Strain dependence of a filled compound (Payne): the secant modulus at a run's strain over that of the sweeps.

A.R. Payne, J. Appl. Polym. Sci. 6 (1962) 57-63, doi:10.1002/app.1962.070061906. The models here are linear; what this
gives is how far that is off, not another model.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..instrument import Reading, read_blocks, recognise
from ..instrument.quantities import STRAIN_SWEEP

Array = NDArray[np.float64]

FEWEST = 4
LARGEST_STRAIN = 5.0


@dataclass(frozen=True)
class StrainSweep:
    """Modulus against strain amplitude at one frequency and temperature.

    Attributes
    ----------
    strain : (n,) array, increasing, 1 is 100 %
    storage_modulus : (n,) array, Pa
    source : str
    understood : tuple of str
    """

    strain: Array
    storage_modulus: Array
    source: str
    understood: tuple[str, ...] = ()

    def modulus(self, strain: float) -> float:
        """Return E' in Pa at a strain, linear in log strain between the points; raises `InputError` beyond them."""
        low, high = float(self.strain[0]), float(self.strain[-1])
        if not low * (1 - 1e-9) <= strain <= high * (1 + 1e-9):
            found = f"strains of {100 * low:.3g} to {100 * high:.3g} %"
            raise InputError(self.source, found, f"a sweep that reaches {100 * strain:.3g} %")
        return float(np.interp(np.log(strain), np.log(self.strain), self.storage_modulus))

    def secant_factor(self, strain: float, linear_strain: float) -> float:
        """Return the modulus at `strain` over that at `linear_strain`, at which the compound's moduli were measured."""
        return self.modulus(strain) / self.modulus(linear_strain)


def read_strain_sweep(path: Path | str, reading: Reading | None = None) -> StrainSweep:
    """Read a sweep of strain amplitude: strain (%, or a fraction) and storage modulus, known by name and unit.

    Rows may stand in any order; strains that repeat (a sweep up and down) are averaged. Raises `InputError` with file
    and line for a missing column or unit, values not above zero, fewer than four strains.
    """
    blocks, told = read_blocks(path)
    block = blocks[0]
    columns = recognise(block, STRAIN_SWEEP, reading or Reading())
    values = {}
    for key, quantity in (("strain", STRAIN_SWEEP[0]), ("storage", STRAIN_SWEEP[1])):
        if key not in columns:
            names = ", ".join(f"{k + 1} '{name}'" for k, name in enumerate(block.names))
            place = f"{path}:{max(block.line[0] - 1, 1)}"
            raise InputError(place, f"columns {names}", f"{quantity.told}: --column {key}=NUMBER")
        one = columns[key]
        numbers = []
        for row in range(len(block.cells)):
            value = block.number(row, one.column)
            most = LARGEST_STRAIN if key == "strain" else 1e15
            if value is None or not 0 < value * one.unit.factor <= most:
                found = "an empty cell" if value is None else f"{value:g}"
                where = f"{block.where}:{block.line[row]}: {one.heading}"
                raise InputError(where, found, f"a value > 0 (at most {most:g})")
            numbers.append(value * one.unit.factor)
        values[key] = np.array(numbers, dtype=np.float64)
    strain, place_of = np.unique(np.round(values["strain"], 9), return_inverse=True)
    if strain.size < FEWEST:
        raise InputError(path, f"{strain.size} strain(s)", f"at least {FEWEST}")
    modulus = np.bincount(place_of, values["storage"]) / np.bincount(place_of)
    said = "; ".join(columns[q.key].told(q) for q in STRAIN_SWEEP if q.key in columns)
    return StrainSweep(strain, modulus, str(path), (f"{Path(path).name}: {told}", said))
