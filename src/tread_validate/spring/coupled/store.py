"""Condensed blocks, remembered for the life of the process: the cases of a study share a few.

A face's stiffness is corrected for its mesh: two coarser static solves extrapolate the block's normal and shear
stiffness to the limit of fine meshes, and the matrix is scaled, symmetrically and direction by direction, to that.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ...study import Block
from ...units import MM
from ..stiffness import StiffnessRatios, static_ratios
from .body import Body, BodySettings, FreeShape, make_body
from .condense import FaceStiffness, condense
from .finite_strain import Stiffening, logarithmic_stiffening
from .operators import FaceOperators

Array = NDArray[np.float64]

FINE = BodySettings(face_size=1.25 * MM, layers=8)
COARSE = BodySettings(face_size=2.5 * MM, layers=4)
ORDER = 1.39
"""Order of convergence of the stiffness in the element size. Corners between a bonded and a free face limit it: meshes
of 4, 8 and 16 layers give 1.972, 1.891 and 1.860 for a 25 x 20 x 8 mm block with nu = 0.47, that is order 1.39 and a
limit of 1.841 (theory for a sharp corner of that material: 1.22, which would make the limit 0.2 per cent lower)."""
STIFFENING = BodySettings(face_size=2.0 * MM, layers=6)
"""A ratio of two stiffnesses needs no fine mesh: against 1 mm and 8 layers it is off by 1 per cent of itself."""


@lru_cache(maxsize=12)
def condensed(
    block: Block, shape: FreeShape, settings: BodySettings, poissons_ratio: float, mesh_correction: bool = True
) -> tuple[Body, FaceStiffness]:
    """Return the block's body and the stiffness of its face."""
    body = make_body(block, shape, settings)
    face = condense(body, poissons_ratio)
    if not mesh_correction:
        return body, face
    height = block.height_mm * MM
    limit, own = converged_ratios(block, shape, poissons_ratio), static_ratios(body, face, poissons_ratio, height)
    across = np.sqrt(limit.shear / own.shear)
    scale = np.tile([across, np.sqrt(limit.normal / own.normal), across], body.nodes_per_layer)
    matrix = scale[:, None] * face.stiffness * scale
    # the supports on the plane of symmetry only have to stay supports
    return body, FaceStiffness(matrix, face.follow)


@lru_cache(maxsize=12)
def operators(
    block: Block, shape: FreeShape, settings: BodySettings, poissons_ratio: float, mesh_correction: bool = True
) -> tuple[Body, Array, FaceOperators]:
    """Return the block's body, what its unloaded face does with the mount, and its face ready for contact."""
    body, face = condensed(block, shape, settings, poissons_ratio, mesh_correction)
    return body, face.follow, FaceOperators(body, face)


@lru_cache(maxsize=32)
def converged_ratios(block: Block, shape: FreeShape, poissons_ratio: float) -> StiffnessRatios:
    """Return the block's static stiffness ratios, extrapolated from two meshes, one twice as fine (Richardson)."""
    fine, coarse = (_ratios(block, shape, settings, poissons_ratio) for settings in (FINE, COARSE))
    return StiffnessRatios(
        *(
            getattr(fine, name) + (getattr(fine, name) - getattr(coarse, name)) / (2.0**ORDER - 1.0)
            for name in ("normal", "normal_sliding", "shear", "rocking")
        )
    )


@lru_cache(maxsize=32)
def stiffening(block: Block, shape: FreeShape, poissons_ratio: float) -> Stiffening:
    """Return the block's stiffening by logarithmic strain."""
    return logarithmic_stiffening(make_body(block, shape, STIFFENING), poissons_ratio)


def _ratios(block: Block, shape: FreeShape, settings: BodySettings, poissons_ratio: float) -> StiffnessRatios:
    body = make_body(block, shape, settings)
    return static_ratios(body, condense(body, poissons_ratio), poissons_ratio, block.height_mm * MM)
