"""Columns of a dynamic mechanical analysis as the instrument exported them, in SI, with what was understood."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..instrument import CellBlock, Reading, Recognised, read_blocks, recognise
from ..instrument.metadata import temperature_above
from ..instrument.quantities import DMA

Array = NDArray[np.float64]

TOLD = {quantity.key: quantity for quantity in DMA}


@dataclass(frozen=True)
class DmaTable:
    """One table of an export, (n,) each.

    Attributes
    ----------
    angular_frequency : rad/s
    storage_modulus, loss_modulus : Pa
    temperature : degC; NaN where the file does not say it
    sweep : number of the sweep as the file counts; NaN where it does not
    line : line of the file
    names : heading of each column by quantity, for error messages
    source : file (and sheet)
    """

    angular_frequency: Array
    storage_modulus: Array
    loss_modulus: Array
    temperature: Array
    sweep: Array
    line: NDArray[np.int64]
    names: dict[str, str]
    source: str

    def where(self, row: int) -> str:
        """Return file and line of a row."""
        return f"{self.source}:{self.line[row]}"

    def refuse(self, wrong: NDArray[np.bool_], key: str, values: Array, expected: str) -> None:
        """Raise `InputError` at the first row that is `wrong`."""
        if np.any(wrong):
            row = int(np.argmax(wrong))
            raise InputError(f"{self.where(row)}: {self.names.get(key, key)}", f"{values[row]:g}", expected)


def read_dma(path: Path | str, reading: Reading | None = None) -> tuple[tuple[DmaTable, ...], tuple[str, ...]]:
    """Return the tables of a file and, line by line, what was understood.

    Raises `InputError` for a quantity that is missing, doubtful or without a unit, and cells that are not numbers.
    """
    blocks, told = read_blocks(path)
    chosen = reading or Reading()
    tables, notes = [], [f"{Path(path).name}: {told}, {len(blocks)} table(s)"]
    for block in blocks:
        columns = recognise(block, DMA, chosen)
        _complete(block, columns)
        said = "; ".join(column.told(TOLD[key]) for key, column in columns.items())
        if said not in notes:
            notes.append(said)
        tables.append(_table(block, columns))
    return tuple(tables), tuple(notes)


def _complete(block: CellBlock, columns: dict[str, Recognised]) -> None:
    """Raise `InputError` where the columns do not give frequency, E' and E''."""
    names = ", ".join(f"{k + 1} '{name}'" for k, name in enumerate(block.names))
    place = f"{block.where}:{max(block.line[0] - 1, 1)}"
    if "frequency" not in columns:
        raise InputError(place, f"columns {names}", "a frequency (Hz or rad/s): --column frequency=NUMBER")
    moduli = {"storage", "loss", "complex"} & set(columns)
    angles = {"tan_delta", "phase"} & set(columns)
    if not {"storage", "loss"} <= moduli and not (moduli and (angles or len(moduli) > 1)):
        expected = "E' and E'', or one modulus with tan delta or phase: --column storage=NUMBER, loss=, tan_delta="
        raise InputError(place, f"columns {names}", expected)


def _table(block: CellBlock, columns: dict[str, Recognised]) -> DmaTable:
    values, kept = _numbers(block, columns)
    rows = len(kept)
    storage, loss = _moduli(values)
    nothing = np.full(rows, np.nan)
    temperature = values.get("temperature")
    if temperature is None:
        said = temperature_above(block.above)
        temperature = nothing if said is None else np.full(rows, said)
    return DmaTable(
        angular_frequency=values["frequency"],
        storage_modulus=storage,
        loss_modulus=loss,
        temperature=temperature,
        sweep=values.get("set", nothing),
        line=np.array([block.line[row] for row in kept], dtype=np.int64),
        names={key: column.heading for key, column in columns.items()},
        source=block.where,
    )


def _numbers(block: CellBlock, columns: dict[str, Recognised]) -> tuple[dict[str, Array], list[int]]:
    """Return the columns in SI without rows in which none of them has a number."""
    cells = {key: [block.number(row, one.column) for row in range(len(block.cells))] for key, one in columns.items()}
    kept = [row for row in range(len(block.cells)) if any(values[row] is not None for values in cells.values())]
    found = {}
    for key, column in columns.items():
        for row in kept:
            if cells[key][row] is None:
                raise InputError(f"{block.where}:{block.line[row]}: {column.heading}", "an empty cell", "a number")
        numbers = np.array([cells[key][row] for row in kept], dtype=np.float64)
        found[key] = column.unit.factor * numbers + column.unit.offset
    return found, kept


def _moduli(values: dict[str, Array]) -> tuple[Array, Array]:
    """Return E' and E'' in Pa from the moduli and angles there are; two moduli go before an angle."""
    if "storage" in values and "loss" in values:
        return values["storage"], values["loss"]
    with np.errstate(divide="ignore", invalid="ignore"):
        if "complex" in values and ("storage" in values or "loss" in values):
            known = "storage" if "storage" in values else "loss"
            other = np.sqrt(values["complex"] ** 2 - values[known] ** 2)
            return (values[known], other) if known == "storage" else (other, values[known])
        tangent = values["tan_delta"] if "tan_delta" in values else np.tan(values["phase"])
        if "storage" in values:
            return values["storage"], values["storage"] * tangent
        if "loss" in values:
            return values["loss"] / tangent, values["loss"]
        cosine = 1.0 / np.sqrt(1.0 + tangent**2)
        return values["complex"] * cosine, values["complex"] * cosine * tangent
