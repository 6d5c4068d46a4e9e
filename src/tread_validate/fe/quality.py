"""What a run says of its own worth: energy shares, largest strain and pressure, and whether it can be a reference."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

Floats = NDArray[np.float64]

WORST_BALANCE = 0.01
"""Largest energy that may be unaccounted for, of the larger of internal energy and external work."""
WORST_ARTIFICIAL = 0.02
"""Largest hourglass energy, of the largest internal energy."""
WORST_IMPACT = 0.02
"""Largest loss at impacts of contact nodes, of the larger of internal energy and external work."""
WORST_UNSTEADINESS = 0.005
"""Largest scatter of the tangential force from sample to sample, of the peak normal force: smooth passes of the
study's kind stay below 0.0025, sliding that sticks and slips lies above 0.0065."""
WORST_ALTERNATION = 0.005
"""Largest share of the tangential impulse that chattering nodes may leave out: T/N of a face that slides steadily at a
constant coefficient is that coefficient within as much."""
NO_HISTORY = "no reliable history in this regime, stick and slip alternate"
SHORTEST_STICK = 3
"""Samples up to which a stick between two slips is chatter: in a pass that rolls nodes stick for much longer."""


def energy_balance(energies: pd.DataFrame) -> dict[str, float]:
    """Return the energies (J) that the shares refer to, and the shares.

    Parameters
    ----------
    energies : DataFrame
        Columns of `FeResult.energies`.
    """
    internal = float(energies["internal"].abs().max())
    external = float(energies["external_work"].abs().max())
    larger = max(internal, external)

    def share(name: str, of: float) -> float:
        return float(energies[name].abs().max()) / of if of > 0.0 else 0.0

    return {
        "internal_J": internal,
        "external_work_J": external,
        "balance_error": share("total", larger),
        "artificial_share": share("artificial", internal),
        "impact_share": share("contact_impact", larger),
    }


def unsteadiness(normal: Floats, tangential: Floats) -> float:
    """Return the scatter of T from sample to sample over the peak of N; 0 for a force linear in time.

    The root mean square of second differences over the square root of 6: the standard deviation of white noise.
    """
    peak = float(np.abs(normal).max(initial=0.0))
    if tangential.size < 3 or peak == 0.0:
        return 0.0
    return float(np.sqrt((np.diff(tangential, 2) ** 2).mean() / 6.0) / peak)


def alternation(states: NDArray[np.int8], pressures: Floats, tractions: Floats) -> float:
    """Return the share of the tangential impulse that is left out where nodes chatter.

    A node that sticks for `SHORTEST_STICK` samples at most between two at which it slips carries less than it would had
    it slipped on: the mean of traction over pressure of the two, times its pressure, less its traction along them.

    Parameters
    ----------
    states : (samples, nodes)
        0 open, 1 sticks, 2 slips.
    pressures : (samples, nodes)
    tractions : (samples, nodes, 3)
    """
    whole = float(np.linalg.norm(tractions, axis=2).sum())
    if whole == 0.0:
        return 0.0
    slips = (states == 2) & (pressures > 0.0)
    missing = 0.0
    for length in range(1, SHORTEST_STICK + 1):
        count = len(states) - length - 1
        if count <= 0:
            break
        between = np.all([states[k : k + count] == 1 for k in range(1, length + 1)], axis=0)
        first, node = np.nonzero(slips[:count] & between & slips[length + 1 :])
        last = first + length + 1
        ratio = 0.5 * (
            tractions[first, node] / pressures[first, node, None] + tractions[last, node] / pressures[last, node, None]
        )
        size = np.linalg.norm(ratio, axis=1)
        along = ratio / np.where(size > 0.0, size, 1.0)[:, None]
        for k in range(1, length + 1):
            own = (along * tractions[first + k, node]).sum(axis=1)
            missing += float((size * pressures[first + k, node] - own).sum())
    return missing / whole


def reference_quality(balance: dict[str, float], scatter: float, chatter: float) -> dict[str, Any]:
    """Return whether a run can be a reference (`usable`), and why not (`reasons`).

    Parameters
    ----------
    balance : dict
        Of `energy_balance`.
    scatter, chatter : float
        Of `unsteadiness` and `alternation`.
    """
    reasons = [
        f"{what} {100.0 * value:.2g} % of the {of}, at most {100.0 * limit:g} %"
        for what, value, of, limit in (
            ("energy unaccounted for is", balance["balance_error"], "internal energy or external work", WORST_BALANCE),
            ("artificial energy is", balance["artificial_share"], "internal energy", WORST_ARTIFICIAL),
            ("impacts took", balance["impact_share"], "internal energy or external work", WORST_IMPACT),
            (f"{NO_HISTORY}: T scatters by", scatter, "peak normal force", WORST_UNSTEADINESS),
            (f"{NO_HISTORY}: chatter leaves out", chatter, "tangential impulse", WORST_ALTERNATION),
        )
        if not value <= limit
    ]
    return {"usable": not reasons, "reasons": reasons}
