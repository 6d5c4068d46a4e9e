"""Condensed blocks, remembered for the life of the process: the cases of a study share a few."""

from __future__ import annotations

from functools import lru_cache

from ...study import Block
from .body import Body, BodySettings, FreeShape, make_body
from .condense import FaceStiffness, condense
from .finite_strain import Stiffening, logarithmic_stiffening

STIFFENING_SETTINGS = BodySettings(face_size=2e-3, layers=6)
"""The ratio of two stiffnesses needs no fine mesh: against 1 mm and 8 layers it is off by 1 per cent of itself."""


@lru_cache(maxsize=12)
def condensed(
    block: Block, shape: FreeShape, settings: BodySettings, poissons_ratio: float
) -> tuple[Body, FaceStiffness, Stiffening]:
    """Return the block's body, its face's stiffness and its stiffening by logarithmic strain."""
    body = make_body(block, shape, settings)
    size = max(STIFFENING_SETTINGS.face_size, settings.face_size)
    coarse = make_body(block, shape, BodySettings(size, STIFFENING_SETTINGS.layers))
    return body, condense(body, poissons_ratio), logarithmic_stiffening(coarse, poissons_ratio)
