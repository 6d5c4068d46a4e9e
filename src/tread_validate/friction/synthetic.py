"""A synthetic tribometer table, as a user would bring one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .law import FrictionLaw

Array = NDArray[np.float64]

PRESSURES = (0.05e6, 0.1e6, 0.2e6, 0.4e6, 0.8e6)  # Pa
SLIP_SPEEDS = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0)  # m/s
REPEATS = 3


def synthetic_table(law: FrictionLaw, noise: float = 0.02, seed: int = 4) -> tuple[Array, Array, Array]:
    """Return pressure (Pa), slip speed (m/s) and coefficient, (120,) each: `law` with relative Gaussian `noise`."""
    random = np.random.default_rng(seed)
    p, v, _ = (grid.ravel() for grid in np.meshgrid(PRESSURES, SLIP_SPEEDS, np.arange(REPEATS), indexing="ij"))
    coefficient = law.kinetic(p, v) * (1.0 + noise * random.standard_normal(p.size))
    return p, v, coefficient
