"""The registry of spring-model variants: a name and how to make a ready-to-run pass from a case."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..study import Case
from .block_pass import prepare

Array = NDArray[np.float64]


class Pass(Protocol):
    """What a variant makes of a case: forces of the block at any creep ratio, on a uniform clock from first touch."""

    @property
    def step(self) -> float:
        """Time between rows of `forces`, s."""

    def forces(self, creep_ratio: float) -> Array:
        """Return normal force, shear force (N, positive like lambda), touching and slipping area (m2), (n, 4)."""

    def net_shear_impulse(self, creep_ratio: float) -> float:
        """Return the time integral of the shear force over the pass, N s."""


_VARIANTS: dict[str, tuple[Callable[[Case], Pass], str]] = {}


def register(name: str, make: Callable[[Case], Pass], summary: str) -> None:
    """Add a variant; `make` turns a case into a pass, `summary` is one line for a reader."""
    _VARIANTS[name] = (make, summary)


def variants() -> dict[str, str]:
    """Return the known variants and their one-line summaries."""
    return {name: summary for name, (_, summary) in _VARIANTS.items()}


def pass_of(case: Case, variant: str = "paper") -> Pass:
    """Return the case ready to run; raises `InputError` for an unknown variant or a case that cannot be."""
    if variant not in _VARIANTS:
        raise InputError("spring variant", variant, f"one of {', '.join(_VARIANTS)}")
    return _VARIANTS[variant][0](case)


register("paper", prepare, "independent springs with lumped mass, section 4 of the paper")
register(
    "light",
    lambda case: prepare(case, mass_factor=1e-2),
    "the same with a hundredth of the lumped mass: near the massless limit |F_l| = mu_k F_r",
)
