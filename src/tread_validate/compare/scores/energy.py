"""What the energies of an explicit run say about its quality."""

from __future__ import annotations

import numpy as np
import pandas as pd

from ...errors import InputError

NEEDED = ("internal", "artificial", "total")


def energy_shares(energies: pd.DataFrame) -> dict[str, float]:
    """Return two ratios that belong beside every explicit result.

    Parameters
    ----------
    energies : DataFrame
        Columns ``internal``, ``artificial`` and ``total`` in one unit, in order of
        time; ``total`` is what should stay constant.

    Returns
    -------
    dict of str to float
        ``balance_error``: largest drift of the total over the largest internal energy;
        ``artificial_share``: largest hourglass energy over the largest internal energy.
    """
    for name in NEEDED:
        if name not in energies:
            raise InputError("energies", "columns " + ", ".join(energies.columns), f"a column {name}")
    internal = float(energies["internal"].abs().max())
    if not internal > 0.0:
        raise InputError("energies: internal", internal, "a value above 0")

    def share(values: pd.Series) -> float:
        return float(f"{np.max(np.abs(values.to_numpy(dtype=float))) / internal:.4g}")

    return {
        "balance_error": share(energies["total"] - energies["total"].iloc[0]),
        "artificial_share": share(energies["artificial"]),
    }
