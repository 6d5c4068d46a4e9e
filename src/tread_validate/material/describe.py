"""Outliers of a master curve and the scatter of the rest, found together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .master import MasterCurve
from .outliers import outliers
from .rich import RichCurve, Scatter, rich_curve, scatter

ROUNDS = 4
LEAST_FREE = 0.4


def describe(master: MasterCurve) -> tuple[RichCurve, NDArray[np.bool_]]:
    """Return the rich curve of a master curve and which of its points, (m,), are outliers in E' or E''.

    Curve and outliers depend on each other: the curve is fitted to what is left and the test repeated until it marks
    the same points again.
    """
    w = master.angular_frequency
    rows = [np.flatnonzero(master.sweep == k) for k in np.unique(master.sweep)]
    outlier = np.zeros(w.size, dtype=np.bool_)
    rich = rich_curve(w, *master.moduli)
    for _ in range(ROUNDS):
        marked = np.zeros_like(outlier)
        for data, curve, leverage in zip(master.moduli, rich.moduli(w), rich.leverage, strict=True):
            residual = np.log(data / curve)
            residual[~outlier] /= np.maximum(1.0 - leverage, LEAST_FREE)  # as if the curve did not know the point
            for row, found in zip(rows, outliers([residual[row] for row in rows]), strict=True):
                marked[row] |= found
        if np.array_equal(marked, outlier):
            break
        outlier = marked
        rich = rich_curve(w[~outlier], *(data[~outlier] for data in master.moduli))
    return rich, outlier


def scatters(
    master: MasterCurve, rich: RichCurve, outlier: NDArray[np.bool_], kept: NDArray[np.bool_]
) -> tuple[Scatter, Scatter]:
    """Return the scatters of E' and E'' at the points `kept`, (m,), none of them an outlier."""
    w = master.angular_frequency[kept]
    both = [
        scatter(w, np.log(data[kept] / curve), float(leverage[kept[~outlier]].sum()))
        for data, curve, leverage in zip(master.moduli, rich.moduli(w), rich.leverage, strict=True)
    ]
    return both[0], both[1]
