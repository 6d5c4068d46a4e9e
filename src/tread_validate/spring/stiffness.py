"""How stiff a bonded block is against a road: one static elastic solve, and what shape-factor theory predicts.

All stiffnesses are ratios to the uniaxial springs of section 4 of the paper: normal force E A d/h, shear force G A s/h,
rocking moment E I r/h.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..study import Block
from ..units import MM
from .condensed.body import Body
from .condensed.condense import FaceStiffness

Array = NDArray[np.float64]


@dataclass(frozen=True)
class StiffnessRatios:
    """Stiffness of a block over that of its uniaxial springs.

    Attributes
    ----------
    normal : float
        Face stuck to the road.
    normal_sliding : float
        Face free to slide on the road.
    shear : float
        Face stuck and kept parallel to the mount.
    rocking : float
        Face stuck and turned about the axle's direction.
    """

    normal: float
    normal_sliding: float
    shear: float
    rocking: float


def static_ratios(body: Body, face: FaceStiffness, poissons_ratio: float, height: float) -> StiffnessRatios:
    """Return the ratios of a condensed block; `height` in m."""
    matrix, n = face.stiffness, body.nodes_per_layer
    component = np.tile([0, 1, 2], n)
    on_plane = body.on_symmetry_plane[body.on_symmetry_plane < n]
    press = np.where(component == 1, 1.0, 0.0)
    rock = np.where(component == 1, np.repeat(body.along, 3), 0.0)
    loose = component != 1
    loose[3 * on_plane + 2] = False
    slide = press.copy()
    slide[loose] = -np.linalg.solve(matrix[np.ix_(loose, loose)], (matrix @ press)[loose])
    normal, shear = stuck_ratios(body, face, poissons_ratio, height)
    return StiffnessRatios(
        normal=normal,
        normal_sliding=float(slide @ matrix @ slide) * height / float(body.area.sum()),
        shear=shear,
        rocking=float(rock @ matrix @ rock) * height / float(body.area @ body.along**2),
    )


def stuck_ratios(body: Body, face: FaceStiffness, poissons_ratio: float, height: float) -> tuple[float, float]:
    """Return the ratios of normal and shear stiffness of a face that sticks; `height` in m."""
    matrix, area = face.stiffness, float(body.area.sum())
    shear_modulus = 0.5 / (1.0 + poissons_ratio)
    normal, shear = float(matrix[1::3, 1::3].sum()), float(matrix[0::3, 0::3].sum())
    return normal * height / area, shear * height / (shear_modulus * area)


def shape_factor(block: Block, sliding: bool = False) -> float:
    """Return loaded area over free area of a rectangle of the block's plan dimensions.

    A face that slides without friction is the middle plane of a block of twice the height bonded at both ends, so
    that its shape factor is half as large.
    """
    length, width, height = _size(block, sliding)
    return length * width / (2.0 * height * (length + width))


def gent_lindley(block: Block, poissons_ratio: float, sliding: bool = False) -> float:
    """Return E_a/E = 1/(1/(1 + 2 S^2) + E/K).

    A.N. Gent, P.B. Lindley, Proc. Inst. Mech. Eng. 173 (1959) 111-122, doi:10.1243/PIME_PROC_1959_173_022_02: the
    incompressible block and its bulk compliance in series.
    """
    incompressible = 1.0 + 2.0 * shape_factor(block, sliding) ** 2
    return 1.0 / (1.0 / incompressible + 3.0 * (1.0 - 2.0 * poissons_ratio))


def pressure_theory(block: Block, poissons_ratio: float, sliding: bool = False, rocking: bool = False) -> float:
    """Return the ratio of the normal (or rocking) stiffness by the pressure method for a compressible rectangle.

    Sections bulge as parabolas over the height, so that the mean pressure obeys
    ``lap p - 12 G p/(K h^2) = -12 G e/h^2`` with p = 0 at the free edges (J.M. Kelly, Earthquake-Resistant Design with
    Rubber, 2nd ed. 1997, ch. 3; M.S. Chalhoub, J.M. Kelly, J. Eng. Mech. 117 (1991) 1746-1760); solved here by a double
    sine series. As in Gent and Lindley's sum, the homogeneous compression adds E e. For rocking, the compression is
    e = x r/h.
    """
    length, width, height = _size(block, sliding)
    shear = 0.5 / (1.0 + poissons_ratio)
    bulk = 1.0 / (3.0 * (1.0 - 2.0 * poissons_ratio))
    m, n = np.arange(1, 400)[:, None], np.arange(1, 400, 2)
    # sine coefficients of 1 (or of x from the middle) along, of 1 across, and the same again for the mean
    across = 4.0 / (np.pi * n)
    along = (
        np.where(m % 2 == 1, 4.0 / (np.pi * m), 0.0) if not rocking else np.where(m % 2 == 0, -2.0 / (np.pi * m), 0.0)
    )
    wave = (m * np.pi / length) ** 2 + (n * np.pi / width) ** 2
    amplitude = 12.0 * shear / height**2 / (wave + 12.0 * shear / (bulk * height**2))
    mean = float(np.sum(amplitude * (along * across) ** 2)) / 4.0
    return 1.0 + (12.0 * mean if rocking else mean)


def shear_theory(block: Block, poissons_ratio: float) -> float:
    """Return the shear ratio of a short beam clamped at both ends, 1/(1 + (G/E) h^2/L^2).

    Deflection by shear and by bending in series (R.S. Rivlin, D.W. Saunders, Trans. Inst. Rubber Ind. 24 (1949)
    296-306): h/(G A) + h^3/(12 E I), I = A L^2/12.
    """
    length, _, height = _size(block, False)
    return 1.0 / (1.0 + 0.5 / (1.0 + poissons_ratio) * (height / length) ** 2)


def _size(block: Block, sliding: bool) -> tuple[float, float, float]:
    """Return length, width and effective height in m; a sipe has no place in these theories."""
    if block.sipes:
        raise InputError("block", f"{len(block.sipes)} sipe(s)", "a solid block: shape-factor theory knows no sipes")
    return block.length_mm * MM, block.width_mm * MM, (2.0 if sliding else 1.0) * block.height_mm * MM
