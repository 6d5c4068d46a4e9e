"""Level `shape_factor`: the paper's springs with the moduli that a block bonded to its mount appears to have.

Bonding hinders the rubber's sideways motion, so a block is stiffer in compression than E A/h, and bending makes it
softer in shear than G A/h. One static elastic solve of the block, or shape-factor theory, gives the two factors; the
relaxation times, the friction law and the geometry stay as they are. Nothing is fitted to a rolling block.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..geometry import path_of
from ..study import Case
from .block_pass import BlockPass, prepare
from .condensed.mesh_body import mesh_file_of
from .condensed.motion import free_shape
from .condensed.store import converged_ratios
from .stiffness import StiffnessRatios, pressure_theory, shear_theory


def ratios(case: Case) -> StiffnessRatios:
    """Return the stiffness ratios of the case's block from a static solve in its stress-free shape."""
    shape = free_shape(path_of(case), case.block)
    return converged_ratios(case.block, shape, case.compound.poissons_ratio, mesh_file_of(case))


def prepare_shape_factor(case: Case) -> BlockPass:
    """Return the case ready to run, moduli from one static solve."""
    found = ratios(case)
    return stiffened(prepare(case), found.normal, found.shear)


def prepare_shape_factor_theory(case: Case) -> BlockPass:
    """Return the case ready to run, moduli from shape-factor theory (a rectangle of the block's plan dimensions)."""
    nu = case.compound.poissons_ratio
    return stiffened(prepare(case), pressure_theory(case.block, nu), shear_theory(case.block, nu))


def stiffened(block_pass: BlockPass, normal: float, shear: float) -> BlockPass:
    """Return the pass with E times `normal` in compression and G times `shear` in shear."""
    rubber = block_pass.rubber
    return replace(
        block_pass,
        rubber=rubber._replace(
            long_term_modulus=normal * rubber.long_term_modulus,
            moduli=np.ascontiguousarray(normal * rubber.moduli),
            shear_ratio=rubber.shear_ratio * shear / normal,
        ),
    )
