"""Decks that model half a block: how the readers of their results know."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .deck import Deck

PLANE = "SYMMETRY_PLANE"
"""Node set on the plane of symmetry z = 0. A deck with it models one half; a reader doubles forces and energies."""


def is_half(deck: Deck) -> bool:
    """Whether a deck models half a block."""
    return any(block.parameters.get("NSET") == PLANE for block in deck.named("NSET"))


def whole(deck: Deck) -> float:
    """Return the factor from what a deck models to the whole block: 2 for half a block, else 1."""
    return 2.0 if is_half(deck) else 1.0


def whole_force(deck: Deck, force: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return forces (..., 3) on the whole block: those on the half mirrored at z = 0 and added."""
    return np.asarray(force * [2.0, 2.0, 0.0] if is_half(deck) else force, dtype=np.float64)
