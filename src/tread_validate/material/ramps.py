"""Temperature ramps that run through a few frequencies again and again, turned into isothermal sweeps."""

from __future__ import annotations

import numpy as np

from .dma_file import DmaTable
from .sweep import Sweep

FEWEST_FREQUENCIES, MOST_FREQUENCIES = 2, 30
FEWEST_ROUNDS = 5
SAME_FREQUENCY = 0.01  # in ln w


def ramp_rounds(table: DmaTable) -> list[slice]:
    """Return the rows of each round of a ramp; none where the table is no ramp.

    A ramp has the same frequencies in the same order in every round, and its temperature goes on changing within the
    rounds as it does from round to round.
    """
    w = table.angular_frequency
    again = np.flatnonzero(np.abs(np.log(w / w[0])) < SAME_FREQUENCY)
    if again.size < FEWEST_ROUNDS:
        return []
    k = int(again[1])
    rounds = w.size // k
    if not FEWEST_FREQUENCIES <= k <= MOST_FREQUENCIES or rounds < FEWEST_ROUNDS:
        return []
    shape = np.log(w[: rounds * k]).reshape(rounds, k)
    if np.any(np.abs(shape - shape[0]) > SAME_FREQUENCY):
        return []
    temperature = table.temperature[: rounds * k]
    means = temperature.reshape(rounds, k).mean(axis=1)
    within = np.abs(np.diff(temperature.reshape(rounds, k), axis=1)).mean()
    between = np.abs(np.diff(means)).mean() / k
    steady = bool(np.all(np.diff(means) > 0) or np.all(np.diff(means) < 0))
    if not steady or within < 0.3 * between:  # steps of temperature, each held for a whole round
        return []
    return [slice(i * k, (i + 1) * k) for i in range(rounds)]


def isothermal(table: DmaTable, rounds: list[slice]) -> tuple[list[Sweep], str]:
    """Return one sweep a round, moduli interpolated (log modulus over temperature) to its mean temperature.

    The first and last round are only interpolated from: at their mean temperature some frequencies would have to be
    extrapolated.
    """
    k = rounds[0].stop - rounds[0].start
    rows = np.arange(len(rounds) * k).reshape(-1, k)
    temperature = table.temperature[rows]
    order = np.argsort(table.angular_frequency[:k])
    found = []
    up = 1.0 if temperature[-1, 0] > temperature[0, 0] else -1.0
    for i in range(1, len(rounds) - 1):
        at = float(temperature[i].mean())
        moduli = [
            [np.exp(np.interp(up * at, up * temperature[:, j], np.log(values[rows[:, j]]))) for j in order]
            for values in (table.storage_modulus, table.loss_modulus)
        ]
        w = table.angular_frequency[rows[i]][order]
        found.append(Sweep(at, w, np.array(moduli[0]), np.array(moduli[1]), table.line[rows[i]][order]))
    left = table.line.size - len(rounds) * k
    told = (
        f"a temperature ramp with {k} frequencies in turn: {len(found)} sweeps at "
        f"{found[0].temperature:.4g} to {found[-1].temperature:.4g} degC, interpolated over temperature"
        + (f"; {left} row(s) of an unfinished round left out" if left else "")
    )
    return found, told
