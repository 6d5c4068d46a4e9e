"""``*AMPLITUDE``: the table of times and values, scaled as the keyword asks."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .deck import KeywordBlock

Floats = NDArray[np.float64]


def amplitude_table(block: KeywordBlock) -> Floats:
    """Return the rows (time, value) of a tabular or smooth-step amplitude, up to four pairs to a line.

    SCALEX and SCALEY multiply times and values.

    Returns
    -------
    (n, 2) array

    Raises
    ------
    InputError
        No pairs, times that do not increase, a factor that is none.
    """
    numbers = _plain_numbers(block.data.texts)
    if numbers is None:
        numbers = [line.number_at(i, "time, value pairs") for line in block.data for i in range(len(line.fields))]
    if not numbers or len(numbers) % 2:
        raise InputError(block.where, f"{len(numbers)} numbers", "time, value pairs")
    table = np.array(numbers).reshape(-1, 2) * [_factor(block, "SCALEX"), _factor(block, "SCALEY")]
    if np.any(np.diff(table[:, 0]) <= 0):
        raise InputError(block.where, "times that do not increase", "increasing times")
    return np.asarray(table, dtype=np.float64)


def _plain_numbers(texts: Sequence[str]) -> list[float] | None:
    """Return all numbers of lines that hold nothing else, at once; None where a line is anything unusual."""
    joined = ",".join(text.strip().removesuffix(",") for text in texts)
    if "_" in joined:
        return None
    try:
        numbers = list(map(float, joined.split(",")))
    except ValueError:
        return None
    return numbers if all(map(math.isfinite, numbers)) else None


def _factor(block: KeywordBlock, name: str) -> float:
    if name not in block.parameters:
        return 1.0
    try:
        factor = float(block.value(name))
    except ValueError:
        factor = float("nan")
    if not 0.0 < abs(factor) < float("inf") or (name == "SCALEX" and factor < 0.0):
        raise InputError(f"{block.where}: *AMPLITUDE, {name}", block.value(name), "a factor, above 0 for times")
    return factor
